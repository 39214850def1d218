// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "frames.hpp"

namespace mtstereo::bench {

struct UnrefBuffer {
  void operator()(GstBuffer* buffer) const { gst_buffer_unref(buffer); }
};
using BufferPointer = std::unique_ptr<GstBuffer, UnrefBuffer>;

/// An image in its own GStreamer buffer, GRAY8, which the library can read too.
class GrayBuffer {
 public:
  /// Copies the image. Throws std::runtime_error if memory is exhausted.
  explicit GrayBuffer(const cv::Mat& image);
  ~GrayBuffer();
  GrayBuffer(const GrayBuffer&) = delete;
  GrayBuffer& operator=(const GrayBuffer&) = delete;

  GrayView view() const { return view_; }
  /// Another buffer with the same memory and this time stamp.
  BufferPointer stamped(GstClockTime time, GstClockTime duration) const;

 private:
  BufferPointer buffer_;
  GstMapInfo map_{};
  GrayView view_{};
};

/// A pair as buffers.
struct PairBuffers {
  explicit PairBuffers(const Pair& pair) : left(pair.left), right(pair.right) {}
  GrayBuffer left;
  GrayBuffer right;
};
using PairList = std::vector<std::unique_ptr<PairBuffers>>;

/// The element `mtstereo` between two sources in memory and a sink that discards its input.
class ElementPipeline {
 public:
  using Clock = std::chrono::steady_clock;

  /// `properties` has the form "threads=2 max-disparity=64". Throws std::runtime_error, like all
  /// other methods, with the message of the element or of GStreamer.
  ElementPipeline(const std::string& properties, int width, int height);
  ~ElementPipeline();
  ElementPipeline(const ElementPipeline&) = delete;
  ElementPipeline& operator=(const ElementPipeline&) = delete;

  /// Sends `count` pairs in a cycle as fast as the element accepts them, and returns the time at
  /// which each disparity map arrived.
  std::vector<Clock::time_point> match(const PairList& pairs, int count);
  /// Sends each pair once and returns the maps (CV_16UC1) in the order of arrival.
  std::vector<cv::Mat> maps(const PairList& pairs);

 private:
  static void take(GstElement* sink, GstBuffer* buffer, GstPad* pad, gpointer self);
  void push(const PairList& pairs, int count);
  void wait_for(std::size_t count);
  void require_no_error() const;

  struct Unref {
    void operator()(gpointer object) const { gst_object_unref(object); }
  };
  template <typename T>
  using Pointer = std::unique_ptr<T, Unref>;

  struct Stop {
    void operator()(GstElement* pipeline) const {
      gst_element_set_state(pipeline, GST_STATE_NULL);
      gst_object_unref(pipeline);
    }
  };

  cv::Size size_;
  std::unique_ptr<GstElement, Stop> pipeline_;
  Pointer<GstElement> left_, right_, sink_;
  Pointer<GstBus> bus_;
  GstClockTime next_time_ = 0;

  std::mutex mutex_;  // guards the following members, which the sink's thread writes
  std::condition_variable came_;
  std::vector<Clock::time_point> times_;
  std::vector<cv::Mat> maps_;
  bool keep_maps_ = false;
  std::string problem_;
};

}  // namespace mtstereo::bench
