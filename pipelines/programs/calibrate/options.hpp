// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "programs/calibrate/board.hpp"
#include "programs/calibrate/lens.hpp"
#include "programs/calibrate/source.hpp"

namespace mtstereo::calibrate {

/// Exit statuses of the program.
enum ExitStatus {
  kWritten = 0,         ///< the calibration was written
  kNothingWritten = 1,  ///< it was not; the reason was printed
  kWrongUsage = 2,      ///< the command is invalid
  kWithWarnings = 3,    ///< with --strict: it was written, but there are warnings
};

struct Options {
  SourceOptions source;
  BoardOptions board;
  std::optional<Model> model = Model::kPlumbBob;  ///< std::nullopt = choose
  std::filesystem::path out = "calibration";      ///< folder
  bool overwrite = false;
  int most_views = 40;   ///< of video
  double give_up = 120;  ///< without a new view of live video [s]; 0 = never
  bool stills = false;   ///< each frame of the video shows a board at rest
  bool strict = false;
  std::filesystem::path board_file;  ///< write the board instead
  std::string paper = "A4";
};

struct ParsedOptions {
  std::optional<Options> options;  ///< std::nullopt: exit with the status
  int exit_status = kWritten;
};

/// Parses the command line. Prints help and errors.
ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace mtstereo::calibrate
