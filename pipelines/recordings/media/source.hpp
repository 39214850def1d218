// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mtstereo::run {

/// A time or a difference of two [ns].
using Nanoseconds = std::int64_t;

/// One second [ns].
inline constexpr Nanoseconds kSecond = 1'000'000'000;

/// A time [s].
inline double seconds(Nanoseconds time) { return 1e-9 * static_cast<double>(time); }

/// Where the frames of one source are: a video file, or images.
struct Source {
  std::filesystem::path video;                ///< empty for images
  std::vector<std::filesystem::path> images;  ///< one per frame, in order; empty for a video
  /// Of the images, from the data set [ns]; empty: by Recording::frame_rate.
  std::vector<Nanoseconds> times;
  /// Images that were found but are left out; empty if there are none. FrameIndex::damage has it.
  std::string damage{};
  int unused_bits = 0;  ///< high bits of images with 16 bits that are always 0

  /// No source.
  bool empty() const { return video.empty() && images.empty(); }
};

}  // namespace mtstereo::run
