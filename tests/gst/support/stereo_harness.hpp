// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/check/gstharness.h>
#include <gst/gst.h>

#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "mtstereo/matcher.hpp"
#include "support/images.hpp"

namespace mtstereo::test {

struct Unref {
  void operator()(GstBuffer* buffer) const { gst_buffer_unref(buffer); }
  void operator()(GstCaps* caps) const { gst_caps_unref(caps); }
  void operator()(GstEvent* event) const { gst_event_unref(event); }
  void operator()(GstStructure* structure) const { gst_structure_free(structure); }
  void operator()(GstMessage* message) const { gst_message_unref(message); }
};
using BufferPointer = std::unique_ptr<GstBuffer, Unref>;
using CapsPointer = std::unique_ptr<GstCaps, Unref>;
using EventPointer = std::unique_ptr<GstEvent, Unref>;
using StructurePointer = std::unique_ptr<GstStructure, Unref>;
using MessagePointer = std::unique_ptr<GstMessage, Unref>;

/// What an error or warning message says.
struct Report {
  std::string text;
  std::string details;
  GQuark domain = 0;
  int code = 0;
};

/// The property `stats`.
struct Stats {
  std::uint64_t pairs = 0;
  std::uint64_t dropped_left = 0;
  std::uint64_t dropped_right = 0;
  std::uint64_t skipped = 0;
  double last_ms = 0;
  double mean_ms = 0;
  double density = 0;
};
Stats stats_of(GstElement* element);

/// An mtstereo between two pads that push and one that receives. The clock is a test clock at 0;
/// the streams are not live unless told.
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

  /// Both sides the same caps, or each its own.
  void caps(const std::string& both) { caps(both, both); }
  void caps(const std::string& left, const std::string& right);
  void caps(Side side, const std::string& text);

  /// Pushes a frame; waits as long as the pad is full.
  GstFlowReturn push(Side side, GstBuffer* buffer);
  /// Pushes both frames of a pair with the same time stamp, `duration` 1/30 s.
  void push_pair(const Pair& pair, GstClockTime pts, const Layout& left = {},
                 const Layout& right = {});
  bool event(Side side, GstEvent* event);
  void end(Side side) { event(side, gst_event_new_eos()); }

  /// The next disparity map; nullptr after `seconds` without one.
  BufferPointer pull(double seconds = 20);
  /// The next event of this type that came out, others are thrown away; nullptr if none comes.
  EventPointer pull_event(GstEventType type, double seconds = 20);
  /// True where nothing comes out for a while.
  bool silent(double seconds = 0.2);

  /// The first message of the type that the element has posted; text is "" if none comes.
  Report report(GstMessageType type, double seconds = 20);
  Report error(double seconds = 20) { return report(GST_MESSAGE_ERROR, seconds); }
  Report warning(double seconds = 20) { return report(GST_MESSAGE_WARNING, seconds); }
  /// How many errors the element has posted since the last call, after giving it time for more.
  int further_errors(double seconds = 0.2);

  Stats stats() const { return stats_of(element_); }
  /// Waits until the statistics say so; false if they never do.
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

/// Frames with these time stamps and the picture of `pair`'s side, pushed by a thread of its own;
/// then the end of the stream.
class Feeder {
 public:
  Feeder(StereoHarness& harness, Side side, const Pair& pair, std::vector<GstClockTime> times);
  ~Feeder() { join(); }
  void join();

 private:
  std::thread thread_;
};

}  // namespace mtstereo::test
