// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/stereo_harness.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <sstream>

namespace mtstereo::test {
namespace {

bool wait_until(double seconds, const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace

Report report_of(GstMessage* message) {
  GError* error = nullptr;
  gchar* details = nullptr;
  if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
    gst_message_parse_error(message, &error, &details);
  } else {
    gst_message_parse_warning(message, &error, &details);
  }
  Report report{error->message, details != nullptr ? details : "", error->domain, error->code};
  g_error_free(error);
  g_free(details);
  return report;
}

GstElement* make_element(const std::string& properties, const char* factory) {
  GstElement* element = gst_element_factory_make(factory, nullptr);
  if (element == nullptr) {
    ADD_FAILURE() << "there is no element " << factory;
    return nullptr;
  }
  std::istringstream words(properties);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    gst_util_set_object_arg(G_OBJECT(element), word.substr(0, equals).c_str(),
                            word.substr(equals + 1).c_str());
  }
  return element;
}

Stats stats_of(GstElement* element) {
  GstStructure* structure = nullptr;
  g_object_get(element, "stats", &structure, nullptr);
  const StructurePointer owner(structure);
  Stats stats;
  EXPECT_STREQ(gst_structure_get_name(structure), "mtstereo-stats");
  EXPECT_TRUE(gst_structure_get(structure, "pairs", G_TYPE_UINT64, &stats.pairs, "dropped-left",
                                G_TYPE_UINT64, &stats.dropped_left, "dropped-right", G_TYPE_UINT64,
                                &stats.dropped_right, "skipped", G_TYPE_UINT64, &stats.skipped,
                                "last-ms", G_TYPE_DOUBLE, &stats.last_ms, "mean-ms", G_TYPE_DOUBLE,
                                &stats.mean_ms, "density", G_TYPE_DOUBLE, &stats.density, nullptr));
  EXPECT_TRUE(gst_structure_get(
      structure, "wrong-times", G_TYPE_UINT64, &stats.wrong_times, "difference-ms", G_TYPE_DOUBLE,
      &stats.difference_ms, "difference-spread-ms", G_TYPE_DOUBLE, &stats.difference_spread_ms,
      "difference-drift", G_TYPE_DOUBLE, &stats.difference_drift, nullptr));
  return stats;
}

GstSegment time_segment() {
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  return segment;
}

StereoHarness::StereoHarness(const std::string& properties, bool live) {
  element_ = make_element(properties);
  bus_ = gst_bus_new();
  gst_element_set_bus(element_, bus_);
  left_ = new_harness(element_, "sink_left", "src", live);
  right_ = new_harness(element_, "sink_right", nullptr, live);
}

StereoHarness::~StereoHarness() {
  gst_element_set_bus(element_, nullptr);
  // The element's thread queries the pads of both harnesses while it runs.
  gst_element_set_state(element_, GST_STATE_NULL);
  gst_harness_teardown(right_);
  gst_harness_teardown(left_);
  gst_object_unref(element_);
  gst_object_unref(bus_);
}

void StereoHarness::caps(Side which, const std::string& text) {
  gst_harness_set_src_caps_str(side(which), text.c_str());
}

void StereoHarness::caps(const std::string& left, const std::string& right) {
  caps(Side::kLeft, left);
  caps(Side::kRight, right);
}

GstFlowReturn StereoHarness::push(Side which, GstBuffer* buffer) {
  return gst_harness_push(side(which), buffer);
}

void StereoHarness::push_pair(const Pair& pair, GstClockTime pts, const Layout& left,
                              const Layout& right) {
  push(Side::kLeft, frame_buffer(pair.left, pts, kFrame, left));
  push(Side::kRight, frame_buffer(pair.right, pts, kFrame, right));
}

bool StereoHarness::event(Side which, GstEvent* event) {
  return gst_harness_push_event(side(which), event);
}

void StereoHarness::segment(const GstSegment& segment) {
  for (const Side side : {Side::kLeft, Side::kRight}) event(side, gst_event_new_segment(&segment));
}

void StereoHarness::flush(std::uint32_t seqnum) {
  const auto send = [&](Side side, GstEvent* flush) {
    gst_event_set_seqnum(flush, seqnum);
    event(side, flush);
  };
  for (const Side side : {Side::kLeft, Side::kRight}) send(side, gst_event_new_flush_start());
  for (const Side side : {Side::kLeft, Side::kRight}) send(side, gst_event_new_flush_stop(TRUE));
  segment();
}

BufferPointer StereoHarness::pull(double seconds) {
  BufferPointer buffer;
  wait_until(seconds, [&] {
    buffer.reset(gst_harness_try_pull(left_));
    return buffer != nullptr;
  });
  return buffer;
}

EventPointer StereoHarness::pull_event(GstEventType type, double seconds) {
  EventPointer event;
  wait_until(seconds, [&] {
    event.reset(gst_harness_try_pull_event(left_));
    return event != nullptr && GST_EVENT_TYPE(event.get()) == type;
  });
  if (event && GST_EVENT_TYPE(event.get()) != type) event.reset();
  return event;
}

bool StereoHarness::silent(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  return gst_harness_buffers_in_queue(left_) == 0;
}

Report StereoHarness::report(GstMessageType type, double seconds) {
  const MessagePointer message(
      gst_bus_timed_pop_filtered(bus_, static_cast<GstClockTime>(seconds * GST_SECOND), type));
  return message ? report_of(message.get()) : Report{};
}

std::vector<Report> StereoHarness::warnings(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  std::vector<Report> all;
  while (const auto message = MessagePointer(gst_bus_pop_filtered(bus_, GST_MESSAGE_WARNING))) {
    all.push_back(report_of(message.get()));
  }
  return all;
}

StructurePointer StereoHarness::message(const char* name, double seconds) {
  StructurePointer found;
  wait_until(seconds, [&] {
    const MessagePointer next(gst_bus_pop_filtered(bus_, GST_MESSAGE_ELEMENT));
    if (next && gst_message_has_name(next.get(), name)) {
      found.reset(gst_structure_copy(gst_message_get_structure(next.get())));
    }
    return found != nullptr;
  });
  return found;
}

int StereoHarness::further_errors(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  int count = 0;
  while (MessagePointer(gst_bus_pop_filtered(bus_, GST_MESSAGE_ERROR))) ++count;
  return count;
}

bool StereoHarness::wait_for_stats(std::uint64_t pairs, std::uint64_t dropped_left,
                                   std::uint64_t dropped_right) const {
  return wait_until(20, [&] {
    const Stats now = stats();
    return now.pairs == pairs && now.dropped_left == dropped_left &&
           now.dropped_right == dropped_right;
  });
}

CapsPointer StereoHarness::output_caps() const {
  GstPad* pad = gst_element_get_static_pad(element_, "src");
  CapsPointer caps(gst_pad_get_current_caps(pad));
  gst_object_unref(pad);
  return caps;
}

Feeder::Feeder(StereoHarness& harness, Side side, const Pair& pair,
               std::vector<GstClockTime> times) {
  thread_ = std::thread([&harness, side, &pair, times = std::move(times)] {
    const GrayImage& image = side == Side::kLeft ? pair.left : pair.right;
    for (const GstClockTime time : times) {
      if (harness.push(side, frame_buffer(image, time, kFrame)) != GST_FLOW_OK) return;
    }
    harness.end(side);
  });
}

void Feeder::join() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace mtstereo::test
