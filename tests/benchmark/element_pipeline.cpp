// SPDX-License-Identifier: LGPL-2.1-or-later
#include "element_pipeline.hpp"

#include <gst/app/gstappsrc.h>
#include <gst/video/video.h>

#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>

namespace mtstereo::bench {
namespace {

constexpr GstClockTime kFrameTime = GST_SECOND / 30;
constexpr std::chrono::seconds kPatience(60);          // for one disparity map
constexpr std::chrono::milliseconds kErrorCheck(100);  // period of the check for errors

GstVideoInfo gray_info(cv::Size size) {
  GstVideoInfo info;
  if (!gst_video_info_set_format(&info, GST_VIDEO_FORMAT_GRAY8, size.width, size.height)) {
    throw std::runtime_error("GStreamer does not support images of " + std::to_string(size.width) +
                             "x" + std::to_string(size.height));
  }
  info.fps_n = static_cast<int>(GST_SECOND / kFrameTime);
  info.fps_d = 1;
  return info;
}

GstElement* parsed(const std::string& launch) {
  g_autoptr(GError) error = nullptr;
  GstElement* pipeline =
      gst_parse_launch_full(launch.c_str(), nullptr, GST_PARSE_FLAG_FATAL_ERRORS, &error);
  if (pipeline != nullptr) return pipeline;
  std::string message = error->message;
  if (g_error_matches(error, GST_PARSE_ERROR, GST_PARSE_ERROR_NO_SUCH_ELEMENT)) {
    message += ": GST_PLUGIN_PATH must name the folder of the plugin, such as build/gst";
  }
  throw std::runtime_error(message);
}

GstElement* named(GstElement* pipeline, const char* name) {
  return gst_bin_get_by_name(GST_BIN(pipeline), name);
}

/// The queues of the sources are unlimited; nothing waits for a clock.
std::string launch_line(const std::string& properties) {
  const std::string source = "appsrc format=time block=false max-bytes=0 name=";
  return "mtstereo name=m " + properties +
         " ! fakesink name=out sync=false enable-last-sample=false signal-handoffs=true " + source +
         "left ! m.sink_left " + source + "right ! m.sink_right";
}

}  // namespace

GrayBuffer::GrayBuffer(const cv::Mat& image) {
  const GstVideoInfo info = gray_info(image.size());
  buffer_.reset(gst_buffer_new_allocate(nullptr, info.size, nullptr));
  if (buffer_ == nullptr || !gst_buffer_map(buffer_.get(), &map_, GST_MAP_READWRITE)) {
    throw std::runtime_error("no memory for a frame");
  }
  const int stride = info.stride[0];
  for (int y = 0; y < image.rows; ++y) {
    std::memcpy(map_.data + static_cast<std::ptrdiff_t>(y) * stride, image.ptr(y),
                static_cast<std::size_t>(image.cols));
  }
  gst_buffer_unmap(buffer_.get(), &map_);
  if (!gst_buffer_map(buffer_.get(), &map_, GST_MAP_READ)) {
    throw std::runtime_error("a frame cannot be read");
  }
  view_ = {map_.data, image.cols, image.rows, stride};
}

GrayBuffer::~GrayBuffer() { gst_buffer_unmap(buffer_.get(), &map_); }

BufferPointer GrayBuffer::stamped(GstClockTime time, GstClockTime duration) const {
  BufferPointer copy(gst_buffer_copy(buffer_.get()));
  GST_BUFFER_PTS(copy.get()) = time;
  GST_BUFFER_DURATION(copy.get()) = duration;
  return copy;
}

ElementPipeline::ElementPipeline(const std::string& properties, int width, int height)
    : size_(width, height),
      pipeline_(parsed(launch_line(properties))),
      left_(named(pipeline_.get(), "left")),
      right_(named(pipeline_.get(), "right")),
      sink_(named(pipeline_.get(), "out")),
      bus_(gst_element_get_bus(pipeline_.get())) {
  const GstVideoInfo info = gray_info(size_);
  g_autoptr(GstCaps) caps = gst_video_info_to_caps(&info);
  for (const auto* source : {&left_, &right_}) {
    gst_app_src_set_caps(GST_APP_SRC(source->get()), caps);
  }
  g_signal_connect(sink_.get(), "handoff", G_CALLBACK(take), this);
  if (gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING) == GST_STATE_CHANGE_FAILURE) {
    require_no_error();
    throw std::runtime_error("the pipeline does not start");
  }
}

ElementPipeline::~ElementPipeline() { gst_element_set_state(pipeline_.get(), GST_STATE_NULL); }

std::vector<ElementPipeline::Clock::time_point> ElementPipeline::match(const PairList& pairs,
                                                                       int count) {
  push(pairs, count);
  wait_for(static_cast<std::size_t>(count));
  const std::lock_guard lock(mutex_);
  return std::exchange(times_, {});
}

std::vector<cv::Mat> ElementPipeline::maps(const PairList& pairs) {
  {
    const std::lock_guard lock(mutex_);
    keep_maps_ = true;
  }
  match(pairs, static_cast<int>(pairs.size()));
  const std::lock_guard lock(mutex_);
  keep_maps_ = false;
  return std::exchange(maps_, {});
}

void ElementPipeline::push(const PairList& pairs, int count) {
  for (int i = 0; i < count; ++i) {
    const PairBuffers& pair = *pairs[static_cast<std::size_t>(i) % pairs.size()];
    for (const auto& [image, source] :
         {std::pair{&pair.left, left_.get()}, {&pair.right, right_.get()}}) {
      BufferPointer buffer = image->stamped(next_time_, kFrameTime);
      if (gst_app_src_push_buffer(GST_APP_SRC(source), buffer.release()) != GST_FLOW_OK) {
        require_no_error();
        throw std::runtime_error("the pipeline accepts no frames");
      }
    }
    next_time_ += kFrameTime;
  }
}

void ElementPipeline::wait_for(std::size_t count) {
  std::unique_lock lock(mutex_);
  std::size_t seen = times_.size();
  Clock::time_point last = Clock::now();
  while (times_.size() < count) {
    came_.wait_for(lock, kErrorCheck);
    require_no_error();
    if (!problem_.empty()) throw std::runtime_error(problem_);
    if (times_.size() > seen) {
      seen = times_.size();
      last = Clock::now();
    } else if (Clock::now() - last > kPatience) {
      throw std::runtime_error("the element produced no disparity map within " +
                               std::to_string(kPatience.count()) + " s");
    }
  }
}

void ElementPipeline::require_no_error() const {
  GstMessage* message = gst_bus_pop_filtered(bus_.get(), GST_MESSAGE_ERROR);
  if (message == nullptr) return;
  g_autoptr(GError) error = nullptr;
  g_autofree gchar* details = nullptr;
  gst_message_parse_error(message, &error, &details);
  gst_message_unref(message);
  throw std::runtime_error(error->message);
}

void ElementPipeline::take(GstElement*, GstBuffer* buffer, GstPad*, gpointer self) {
  const Clock::time_point now = Clock::now();
  auto& pipeline = *static_cast<ElementPipeline*>(self);
  const std::lock_guard lock(pipeline.mutex_);
  try {
    pipeline.times_.push_back(now);
    if (pipeline.keep_maps_) {
      cv::Mat map(pipeline.size_, CV_16UC1);
      const std::size_t row = map.cols * sizeof(std::uint16_t);
      const std::size_t stride = GST_ROUND_UP_4(row);
      for (int y = 0; y < map.rows; ++y) {
        if (gst_buffer_extract(buffer, y * stride, map.ptr(y), row) != row) {
          throw std::runtime_error("a disparity map of the element is too short");
        }
      }
      pipeline.maps_.push_back(map);
    }
  } catch (const std::exception& error) {
    // No exception may propagate into GStreamer; the waiting thread rethrows it.
    pipeline.problem_ = error.what();
  }
  pipeline.came_.notify_one();
}

}  // namespace mtstereo::bench
