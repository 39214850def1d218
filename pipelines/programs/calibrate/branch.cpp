// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/branch.hpp"

#include <gst/video/video.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include "lib/media/decoding_problem.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/calibrate/source.hpp"
#include "shared/decoder_crashes.hpp"
#include "shared/orientation.hpp"

namespace mtstereo::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr GstClockTime kSlice = 50 * GST_MSECOND;

// A text as the value of a property in a gst-launch line.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char each : text) {
    if (each == '"' || each == '\\') result += '\\';
    result += each;
  }
  return result + "\"";
}

std::string device_line(const std::string& device, const SourceOptions& options) {
  std::string caps;
  if (!options.size.empty()) {
    caps += ",width=" + std::to_string(options.size.width) +
            ",height=" + std::to_string(options.size.height);
  }
  if (options.rate > 0) {
    caps += ",framerate=" + std::to_string(std::lround(options.rate * 1000)) + "/1000";
  }
  const std::string wanted =
      caps.empty() ? ""
                   : " ! capsfilter caps=" + quoted("video/x-raw" + caps + ";image/jpeg" + caps);
  return "v4l2src device=" + quoted(device) + wanted + " ! decodebin";
}

void on_element(GstBin*, GstBin*, GstElement* added, gpointer) {
  plugin::keep_from_crashing(added);
}

bool is_element(const std::string& text) {
  const std::string name = text.substr(0, text.find(' '));
  g_autoptr(GstElementFactory) factory = gst_element_factory_find(name.c_str());
  return factory != nullptr;
}

}  // namespace

std::string launch_line(const std::string& source, const SourceOptions& options) {
  if (source.find('!') != std::string::npos) return source;
  if (source.find("://") != std::string::npos) return "uridecodebin uri=" + quoted(source);
  const bool exists = fs::exists(source);
  if (source.starts_with("/dev/")) {
    if (!exists) throw UserError(source + ": no such device");
    return device_line(source, options);
  }
  if (exists) return "filesrc location=" + quoted(source) + " ! decodebin";
  if (is_element(source)) return source;
  throw UserError(source + ": no such file, folder, device or element");
}

Branch::Branch(GstPipeline* pipeline, std::string name, std::string source,
               const SourceOptions& options)
    : name_(std::move(name)), source_(std::move(source)), is_file_(fs::is_regular_file(source_)) {
  const std::string line = launch_line(source_, options) +
                           " ! videoconvert ! video/x-raw,format=GRAY8 ! "
                           "appsink name=sink sync=false max-buffers=4 enable-last-sample=false";
  g_autoptr(GError) error = nullptr;
  bin_ = gst_parse_bin_from_description_full(line.c_str(), FALSE, nullptr,
                                             GST_PARSE_FLAG_FATAL_ERRORS, &error);
  if (bin_ == nullptr) throw UserError(title() + ": " + error->message);
  g_signal_connect(bin_, "deep-element-added", G_CALLBACK(on_element), nullptr);
  gst_bin_add(GST_BIN(pipeline), bin_);
  g_autoptr(GstElement) sink = gst_bin_get_by_name(GST_BIN(bin_), "sink");
  sink_ = GST_APP_SINK(sink);
}

std::string Branch::title() const {
  return (name_.empty() ? "" : name_ + " ") + "source (" + source_ + ")";
}

bool Branch::owns(GstObject* object) const {
  return gst_object_has_as_ancestor(object, GST_OBJECT(bin_)) != FALSE;
}

bool Branch::pull() {
  if (ended_) return false;
  const auto start = std::chrono::steady_clock::now();
  g_autoptr(GstSample) sample = gst_app_sink_try_pull_sample(sink_, kSlice);
  if (sample == nullptr) {
    waited_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ended_ = gst_app_sink_is_eos(sink_) != FALSE;
    return false;
  }
  take(sample);
  waited_ = 0;
  return true;
}

// Other programs, OpenCV among them, calibrate the turned frames. A pipeline of the user may turn
// them, which leaves the tag as it is.
void Branch::refuse_turned() const {
  if (!is_file_) return;
  g_autoptr(GstPad) pad = gst_element_get_static_pad(GST_ELEMENT(sink_), "sink");
  const std::string turning = plugin::turning_on(pad);
  if (!turning.empty()) throw UserError(title() + ": " + plugin::turning_problem(turning));
}

void Branch::take(GstSample* sample) {
  refuse_turned();
  GstVideoInfo info;
  GstVideoFrame mapped;
  GstBuffer* buffer = gst_sample_get_buffer(sample);
  if (gst_video_info_from_caps(&info, gst_sample_get_caps(sample)) == FALSE ||
      gst_video_frame_map(&mapped, &info, buffer, GST_MAP_READ) == FALSE) {
    throw UserError(title() + ": a frame cannot be read");
  }
  Frame frame;
  frame.image = cv::Mat(info.height, info.width, CV_8UC1, GST_VIDEO_FRAME_PLANE_DATA(&mapped, 0),
                        static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&mapped, 0)))
                    .clone();
  gst_video_frame_unmap(&mapped);
  const GstClockTime time = gst_segment_to_running_time(gst_sample_get_segment(sample),
                                                        GST_FORMAT_TIME, GST_BUFFER_PTS(buffer));
  if (GST_CLOCK_TIME_IS_VALID(time)) frame.time = static_cast<plugin::Nanoseconds>(time);
  if (info.fps_n > 0) {
    caps_period_ = static_cast<plugin::Nanoseconds>(
        gst_util_uint64_scale_int(GST_SECOND, info.fps_d, info.fps_n));
  }
  if (GST_BUFFER_DURATION_IS_VALID(buffer) && GST_BUFFER_DURATION(buffer) > 0) {
    buffer_period_ = static_cast<plugin::Nanoseconds>(GST_BUFFER_DURATION(buffer));
  }
  times_.push_back(frame.time.value_or(0));
  frames_.push_back(std::move(frame));
}

void Branch::erase(std::size_t index) {
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(index));
  times_.erase(times_.begin() + static_cast<std::ptrdiff_t>(index));
}

plugin::WaitingFrames Branch::waiting() const { return {times_, caps_period_.value_or(0), ended_}; }

bool Branch::is_live() const {
  // A sink that does not wait for the clock says that it is not live; its source knows.
  g_autoptr(GstPad) pad = gst_element_get_static_pad(GST_ELEMENT(sink_), "sink");
  GstQuery* query = gst_query_new_latency();
  gboolean live = FALSE;
  if (gst_pad_peer_query(pad, query) != FALSE) {
    gst_query_parse_latency(query, &live, nullptr, nullptr);
  }
  gst_query_unref(query);
  return live != FALSE;
}

void Branch::drop_old_frames() { gst_app_sink_set_drop(sink_, TRUE); }

void Branch::check_silence(double timeout) const {
  if (ended_ || waited_ <= timeout) return;
  throw UserError(title() + ": no frame for " + outputs::decimal(timeout, 0) + " s" +
                  (is_file_ ? ": " + media::without_frames(true)
                            : ". Is it sending, and is it not in use elsewhere? (--timeout)"));
}

}  // namespace mtstereo::calibrate
