// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/map_harness.hpp"

#include <gtest/gtest.h>

namespace mtstereo::test {

GstBuffer* map_buffer(const Map16& map, GstClockTime pts, int padding, int offset) {
  const int stride = GST_ROUND_UP_4(2 * map.width) + padding;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(offset + stride * map.height), 0xAB);
  for (int i = 0; i < map.width * map.height; ++i) {
    std::uint8_t* to = bytes.data() + offset + i / map.width * stride + i % map.width * 2;
    const unsigned value = map.values[static_cast<std::size_t>(i)];
    to[0] = static_cast<std::uint8_t>(value);
    to[1] = static_cast<std::uint8_t>(value >> 8);
  }
  GstBuffer* buffer = gst_buffer_new_memdup(bytes.data(), bytes.size());
  if (padding != 0 || offset != 0) {
    gsize offsets[GST_VIDEO_MAX_PLANES] = {static_cast<gsize>(offset)};
    gint strides[GST_VIDEO_MAX_PLANES] = {stride};
    gst_buffer_add_video_meta_full(buffer, GST_VIDEO_FRAME_FLAG_NONE, GST_VIDEO_FORMAT_GRAY16_LE,
                                   static_cast<guint>(map.width), static_cast<guint>(map.height), 1,
                                   offsets, strides);
  }
  GST_BUFFER_PTS(buffer) = pts;
  GST_BUFFER_DURATION(buffer) = kFrame;
  return buffer;
}

void attach_confidence(GstBuffer* buffer, int width, int height,
                       const std::vector<std::uint8_t>& values) {
  const int stride = GST_ROUND_UP_4(width);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stride * height));
  for (int i = 0; i < width * height; ++i) {
    bytes[static_cast<std::size_t>(i / width * stride + i % width)] =
        values[static_cast<std::size_t>(i)];
  }
  const BufferPointer confidence(gst_buffer_new_memdup(bytes.data(), bytes.size()));
  const CapsPointer caps(gst_caps_from_string(raw_caps("GRAY8", width, height).c_str()));
  GstSample* sample = gst_sample_new(confidence.get(), caps.get(), nullptr, nullptr);
  GstCustomMeta* meta = gst_buffer_add_custom_meta(buffer, "MtStereoConfidenceMeta");
  gst_structure_set(gst_custom_meta_get_structure(meta), "confidence", GST_TYPE_SAMPLE, sample,
                    nullptr);
  gst_sample_unref(sample);
}

MessagePointer next_message(GstBus* bus, GstMessageType type, double seconds) {
  return MessagePointer(gst_bus_timed_pop_filtered(
      bus, static_cast<GstClockTime>(seconds * static_cast<double>(GST_SECOND)), type));
}

std::string text_of(const MessagePointer& message) {
  if (!message) return "";
  GError* error = nullptr;
  switch (GST_MESSAGE_TYPE(message.get())) {
    case GST_MESSAGE_ERROR:
      gst_message_parse_error(message.get(), &error, nullptr);
      break;
    case GST_MESSAGE_WARNING:
      gst_message_parse_warning(message.get(), &error, nullptr);
      break;
    default:
      gst_message_parse_info(message.get(), &error, nullptr);
      break;
  }
  std::string text = error->message;
  g_error_free(error);
  return text;
}

int errors_of(const char* name, Pipeline& pipeline) {
  int errors = 0;
  GstBus* bus = gst_element_get_bus(pipeline.element());
  pipeline.set_state(GST_STATE_PLAYING);
  while (const MessagePointer message = next_message(bus, GST_MESSAGE_ERROR, 0.3)) {
    if (GST_MESSAGE_SRC(message.get()) == GST_OBJECT(pipeline.named(name))) ++errors;
  }
  gst_object_unref(bus);
  return errors;
}

MapHarness::MapHarness(const char* factory, const std::string& properties) {
  element_ = make_element(properties, factory);
  bus_ = gst_bus_new();
  gst_element_set_bus(element_, bus_);
  harness_ = gst_harness_new_with_element(element_, "sink", "src");
}

MapHarness::~MapHarness() {
  gst_element_set_bus(element_, nullptr);
  gst_harness_teardown(harness_);
  gst_object_unref(element_);
  gst_object_unref(bus_);
}

void MapHarness::caps(int width, int height, const std::string& more) {
  gst_harness_set_src_caps_str(harness_, (raw_caps("GRAY16_LE", width, height) + more).c_str());
}

BufferPointer MapHarness::pass(GstBuffer* buffer) {
  const GstFlowReturn flow = gst_harness_push(harness_, buffer);
  EXPECT_EQ(flow, GST_FLOW_OK);
  return BufferPointer(flow == GST_FLOW_OK ? gst_harness_pull(harness_) : nullptr);
}

std::string MapHarness::error_of(const Map16& map, const std::string& more_caps) {
  caps(map.width, map.height, more_caps);
  EXPECT_NE(gst_harness_push(harness_, map_buffer(map)), GST_FLOW_OK);
  return text_of(next_message(bus_, GST_MESSAGE_ERROR));
}

std::string MapHarness::output_caps() const {
  GstPad* pad = gst_element_get_static_pad(element_, "src");
  const CapsPointer caps(gst_pad_get_current_caps(pad));
  gst_object_unref(pad);
  if (!caps) return "none";
  gchar* text = gst_caps_to_string(caps.get());
  std::string result = text;
  g_free(text);
  return result;
}

}  // namespace mtstereo::test
