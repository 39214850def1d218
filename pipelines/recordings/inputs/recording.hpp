// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mtstereo::run {

/// A time or a difference of two [ns].
using Nanoseconds = std::int64_t;

/// How the two views arrive.
enum class Arrangement {
  kTwoSources,  ///< one source for each view
  kSideBySide,  ///< one source: left half and right half
  kTopBottom,   ///< one source: upper half and lower half
};

/// Where the frames of one source are: a video file, or pictures.
struct Source {
  std::filesystem::path video;                  ///< empty for pictures
  std::vector<std::filesystem::path> pictures;  ///< one per frame, in order; empty for a video
  /// Of the pictures, from the data set [ns]; empty: by Recording::frame_rate.
  std::vector<Nanoseconds> times;
  /// Pictures that were found but are left out; empty if there are none. FrameIndex::damage has it.
  std::string damage{};

  /// No source.
  bool empty() const { return video.empty() && pictures.empty(); }
};

/// How views are rectified, as the properties of mtrectify with these names.
struct RectifiedShape {
  double alpha = 0;
  int width = 0, height = 0;  ///< [px]; 0: those of the views, or of the calibration
  bool operator==(const RectifiedShape&) const = default;
};

/// A recording of two cameras: what was recognised, before any frame is decoded.
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
  double frame_rate = 0;             ///< of pictures without times [1/s]; 0 for videos
  std::optional<int> max_disparity;  ///< that the data set states [px]
  std::vector<std::string> remarks;  ///< what was guessed, as sentences for the user
};

/// What the command line states about inputs; the rest is recognised.
struct InputOptions {
  std::optional<Arrangement> arrangement;
  bool swap = false;              ///< exchange left and right
  std::string calibration;        ///< for read_calibration(); empty = what lies beside the input
  std::optional<bool> rectified;  ///< none: recognised
  RectifiedShape shape;
  double frame_rate = 30;  ///< of pictures without times [1/s]
};

/// An input that cannot be used, found while a folder is searched.
struct Problem {
  std::string input;
  std::string reason;  ///< one sentence
};

/// Recognises one recording: two video files, two folders (or patterns, left/%04d.png) of pictures,
/// one file or folder with both views side by side or one above the other, or a folder of a data
/// set (KITTI odometry and raw, EuRoC ASL, Middlebury and ETH3D pair folders). Decodes at most a
/// few frames. Throws RunError.
Recording recognize(const std::vector<std::string>& inputs, const InputOptions& options);

/// All recordings in a folder and the folders in it, sorted by name. What looks like a recording
/// and cannot be used is added to `problems`. Throws RunError if the folder cannot be read.
std::vector<Recording> find_recordings(const std::filesystem::path& archive,
                                       const InputOptions& options, std::vector<Problem>& problems);

}  // namespace mtstereo::run
