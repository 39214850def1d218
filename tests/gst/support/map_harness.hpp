// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/pipeline.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::test {

/// The pixels of a 16-bit map, row by row.
struct Map16 {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;
};

/// A GRAY16_LE frame of a map. With a padding or an offset it has a GstVideoMeta, and all bytes
/// outside the image are 0xAB [bytes].
GstBuffer* map_buffer(const Map16& map, GstClockTime pts = 0, int padding = 0, int offset = 0);

/// Attaches a confidence map of the same size, as an application does.
void attach_confidence(GstBuffer* buffer, int width, int height,
                       const std::vector<std::uint8_t>& values);

/// The next message of this type, or nullptr.
MessagePointer next_message(GstBus* bus, GstMessageType type, double seconds = 0);

/// The text of an error, a warning or an information; "" without a message.
std::string text_of(const MessagePointer& message);

/// Starts a pipeline; how many errors the element of this name posts.
int errors_of(const char* name, Pipeline& pipeline);

/// An element that turns 16-bit maps into other frames, in a harness.
class MapHarness {
 public:
  MapHarness(const char* factory, const std::string& properties);
  ~MapHarness();
  MapHarness(const MapHarness&) = delete;
  MapHarness& operator=(const MapHarness&) = delete;

  GstElement* element() const { return element_; }
  GstBus* bus() const { return bus_; }

  /// Sets the caps of the input: GRAY16_LE of this size, and more fields such as ",depth-unit=1.0".
  void caps(int width, int height, const std::string& more);
  /// Pushes a map and returns the output; nullptr if it fails.
  BufferPointer pass(GstBuffer* buffer);
  /// The error of the next map, or of the caps before it.
  std::string error_of(const Map16& map, const std::string& more_caps);
  std::string output_caps() const;

 private:
  GstElement* element_ = nullptr;
  GstBus* bus_ = nullptr;
  GstHarness* harness_ = nullptr;
};

}  // namespace mtstereo::test
