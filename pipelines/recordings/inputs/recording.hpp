// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "recordings/media/source.hpp"

namespace mtstereo::run {

/// How the two views arrive.
enum class Arrangement {
  kTwoSources,  ///< one source for each view
  kSideBySide,  ///< one source: left half and right half
  kTopBottom,   ///< one source: upper half and lower half
};

/// How views are rectified, as the properties of mtrectify with these names.
struct RectifiedShape {
  double alpha = 0;
  int width = 0, height = 0;  ///< [px]; 0: those of the views, or of the calibration
  bool operator==(const RectifiedShape&) const = default;
};

/// A recording of two cameras: what was recognized, before any frame is decoded.
struct Recording {
  std::string name;  ///< of its folder of results; unique in an archive
  std::string kind;  ///< such as "two video files" or "KITTI odometry sequence", for messages
  Arrangement arrangement = Arrangement::kTwoSources;
  bool swapped = false;  ///< with one source: the first half is the right view
  Source left;           ///< or both views
  Source right;          ///< empty if both views are in one source
  /// For read_calibration(); empty if there is none.
  std::string calibration;
  /// The views are rectified. The calibration, if there is one, only gives the meters.
  bool rectified = true;
  RectifiedShape shape;              ///< of views that are rectified by the calibration
  double frame_rate = 0;             ///< of images without times [1/s]; 0 for videos
  std::optional<int> max_disparity;  ///< that the data set states [px]
  std::vector<std::string> remarks;  ///< what was guessed, as sentences for the user
};

/// The remark that names a calibration that cannot be used begins with it.
inline constexpr const char* kNoCalibration = "No calibration is used: ";

/// What the command line states about inputs; the rest is recognized.
struct InputOptions {
  std::optional<Arrangement> arrangement;
  bool swap = false;              ///< exchange left and right
  std::string calibration;        ///< for read_calibration(); empty = what lies beside the input
  std::optional<bool> rectified;  ///< none: recognized
  RectifiedShape shape;
  double frame_rate = 30;  ///< of images without times [1/s]
};

/// An input that cannot be used, found while a folder is searched.
struct Problem {
  std::string input;
  std::string reason;  ///< one sentence
};

}  // namespace mtstereo::run
