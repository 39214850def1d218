// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "mtstereo/matcher.hpp"
#include "support/harness.hpp"
#include "support/images.hpp"

namespace mtstereo::test {

/// The content of an error or warning message.
struct Report {
  std::string text;
  std::string details;
  GQuark domain = 0;
  int code = 0;
};

/// The content of an error or warning message.
Report report_of(GstMessage* message);

/// The property `stats`.
struct Stats {
  std::uint64_t pairs = 0;
  std::uint64_t dropped_left = 0;
  std::uint64_t dropped_right = 0;
  std::uint64_t skipped = 0;
  double last_ms = 0;
  double mean_ms = 0;
  double density = 0;
  std::uint64_t wrong_times = 0;
  double difference_ms = 0;
  double difference_spread_ms = 0;
  double difference_drift = 0;
};
Stats stats_of(GstElement* element);

/// A segment of times from 0 on.
GstSegment time_segment();

/// An mtstereo with a harness on each side: two pads push frames, one receives maps. The clock is a
/// test clock at 0; the streams are not live by default.
class StereoHarness {
 public:
  /// `properties` as on a command line: "max-disparity=16 mode=sparse".
  explicit StereoHarness(const std::string& properties = "max-disparity=16", bool live = false);
  ~StereoHarness();
  StereoHarness(const StereoHarness&) = delete;
  StereoHarness& operator=(const StereoHarness&) = delete;

  GstElement* element() const { return element_; }
  GstHarness* side(Side side) const { return side == Side::kLeft ? left_ : right_; }
  /// The harness that receives.
  GstHarness* output() const { return left_; }

  /// Sets the same caps on both sides, or caps of each side.
  void caps(const std::string& both) { caps(both, both); }
  void caps(const std::string& left, const std::string& right);
  void caps(Side side, const std::string& text);

  /// Pushes a frame; blocks while the pad is full.
  GstFlowReturn push(Side side, GstBuffer* buffer);
  /// Pushes both frames of a pair with the same time stamp, `duration` 1/30 s.
  void push_pair(const Pair& pair, GstClockTime pts, const Layout& left = {},
                 const Layout& right = {});
  bool event(Side side, GstEvent* event);
  /// Begins a segment on both sides.
  void segment(const GstSegment& segment = time_segment());
  /// Flushes both sides as one seek does, which needs a number of its own, and begins new segments.
  void flush(std::uint32_t seqnum);
  void end(Side side) { event(side, gst_event_new_eos()); }

  /// The next disparity map; nullptr after `seconds` without one.
  BufferPointer pull(double seconds = 20);
  /// The next output event of this type; other events are discarded. nullptr if none arrives.
  EventPointer pull_event(GstEventType type, double seconds = 20);
  /// True if there is no output for a while.
  bool silent(double seconds = 0.2);

  /// The first message of this type from the element; the text is "" if none arrives.
  Report report(GstMessageType type, double seconds = 20);
  Report error(double seconds = 20) { return report(GST_MESSAGE_ERROR, seconds); }
  Report warning(double seconds = 20) { return report(GST_MESSAGE_WARNING, seconds); }
  /// All warnings that the element has posted since the last call, after a delay.
  std::vector<Report> warnings(double seconds = 0.05);
  /// The next element message of this name; nullptr if none arrives. Other messages are discarded.
  StructurePointer message(const char* name, double seconds = 20);
  /// Number of errors that the element has posted since the last call, after a delay.
  int further_errors(double seconds = 0.2);

  Stats stats() const { return stats_of(element_); }
  /// Waits until the statistics have these values; false on timeout.
  bool wait_for_stats(std::uint64_t pairs, std::uint64_t dropped_left,
                      std::uint64_t dropped_right) const;
  CapsPointer output_caps() const;

 private:
  GstElement* element_ = nullptr;
  GstBus* bus_ = nullptr;
  GstHarness* left_ = nullptr;
  GstHarness* right_ = nullptr;
};

/// An mtstereo without a harness, with properties as on a command line.
GstElement* make_element(const std::string& properties, const char* factory = "mtstereo");

/// 1/30 s.
inline constexpr GstClockTime kFrame = 33'333'333;

/// Pushes frames with these time stamps and the image of one side of `pair` in a thread of its own,
/// followed by the end of the stream.
class Feeder {
 public:
  Feeder(StereoHarness& harness, Side side, const Pair& pair, std::vector<GstClockTime> times);
  ~Feeder() { join(); }
  void join();

 private:
  std::thread thread_;
};

}  // namespace mtstereo::test
