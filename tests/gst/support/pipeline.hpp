// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mtstereo::test {

/// What came out of one appsink.
struct Sample {
  GstClockTime pts = GST_CLOCK_TIME_NONE;
  std::string caps;
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> confidence;  ///< that came with it; empty: none did
};

/// A whole pipeline from a launch line. It ends with this object.
class Pipeline {
 public:
  explicit Pipeline(const std::string& launch);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  GstElement* element() const { return pipeline_; }
  /// The element of this name; it stays the pipeline's.
  GstElement* named(const char* name) const;
  void set_state(GstState state);
  /// PLAYING until the end of the stream or an error; "" or the text of the error.
  std::string run();
  /// Waits for the end of the stream or an error.
  std::string wait_for_end(double seconds = 60);
  /// Waits until a state change or a seek is done; false if it fails or never ends.
  bool wait_until_settled(double seconds = 20);
  bool seek(GstClockTime to, GstSeekFlags flags, double rate = 1.0);
  /// Everything that is in the appsink of this name, until it has no more for now.
  std::vector<Sample> samples(const char* sink = "out");

 private:
  GstElement* pipeline_ = nullptr;
};

/// A launch line with two noise streams that are made with nothing but videotestsrc: the same
/// picture on both sides, the right one shifted by `shift` px. `mtstereo` is named m, its output
/// goes to the appsink out.
std::string noise_launch(int frames, const std::string& properties, int shift = 4);

}  // namespace mtstereo::test
