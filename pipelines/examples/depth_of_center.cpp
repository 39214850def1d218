// SPDX-License-Identifier: LGPL-2.1-or-later
// depth-of-center: a sample application that reads the disparity. It takes two files or two
// cameras, gets each disparity frame from an appsink, and prints the distance at the center of the
// left image.
#include <gst/app/gstappsink.h>
#include <gst/gst.h>
#include <gst/video/video.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Options {
  std::string left, right;
  double focal = 0, baseline = 0;
  int max_disparity = 0;
  int window = 9;
  int timeout = 20;
};

struct Unref {
  void operator()(gpointer object) const { gst_object_unref(object); }
  void operator()(GstSample* sample) const { gst_sample_unref(sample); }
  void operator()(GstMessage* message) const { gst_message_unref(message); }
};
template <typename T>
using Owned = std::unique_ptr<T, Unref>;

// Stops the pipeline before it is released, on every path.
class Pipeline {
 public:
  explicit Pipeline(const std::string& description) {
    GError* error = nullptr;
    pipeline_.reset(gst_parse_launch(description.c_str(), &error));
    if (error != nullptr) {
      const std::string reason = error->message;
      g_error_free(error);
      throw std::runtime_error("cannot create the pipeline: " + reason);
    }
  }
  ~Pipeline() { gst_element_set_state(pipeline_.get(), GST_STATE_NULL); }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  Owned<GstElement> element(const char* name) const {
    return Owned<GstElement>(gst_bin_get_by_name(GST_BIN(pipeline_.get()), name));
  }

  void play() const { gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING); }

  // The first posted error with its details; "" if there is none.
  std::string error() const {
    const Owned<GstBus> bus(gst_element_get_bus(pipeline_.get()));
    const Owned<GstMessage> message(gst_bus_pop_filtered(bus.get(), GST_MESSAGE_ERROR));
    if (!message) return "";
    GError* error = nullptr;
    gchar* details = nullptr;
    gst_message_parse_error(message.get(), &error, &details);
    std::string text = error->message;
    if (details != nullptr) text += std::string("\n") + details;
    g_error_free(error);
    g_free(details);
    return text;
  }

 private:
  Owned<GstElement> pipeline_;
};

// A video frame that is mapped for reading during its lifetime.
class MappedFrame {
 public:
  explicit MappedFrame(GstSample* sample) {
    GstVideoInfo info;
    if (!gst_video_info_from_caps(&info, gst_sample_get_caps(sample)) ||
        !gst_video_frame_map(&frame_, &info, gst_sample_get_buffer(sample), GST_MAP_READ)) {
      throw std::runtime_error("a disparity frame cannot be read");
    }
  }
  ~MappedFrame() { gst_video_frame_unmap(&frame_); }
  MappedFrame(const MappedFrame&) = delete;
  MappedFrame& operator=(const MappedFrame&) = delete;

  int width() const { return GST_VIDEO_FRAME_WIDTH(&frame_); }
  int height() const { return GST_VIDEO_FRAME_HEIGHT(&frame_); }
  int value(int x, int y) const {
    const auto* row = static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame_, 0)) +
                      static_cast<std::ptrdiff_t>(y) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame_, 0);
    return row[2 * x] | row[2 * x + 1] << 8;  // GRAY16_LE
  }

 private:
  GstVideoFrame frame_{};
};

std::string source(const std::string& name, const std::string& place) {
  const bool camera = place.rfind("/dev/", 0) == 0;
  return (camera ? "v4l2src name=" : "filesrc name=") + name +
         " ! decodebin ! videoconvert ! queue ! m.sink_" + name + "  ";
}

// Set as a property, so that the parser does not interpret the characters of a file name.
void set_place(const Pipeline& pipeline, const char* name, const std::string& place) {
  const Owned<GstElement> element = pipeline.element(name);
  const bool camera = place.rfind("/dev/", 0) == 0;
  g_object_set(element.get(), camera ? "device" : "location", place.c_str(), nullptr);
}

// The median of the disparities around the center [px]; empty if there is none.
std::optional<double> center_disparity(const MappedFrame& frame, int window, int scale,
                                       int offset) {
  std::vector<int> known;
  const int x0 = frame.width() / 2, y0 = frame.height() / 2, half = window / 2;
  for (int y = std::max(0, y0 - half); y <= std::min(frame.height() - 1, y0 + half); ++y) {
    for (int x = std::max(0, x0 - half); x <= std::min(frame.width() - 1, x0 + half); ++x) {
      if (const int value = frame.value(x, y); value != 0) known.push_back(value);
    }
  }
  if (known.empty()) return std::nullopt;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  return static_cast<double>(*middle) / scale + offset;
}

void print(GstSample* sample, const Options& o) {
  int scale = 256;
  int offset = 0;
  const GstStructure* caps = gst_caps_get_structure(gst_sample_get_caps(sample), 0);
  gst_structure_get_int(caps, "disparity-scale", &scale);
  gst_structure_get_int(caps, "disparity-offset", &offset);
  const GstBuffer* buffer = gst_sample_get_buffer(sample);
  const auto disparity = center_disparity(MappedFrame(sample), o.window, scale, offset);
  if (GST_BUFFER_PTS_IS_VALID(buffer)) {
    std::printf("%8.3f s  ", static_cast<double>(GST_BUFFER_PTS(buffer)) / GST_SECOND);
  }
  if (!disparity) {
    std::printf("no disparity at the center\n");
  } else if (o.focal > 0 && o.baseline > 0 && *disparity > 0) {
    std::printf("disparity %7.2f px  distance %7.3f m\n", *disparity,
                o.focal * o.baseline / *disparity);
  } else {
    std::printf("disparity %7.2f px\n", *disparity);
  }
  std::fflush(stdout);
}

int run(const Options& o) {
  std::string description = source("left", o.left) + source("right", o.right) + "mtstereo name=m ";
  if (o.max_disparity > 0) description += "max-disparity=" + std::to_string(o.max_disparity) + " ";
  const Pipeline pipeline(description + "! appsink name=disparity sync=false max-buffers=2");
  set_place(pipeline, "left", o.left);
  set_place(pipeline, "right", o.right);
  const Owned<GstElement> sink = pipeline.element("disparity");
  pipeline.play();

  constexpr GstClockTime kStep = 100 * GST_MSECOND;
  GstClockTime waited = 0;
  while (waited < static_cast<GstClockTime>(o.timeout) * GST_SECOND) {
    const Owned<GstSample> sample(gst_app_sink_try_pull_sample(GST_APP_SINK(sink.get()), kStep));
    if (sample) {
      print(sample.get(), o);
      waited = 0;
      continue;
    }
    if (const std::string error = pipeline.error(); !error.empty()) {
      throw std::runtime_error(error);
    }
    if (gst_app_sink_is_eos(GST_APP_SINK(sink.get()))) return 0;
    waited += kStep;
  }
  throw std::runtime_error("no disparity frame for " + std::to_string(o.timeout) +
                           " s; check that both inputs run and have equal time stamps");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Prints the disparity and the distance at the center of the left image.",
                 "depth-of-center");
    Options o;
    app.add_option("left", o.left, "video file, or a camera such as /dev/video0")->required();
    app.add_option("right", o.right, "video file, or a camera such as /dev/video2")->required();
    app.add_option("--focal", o.focal, "focal length [px]")->check(CLI::PositiveNumber);
    app.add_option("--baseline", o.baseline, "distance between the cameras [m]")
        ->check(CLI::PositiveNumber);
    app.add_option("--max-disparity", o.max_disparity, "search range [px]")
        ->check(CLI::Range(1, 1024));
    app.add_option("--window", o.window, "side of the square around the center [px]")
        ->check(CLI::Range(1, 1001))
        ->capture_default_str();
    app.add_option("--timeout", o.timeout, "exit with an error after this time without a frame [s]")
        ->check(CLI::Range(1, 3600))
        ->capture_default_str();
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? 0 : 2;
    }
    gst_init(nullptr, nullptr);
    return run(o);
  } catch (const std::exception& error) {
    std::cerr << "depth-of-center: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "depth-of-center: unknown error\n";
  }
  return 1;
}
