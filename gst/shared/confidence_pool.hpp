// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// The buffer pool of one element's confidence maps. A buffer returns to the pool when the last
/// disparity map that refers to it is freed, so the number of buffers is the largest number of maps
/// that were in use at the same time.
class ConfidencePool {
 public:
  ConfidencePool() = default;
  ~ConfidencePool() { clear(); }
  ConfidencePool(const ConfidencePool&) = delete;
  ConfidencePool& operator=(const ConfidencePool&) = delete;

  /// Configures the pool for this stream of disparity maps: size, framerate and pixel aspect ratio.
  /// Does nothing if they are unchanged. False if the pool cannot be activated.
  bool fit(const GstVideoInfo& disparity);
  /// Frees the pool. Maps that are in use remain valid.
  void clear();

  /// A writable buffer for a map, or NULL if there is no memory. Call fit() first.
  BufferPointer acquire();
  /// The sample for the meta: the map with its caps, and the time stamp, duration and offsets of
  /// the disparity map it belongs to.
  SamplePointer finish(BufferPointer map, const GstBuffer* disparity) const;

  /// The video info of the maps.
  const GstVideoInfo& info() const { return info_; }

 private:
  GstVideoInfo info_{};
  CapsPointer caps_;
  GstBufferPool* pool_ = nullptr;
};

}  // namespace mtstereo::plugin
