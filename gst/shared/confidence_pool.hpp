// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// The memory of one element's confidence maps. A map's memory is used again when the last
/// disparity map that carries it is freed, so a stream allocates as many as are held at one time.
class ConfidencePool {
 public:
  ConfidencePool() = default;
  ~ConfidencePool() { clear(); }
  ConfidencePool(const ConfidencePool&) = delete;
  ConfidencePool& operator=(const ConfidencePool&) = delete;

  /// Gets ready for maps of this stream of disparity maps: its size, framerate and pixel aspect
  /// ratio. False where the memory cannot be had.
  bool fit(const GstVideoInfo& disparity);
  /// Gives the memory up; maps that are still held stay as they are.
  void clear();

  /// A map to be written, or NULL where there is no memory. Only after fit().
  BufferPointer acquire();
  /// The map as a program gets it: with its caps, and the times of the disparity map it belongs to.
  SamplePointer finish(BufferPointer map, const GstBuffer* disparity) const;

  /// Of the maps.
  const GstVideoInfo& info() const { return info_; }

 private:
  GstVideoInfo info_{};
  CapsPointer caps_;
  GstBufferPool* pool_ = nullptr;
};

}  // namespace mtstereo::plugin
