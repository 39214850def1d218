// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/confidence_pool.hpp"

namespace mtstereo::plugin {

bool ConfidencePool::fit(const GstVideoInfo& disparity) {
  GstVideoInfo info;
  if (!gst_video_info_set_format(&info, GST_VIDEO_FORMAT_GRAY8, static_cast<guint>(disparity.width),
                                 static_cast<guint>(disparity.height))) {
    return false;
  }
  info.fps_n = disparity.fps_n;
  info.fps_d = disparity.fps_d;
  info.par_n = disparity.par_n;
  info.par_d = disparity.par_d;
  if (pool_ != nullptr && gst_video_info_is_equal(&info, &info_)) return true;

  clear();
  info_ = info;
  caps_.reset(gst_video_info_to_caps(&info));
  pool_ = gst_buffer_pool_new();
  GstStructure* config = gst_buffer_pool_get_config(pool_);
  gst_buffer_pool_config_set_params(config, caps_.get(), static_cast<guint>(info.size), 0, 0);
  if (gst_buffer_pool_set_config(pool_, config) && gst_buffer_pool_set_active(pool_, TRUE)) {
    return true;
  }
  clear();
  return false;
}

void ConfidencePool::clear() {
  if (pool_ == nullptr) return;
  gst_buffer_pool_set_active(pool_, FALSE);
  gst_object_unref(pool_);
  pool_ = nullptr;
}

BufferPointer ConfidencePool::acquire() {
  GstBuffer* map = nullptr;
  if (gst_buffer_pool_acquire_buffer(pool_, &map, nullptr) != GST_FLOW_OK) return nullptr;
  return BufferPointer(map);
}

SamplePointer ConfidencePool::finish(BufferPointer map, const GstBuffer* disparity) const {
  GST_BUFFER_PTS(map.get()) = GST_BUFFER_PTS(disparity);
  GST_BUFFER_DURATION(map.get()) = GST_BUFFER_DURATION(disparity);
  GST_BUFFER_OFFSET(map.get()) = GST_BUFFER_OFFSET(disparity);
  GST_BUFFER_OFFSET_END(map.get()) = GST_BUFFER_OFFSET_END(disparity);
  return SamplePointer(gst_sample_new(map.get(), caps_.get(), nullptr, nullptr));
}

}  // namespace mtstereo::plugin
