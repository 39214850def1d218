// SPDX-License-Identifier: LGPL-2.1-or-later
// Any caps on the pads of the elements. The first byte selects the element; the lines that follow
// are the caps of its sink pad or pads, and the last one those that downstream accepts.
#include <gst/video/video.h>

#include <array>
#include <string>

#include "fuzz_folder.hpp"
#include "fuzz_gst.hpp"
#include "fuzz_input.hpp"

namespace mtstereo::fuzz {
namespace {

/// Queries with the caps as they are, which may be a choice.
void query_with(GstElement* element, const char* pad_name, const std::string& text) {
  const CapsPointer filter = parsed_caps(text);
  if (!filter) return;
  GstPad* pad = gst_element_get_static_pad(element, pad_name);
  const CapsPointer accepted(gst_pad_query_caps(pad, filter.get()));
  require(gst_caps_is_subset(accepted.get(), filter.get()), "the filter limits the answer");
  const CapsPointer all(gst_pad_query_caps(pad, nullptr));
  require(accepted && all, "the caps query is answered");
  if (const CapsPointer fixed = fixed_caps(text)) gst_pad_query_accept_caps(pad, fixed.get());
  gst_object_unref(pad);
}

/// Sends the caps, and a frame of the size that they need, if they describe video.
void send_caps(GstHarness* harness, const std::string& text, unsigned seed) {
  const CapsPointer caps = fixed_caps(text);
  if (!caps) return;
  gst_harness_push_event(harness, gst_event_new_caps(caps.get()));
  GstVideoInfo info;
  if (!gst_video_info_from_caps(&info, caps.get()) || info.size > (1U << 22)) return;
  GstBuffer* buffer = pattern_buffer(info.size, seed);
  GST_BUFFER_PTS(buffer) = 0;
  gst_harness_push(harness, buffer);
}

void start_stream(GstHarness* harness, const char* name) {
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  gst_harness_push_event(harness, gst_event_new_stream_start(name));
  gst_harness_push_event(harness, gst_event_new_segment(&segment));
}

void restrict_downstream(GstHarness* harness, const std::string& text) {
  CapsPointer caps = parsed_caps(text);
  if (caps && !gst_caps_is_empty(caps.get())) gst_harness_set_sink_caps(harness, caps.release());
}

/// Waits until downstream got an event of this type, unless the element has failed.
void wait_for(GstHarness* harness, TestedElement& element, GstEventType type) {
  const gint64 end = g_get_monotonic_time() + 10 * G_TIME_SPAN_SECOND;
  while (!element.has_failed()) {
    const EventPointer event(gst_harness_try_pull_event(harness));
    if (event && GST_EVENT_TYPE(event.get()) == type) return;
    if (event) continue;
    require(g_get_monotonic_time() < end, "the output ends after both inputs");
    g_usleep(100);
  }
}

void test_matcher(const std::array<std::string, 3>& texts) {
  TestedElement element("mtstereo");
  g_object_set(element.get(), "max-disparity", 4, "threads", 1, nullptr);
  GstHarness* left = gst_harness_new_with_element(element.get(), "sink_left", "src");
  GstHarness* right = gst_harness_new_with_element(element.get(), "sink_right", nullptr);
  restrict_downstream(left, texts[2]);
  query_with(element.get(), "sink_left", texts[0]);
  start_stream(left, "left");
  start_stream(right, "right");
  send_caps(left, texts[0], 1);
  query_with(element.get(), "sink_right", texts[1]);
  send_caps(right, texts[1], 2);
  query_with(element.get(), "src", texts[2]);
  gst_harness_push_event(left, gst_event_new_eos());
  gst_harness_push_event(right, gst_event_new_eos());
  wait_for(left, element, GST_EVENT_EOS);
  // The element's thread queries the pads of both harnesses while it runs.
  gst_element_set_state(element.get(), GST_STATE_NULL);
  gst_harness_teardown(right);
  gst_harness_teardown(left);
}

void test_filter(TestedElement& element, const char* source,
                 const std::array<std::string, 3>& texts) {
  GstHarness* harness = gst_harness_new_with_element(element.get(), "sink", source);
  restrict_downstream(harness, texts[2]);
  query_with(element.get(), "sink", texts[0]);
  query_with(element.get(), source, texts[2]);
  start_stream(harness, "maps");
  send_caps(harness, texts[0], 1);
  send_caps(harness, texts[1], 2);
  gst_harness_push_event(harness, gst_event_new_eos());
  gst_harness_teardown(harness);
}

void test_filter(const char* factory, const std::array<std::string, 3>& texts) {
  TestedElement element(factory);
  test_filter(element, "src", texts);
}

std::string matrix(const char* name, int rows, int columns, const char* numbers) {
  return std::string(name) + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: [ " + numbers + " ]\n";
}

/// The file of a calibration that fits every size.
const std::string& calibration_file() {
  static const std::string file = folder().write(
      "calibration.yml",
      "%YAML:1.0\n---\n" + matrix("M1", 3, 3, "40, 0, 16, 0, 40, 8, 0, 0, 1") +
          matrix("M2", 3, 3, "40, 0, 17, 0, 40, 8, 0, 0, 1") +
          matrix("D1", 1, 4, "-0.1, 0.01, 0, 0") + matrix("D2", 1, 4, "-0.1, 0, 0.001, 0") +
          matrix("R", 3, 3, "1, 0, 0, 0, 1, 0, 0, 0, 1") + matrix("T", 3, 1, "-0.1, 0, 0"));
  return file;
}

void test_rectifier(const std::array<std::string, 3>& texts) {
  TestedElement element("mtrectify");
  g_object_set(element.get(), "calibration", calibration_file().c_str(), "color", TRUE, nullptr);
  test_filter(element, "src", texts);
}

void test_splitter(const std::array<std::string, 3>& texts) {
  TestedElement element("mtsplit");
  GstHarness* right = gst_harness_new_with_element(element.get(), nullptr, "right");
  query_with(element.get(), "right", texts[1]);
  test_filter(element, "left", texts);
  gst_harness_teardown(right);
}

/// The second line has the caps of the left view.
void test_cloud(const std::array<std::string, 3>& texts) {
  TestedElement element("mtcloud");
  g_object_set(element.get(), "location", (folder().path() / "cloud.ply").c_str(), "focal-length",
               40.0, "baseline", 0.1, "timeout", GstClockTime{1'000'000}, nullptr);
  GstHarness* left = gst_harness_new_with_element(element.get(), "sink_left", nullptr);
  GstHarness* maps = gst_harness_new_with_element(element.get(), "sink", nullptr);
  query_with(element.get(), "sink_left", texts[1]);
  query_with(element.get(), "sink", texts[0]);
  start_stream(left, "left");
  start_stream(maps, "maps");
  send_caps(left, texts[1], 1);
  send_caps(maps, texts[0], 2);
  send_caps(maps, texts[2], 3);
  gst_harness_push_event(left, gst_event_new_eos());
  gst_harness_push_event(maps, gst_event_new_eos());
  gst_element_set_state(element.get(), GST_STATE_NULL);
  gst_harness_teardown(maps);
  gst_harness_teardown(left);
}

void test_element(int index, const std::array<std::string, 3>& texts) {
  switch (index) {
    case 0:
      return test_matcher(texts);
    case 1:
      return test_filter("mtcolor", texts);
    case 2:
      return test_filter("mtconfidence", texts);
    case 3:
      return test_filter("mtdepth", texts);
    case 4:
      return test_rectifier(texts);
    case 5:
      return test_splitter(texts);
    default:
      return test_cloud(texts);
  }
}

}  // namespace
}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mtstereo::fuzz;
  FuzzInput input(data, size);
  const int element = input.byte() % 7;
  std::array<std::string, 3> texts;
  for (std::string& text : texts) {
    // GStreamer's own functions do not take text that is not UTF-8.
    const std::string_view line = input.line();
    if (g_utf8_validate(line.data(), static_cast<gssize>(line.size()), nullptr)) text = line;
  }
  test_element(element, texts);
  return 0;
}
