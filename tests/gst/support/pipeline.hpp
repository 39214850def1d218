// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mtstereo::test {

/// A sample of an appsink.
struct Sample {
  GstClockTime pts = GST_CLOCK_TIME_NONE;
  std::string caps;
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> confidence;  ///< of the attached map; empty: none
};

/// A pipeline from a launch line. The destructor stops it.
class Pipeline {
 public:
  explicit Pipeline(const std::string& launch);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  GstElement* element() const { return pipeline_; }
  /// The element of this name; the pipeline owns it.
  GstElement* named(const char* name) const;
  void set_state(GstState state);
  /// Plays until the end of the stream or an error. Returns "" or the text of the error.
  std::string run();
  /// Waits for the end of the stream or an error. Returns "" or the text of the error.
  std::string wait_for_end(double seconds = 60);
  /// Waits until a state change or a seek has completed; false if it fails or times out.
  bool wait_until_settled(double seconds = 20);
  bool seek(GstClockTime to, GstSeekFlags flags, double rate = 1.0);
  /// All samples that are in the appsink of this name now.
  std::vector<Sample> samples(const char* sink = "out");

 private:
  GstElement* pipeline_ = nullptr;
};

/// A launch line with two streams of a videotestsrc: the same image on both sides, the right one
/// shifted by `shift` px. The mtstereo is named m; its sink is the appsink out.
std::string noise_launch(int frames, const std::string& properties, int shift = 4);

}  // namespace mtstereo::test
