// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/folder_names.hpp"

#include <unistd.h>

#include <array>
#include <random>
#include <system_error>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "host";
  return name.data();
}

}  // namespace

fs::path unused_name(const fs::path& parent, const std::string& label) {
  std::random_device random;
  return parent / (label + "-" + host_name() + "-" + std::to_string(getpid()) + "-" +
                   std::to_string(random()) + std::to_string(random()));
}

bool rename_folder(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (!error) return true;
  if (error == std::errc::directory_not_empty || error == std::errc::file_exists) return false;
  throw UserError(to.string() + ": " + error.message());
}

}  // namespace mtstereo::run
