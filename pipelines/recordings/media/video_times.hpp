// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/media/video_scan.hpp"

namespace mtstereo::run {

/// The times of the frames of a video.
struct VideoTimes {
  std::vector<Nanoseconds> times;      ///< increasing
  std::vector<Nanoseconds> keyframes;  ///< increasing
  /// When frames are decoded, in the order of the file; of those for which the file states it.
  std::vector<Nanoseconds> decoding_times;
  std::size_t frames = 0;             ///< also those with equal times
  std::size_t untimed = 0;            ///< frames for which the file states no time
  VideoFormat format;                 ///< of the last frame
  std::string error;                  ///< why the video ends early; empty if it does not
  int video_streams = 0;              ///< of the file; the first one is read
  bool starts_with_keyframe = false;  ///< the first frame of the file is one, shown or not
  /// Every frame has a time of its own, and no data is missing between them.
  bool complete = true;
};

/// Reads a whole video.
VideoTimes read_times(const std::filesystem::path& file, Reading reading);

/// Whether each frame of the file is one that is shown, for the codec of a video.
bool has_plain_codec(const VideoTimes& coded);

/// Whether no frame of the codec of a video refers to others; false for codecs that are not known.
bool has_intra_codec(const VideoTimes& coded);

/// Whether the decoder shows exactly the frames that the parser has found. A video is decoded at
/// its start and at its end; the answer is false for a short video, which is decoded faster than it
/// is checked.
bool parser_suffices(const std::filesystem::path& file, const VideoTimes& coded);

}  // namespace mtstereo::run
