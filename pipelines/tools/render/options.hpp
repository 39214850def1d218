// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "tools/render/board.hpp"
#include "tools/render/clip_writer.hpp"
#include "tools/render/render.hpp"
#include "tools/render/scene.hpp"

namespace CLI {
class App;
}

namespace mtstereo::render {

/// The board of the scene `board`.
struct BoardOptions {
  std::string squares = "10x7";  ///< of the checkerboard
  double square = 0.05;          ///< edge of a square [m]
  std::string image;             ///< file that replaces the checkerboard
  double image_width = 0;        ///< of that image on the board [m]
  BoardPoses poses;              ///< its seed is that of the settings
  int rest = 1;                  ///< frames at each pose
  int move = 0;                  ///< frames between two poses
};

/// What the command line states.
struct Options {
  std::string folder;             ///< output folder
  std::string scene = "street";   ///< name of the scene
  std::string size = "640x360";   ///< of a view [px]
  bool has_size = false;          ///< whether the command line states it
  std::optional<int> frames;      ///< number of frames
  double rate = 24;               ///< frames per second
  double start = 0;               ///< scene time of the first frame [s]
  Layout layout = Layout::kClip;  ///< of the output folder
  bool overwrite = false;         ///< replace an existing clip
  bool depth = false;             ///< also write the true depths
  bool gray = false;              ///< gray images
  std::string raw;                ///< file of the calibration of raw cameras
  std::string lens;               ///< name of built-in raw cameras
  std::string rectification;      ///< file of the calibration whose rectified pair the truth shows
  double alpha = 0;               ///< of that rectification
  std::string rectified_size;     ///< of the views of that pair [px]; empty: that of the cameras
  BoardOptions board;             ///< of the scene `board`
  Settings settings;              ///< of the cameras

  /// Whether the cameras are raw ones.
  bool has_raw_cameras() const { return !raw.empty() || !lens.empty(); }
};

/// Defines the options of the program.
void define_options(CLI::App& app, Options& options);

/// Completes the settings, and checks values and combinations. Throws std::invalid_argument, naming
/// the option.
void complete_options(const CLI::App& app, Options& options);

/// The two numbers of a text such as 640x360. Throws std::invalid_argument, naming the option.
std::pair<int, int> parse_pair(const std::string& option, const std::string& text,
                               const char* example);

}  // namespace mtstereo::render
