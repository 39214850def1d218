// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include "recordings/inputs/own_names.hpp"

namespace mtstereo::run {

/// The names in the folder of a plan.
class PlanFolder {
 public:
  explicit PlanFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path plan() const { return folder_ / kPlanFile; }
  std::filesystem::path summary() const { return folder_ / "summary.json"; }
  std::filesystem::path works() const { return folder_ / "works"; }
  std::filesystem::path work(const std::string& recording) const {
    return works() / (recording + ".json");
  }
  /// What a work was made from: work_key().
  std::filesystem::path key(const std::string& recording) const {
    return works() / (recording + ".key");
  }
  std::filesystem::path pieces() const { return folder_ / "pieces"; }
  std::filesystem::path piece(std::size_t number) const {
    return pieces() / std::to_string(number);
  }
  std::filesystem::path recordings() const { return folder_ / "recordings"; }
  std::filesystem::path recording(const std::string& name) const { return recordings() / name; }
  /// Folders that are not whole yet. On the same file system as the rest.
  std::filesystem::path unfinished() const { return folder_ / "unfinished"; }

 private:
  std::filesystem::path folder_;
};

}  // namespace mtstereo::run
