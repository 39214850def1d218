// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/pipeline.hpp"

#include <gst/app/gstappsink.h>
#include <gtest/gtest.h>

#include "support/images.hpp"

namespace mtstereo::test {
namespace {

std::string full_text_of(GstMessage* message) {
  GError* error = nullptr;
  gchar* details = nullptr;
  gst_message_parse_error(message, &error, &details);
  std::string text = std::string(GST_OBJECT_NAME(GST_MESSAGE_SRC(message))) + ": " +
                     error->message + " [" + (details != nullptr ? details : "") + "]";
  g_error_free(error);
  g_free(details);
  return text;
}

Sample sample_of(GstSample* from) {
  Sample sample;
  GstBuffer* buffer = gst_sample_get_buffer(from);
  sample.pts = GST_BUFFER_PTS(buffer);
  gchar* caps = gst_caps_to_string(gst_sample_get_caps(from));
  sample.caps = caps;
  g_free(caps);
  GstMapInfo map;
  if (gst_buffer_map(buffer, &map, GST_MAP_READ)) {
    sample.bytes.assign(map.data, map.data + map.size);
    gst_buffer_unmap(buffer, &map);
  }
  sample.confidence = confidence_of(buffer);
  return sample;
}

}  // namespace

Pipeline::Pipeline(const std::string& launch) {
  GError* error = nullptr;
  pipeline_ = gst_parse_launch(launch.c_str(), &error);
  if (error != nullptr) {
    ADD_FAILURE() << launch << "\n" << error->message;
    g_error_free(error);
  }
}

Pipeline::~Pipeline() {
  gst_element_set_state(pipeline_, GST_STATE_NULL);
  gst_object_unref(pipeline_);
}

GstElement* Pipeline::named(const char* name) const {
  GstElement* element = gst_bin_get_by_name(GST_BIN(pipeline_), name);
  if (element == nullptr) {
    ADD_FAILURE() << "no element " << name;
    return nullptr;
  }
  gst_object_unref(element);
  return element;
}

void Pipeline::set_state(GstState state) { gst_element_set_state(pipeline_, state); }

std::string Pipeline::run() {
  set_state(GST_STATE_PLAYING);
  return wait_for_end();
}

std::string Pipeline::wait_for_end(double seconds) {
  constexpr auto kTypes =
      static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR | GST_MESSAGE_LATENCY);
  const gint64 end = g_get_monotonic_time() + static_cast<gint64>(seconds * G_USEC_PER_SEC);
  GstBus* bus = gst_element_get_bus(pipeline_);
  std::string text = "timeout: neither end of stream nor error";
  for (gint64 now = 0; (now = g_get_monotonic_time()) < end;) {
    GstMessage* message =
        gst_bus_timed_pop_filtered(bus, static_cast<GstClockTime>(end - now) * 1000, kTypes);
    const GstMessageType type =
        message != nullptr ? GST_MESSAGE_TYPE(message) : GST_MESSAGE_UNKNOWN;
    if (type == GST_MESSAGE_LATENCY) gst_bin_recalculate_latency(GST_BIN(pipeline_));
    if (type == GST_MESSAGE_EOS) text.clear();
    if (type == GST_MESSAGE_ERROR) text = full_text_of(message);
    gst_clear_message(&message);
    if (type == GST_MESSAGE_EOS || type == GST_MESSAGE_ERROR) break;
  }
  gst_object_unref(bus);
  return text;
}

bool Pipeline::wait_until_settled(double seconds) {
  const GstStateChangeReturn change = gst_element_get_state(
      pipeline_, nullptr, nullptr, static_cast<GstClockTime>(seconds * GST_SECOND));
  return change == GST_STATE_CHANGE_SUCCESS || change == GST_STATE_CHANGE_NO_PREROLL;
}

bool Pipeline::seek(GstClockTime to, GstSeekFlags flags, double rate) {
  const bool forward = rate > 0;
  return gst_element_seek(pipeline_, rate, GST_FORMAT_TIME, flags, GST_SEEK_TYPE_SET,
                          forward ? static_cast<gint64>(to) : 0, GST_SEEK_TYPE_SET,
                          forward ? -1 : static_cast<gint64>(to));
}

std::vector<Sample> Pipeline::samples(const char* sink) {
  std::vector<Sample> all;
  while (GstSample* sample = gst_app_sink_try_pull_sample(GST_APP_SINK(named(sink)), 0)) {
    all.push_back(sample_of(sample));
    gst_sample_unref(sample);
  }
  return all;
}

std::string noise_launch(int frames, const std::string& properties, int shift) {
  return "videotestsrc pattern=ball background-color=0xff405060 num-buffers=" +
         std::to_string(frames) +
         " ! video/x-raw,format=GRAY8,width=160,height=120,framerate=30/1 ! tee name=t "
         "mtstereo name=m " +
         properties +
         " ! appsink name=out wait-on-eos=false sync=false "
         "t. ! queue ! m.sink_left "
         "t. ! queue ! videobox left=" +
         std::to_string(shift) + " right=-" + std::to_string(shift) + " ! m.sink_right";
}

}  // namespace mtstereo::test
