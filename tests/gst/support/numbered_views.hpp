// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mtstereo/matcher.hpp"
#include "support/images.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::test {

// Synthetic views whose disparity depends on the difference of the frame numbers: the left frame n
// and the right frame m have the uniform disparity kNumberedBase + kNumberedStep * (m - n). So the
// map of a pair states whether its frames belong together. The texture moves by kNumberedStep px
// per frame and never repeats. It is smooth enough for lossy video codecs.

/// Size of the views [px].
inline constexpr int kNumberedWidth = 160;
inline constexpr int kNumberedHeight = 32;
/// The disparity of two frames with the same number [px].
inline constexpr int kNumberedBase = 32;
/// The change of the disparity per frame [px].
inline constexpr int kNumberedStep = 4;
/// Larger differences cannot be recognized with max-disparity=64.
inline constexpr int kMaxDifference = 6;
/// Properties of mtstereo for tests of many pairs: the fastest matching that states the difference.
inline constexpr const char* kNumberedMatching =
    "preset=fast max-disparity=64 threads=1 alignment=off";

/// The image of a frame. Tests have the same frames many times: each is drawn once.
const GrayImage& numbered_image(Side side, std::int64_t number);

/// A GRAY8 frame with this image.
GstBuffer* numbered_frame(Side side, std::int64_t number, GstClockTime pts,
                          GstClockTime duration = kFrame);

/// The difference of the frame numbers, right minus left, by the median disparity. std::nullopt if
/// less than 20 % of the pixels have a disparity or less than 3 of 4 of them agree with the median.
std::optional<int> frame_difference(const std::vector<std::uint16_t>& map, int scale = 256);
std::optional<int> frame_difference(GstBuffer* map, int scale = 256);

/// Counts the maps by the difference of the frame numbers.
struct DifferenceCounter {
  int maps = 0;     ///< all maps
  int wrong = 0;    ///< maps of a pair whose difference is not 0
  int unknown = 0;  ///< maps that do not state the difference

  void add(std::optional<int> difference);
};

/// A frame of a sequence.
struct NumberedFrame {
  std::int64_t number = 0;                     ///< of the image
  GstClockTime pts = GST_CLOCK_TIME_NONE;      ///< time stamp [ns]
  GstClockTime arrival = GST_CLOCK_TIME_NONE;  ///< running time of the push if live; default: pts
  /// The NTP time of a reference time stamp, which the frame has only if this is valid [ns].
  GstClockTime reference = GST_CLOCK_TIME_NONE;
  /// The NTP time of another one in front of it [ns].
  GstClockTime earlier_reference = GST_CLOCK_TIME_NONE;
};

/// `count` frames from the number `first` on. The time stamp of the frame i is offset + i *
/// interval.
std::vector<NumberedFrame> numbered_sequence(int count, GstClockTime interval = kFrame,
                                             GstClockTime offset = 0, std::int64_t first = 0);

/// How two sequences are fed.
struct FeedOptions {
  std::string properties = "max-disparity=64";  ///< of mtstereo, as on a command line
  std::string upstream;                         ///< between each source and mtstereo; may be ""
  std::string tail = "fakesink sync=false";     ///< downstream of mtstereo
  bool live = false;               ///< live sources: each frame is pushed at its arrival time
  const char* framerate = "30/1";  ///< of the caps
  const char* right_framerate = nullptr;  ///< of the right caps, if another one
  GstClockTime duration = kFrame;         ///< of every frame [ns]
  double timeout = 60;                    ///< for the end of the stream [s]
  /// Every map is delayed by this time in the task of the element, as if matching took longer [ns].
  GstClockTime delay = 0;
};

/// One disparity map.
struct NumberedMap {
  GstClockTime pts = GST_CLOCK_TIME_NONE;
  std::optional<int> difference;
  GstClockTime arrival = GST_CLOCK_TIME_NONE;  ///< at the source pad [running time]
};

/// What came out.
struct FeedResult {
  DifferenceCounter count;
  std::vector<NumberedMap> maps;
  std::vector<std::string> warnings;             ///< of mtstereo
  std::vector<std::size_t> maps_before_warning;  ///< for each warning, the maps that preceded it
  std::string error;  ///< of any element, or that the time was up; "" if none
  Stats stats;        ///< of mtstereo, at the end
};

/// Plays two sequences through an mtstereo, named m, in a pipeline with two appsrc and the system
/// clock, to the end of the stream.
FeedResult feed(const std::vector<NumberedFrame>& left, const std::vector<NumberedFrame>& right,
                const FeedOptions& options = {});

}  // namespace mtstereo::test
