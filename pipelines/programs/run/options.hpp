// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "programs/run/cluster_options.hpp"
#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// The command line of a run, or of the subcommand plan.
struct Options {
  std::vector<std::string> inputs;
  std::filesystem::path folder;  ///< --out
  InputOptions input;
  WorkOptions work;
  std::optional<ClockRelation> relation;  ///< of --sync and --drift
  bool estimate = false;                  ///< --sync auto
  bool resume = false;
  bool overwrite = false;
  bool list = false;
  bool check = false;
  bool quiet = false;
  /// Of resume and overwrite.
  Existing existing() const {
    return resume ? Existing::kContinue : overwrite ? Existing::kReplace : Existing::kRefuse;
  }
  int jobs = 1;  ///< processes; 1: this one
  bool plan = false;
  PlanOptions plan_options;
};

/// What parse_options() found.
struct ParsedOptions {
  std::optional<Options> options;  ///< none: exit with `exit_status`
  int exit_status = 0;
};

/// Parses the command line of a run or of plan. Prints help and errors.
ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace mtstereo::run
