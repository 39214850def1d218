// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/allocation.hpp"

#include "shared/frame_metas.hpp"

namespace mtstereo::plugin {
namespace {

constexpr guint kMinimumBuffers = 2;

/// GStreamer calls it; it calls C functions only, so that it throws nothing.
gboolean copy_meta(GstBuffer* left, GstMeta** meta, gpointer user_data) noexcept {
  const GstMetaInfo* info = (*meta)->info;
  if (info->transform_func == nullptr || belongs_to_pixels(*info)) return TRUE;
  if (info->api == GST_VIDEO_OVERLAY_COMPOSITION_META_API_TYPE) return TRUE;  // drawn on the view
  GstMetaTransformCopy whole = {FALSE, 0, static_cast<gsize>(-1)};
  info->transform_func(static_cast<GstBuffer*>(user_data), *meta, left,
                       g_quark_from_static_string("gst-copy"), &whole);
  return TRUE;
}

/// Sets the allocator of downstream, if it has one but no pool.
void use_allocator(GstQuery* query, GstStructure* config) {
  if (gst_query_get_n_allocation_params(query) == 0) return;
  GstAllocator* allocator = nullptr;
  GstAllocationParams parameters;
  gst_query_parse_nth_allocation_param(query, 0, &allocator, &parameters);
  gst_buffer_pool_config_set_allocator(config, allocator, &parameters);
  if (allocator != nullptr) gst_object_unref(allocator);
}

}  // namespace

gboolean decide_allocation(GstAggregator*, GstQuery* query) {
  GstCaps* caps = nullptr;
  gst_query_parse_allocation(query, &caps, nullptr);
  GstVideoInfo info;
  if (caps == nullptr || !gst_video_info_from_caps(&info, caps)) return FALSE;

  GstBufferPool* pool = nullptr;
  guint size = static_cast<guint>(info.size);
  guint minimum = kMinimumBuffers;
  guint maximum = 0;
  const bool offered = gst_query_get_n_allocation_pools(query) > 0;
  if (offered) {
    gst_query_parse_nth_allocation_pool(query, 0, &pool, &size, &minimum, &maximum);
    size = MAX(size, static_cast<guint>(info.size));
    minimum = MAX(minimum, kMinimumBuffers);
    if (maximum != 0) maximum = MAX(maximum, minimum);
  }
  const bool own = pool == nullptr;
  if (own) pool = gst_video_buffer_pool_new();

  GstStructure* config = gst_buffer_pool_get_config(pool);
  gst_buffer_pool_config_set_params(config, caps, size, minimum, maximum);
  if (own) use_allocator(query, config);
  if (gst_query_find_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr)) {
    gst_buffer_pool_config_add_option(config, GST_BUFFER_POOL_OPTION_VIDEO_META);
  }
  bool usable = gst_buffer_pool_set_config(pool, config);
  if (!usable) {
    // The pool may have adjusted the values to what it supports: accept them.
    config = gst_buffer_pool_get_config(pool);
    usable = gst_buffer_pool_config_validate_params(config, caps, size, minimum, maximum)
                 ? gst_buffer_pool_set_config(pool, config)
                 : (gst_structure_free(config), false);
  }
  if (!usable) {
    gst_object_unref(pool);
    pool = gst_video_buffer_pool_new();
    maximum = 0;
    config = gst_buffer_pool_get_config(pool);
    gst_buffer_pool_config_set_params(config, caps, static_cast<guint>(info.size), minimum,
                                      maximum);
    gst_buffer_pool_set_config(pool, config);
  }
  if (offered) {
    gst_query_set_nth_allocation_pool(query, 0, pool, size, minimum, maximum);
  } else {
    gst_query_add_allocation_pool(query, pool, size, minimum, maximum);
  }
  gst_object_unref(pool);
  return TRUE;
}

gboolean propose_allocation(GstAggregator*, GstAggregatorPad*, GstQuery*, GstQuery* query) {
  GstCaps* caps = nullptr;
  gst_query_parse_allocation(query, &caps, nullptr);
  GstVideoInfo info;
  if (caps == nullptr || !gst_video_info_from_caps(&info, caps)) return FALSE;
  // Every stride and offset is accepted, so upstream need not copy frames. The pad of a live stream
  // holds two frames while a third one is being matched.
  gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr);
  gst_query_add_allocation_pool(query, nullptr, static_cast<guint>(info.size), 3, 0);
  return TRUE;
}

GstFlowReturn acquire_output(GstAggregator* aggregator, gsize size, BufferPointer& buffer) {
  GstBuffer* acquired = nullptr;
  GstFlowReturn flow = GST_FLOW_OK;
  GstBufferPool* pool = gst_aggregator_get_buffer_pool(aggregator);
  if (pool != nullptr) {
    flow = gst_buffer_pool_is_active(pool) || gst_buffer_pool_set_active(pool, TRUE)
               ? gst_buffer_pool_acquire_buffer(pool, &acquired, nullptr)
               : GST_FLOW_ERROR;
    gst_object_unref(pool);
  } else {
    acquired = gst_buffer_new_allocate(nullptr, size, nullptr);
    flow = acquired != nullptr ? GST_FLOW_OK : GST_FLOW_ERROR;
  }
  buffer.reset(acquired);
  return flow;
}

void copy_frame_properties(GstBuffer* left, GstBuffer* right, GstBuffer* output) {
  constexpr guint kOfTheFrame = GST_BUFFER_FLAG_LIVE | GST_BUFFER_FLAG_DECODE_ONLY |
                                GST_BUFFER_FLAG_DISCONT | GST_BUFFER_FLAG_RESYNC |
                                GST_BUFFER_FLAG_CORRUPTED | GST_BUFFER_FLAG_MARKER |
                                GST_BUFFER_FLAG_DROPPABLE | GST_BUFFER_FLAG_NON_DROPPABLE;
  GST_BUFFER_FLAGS(output) = (GST_BUFFER_FLAGS(output) & ~kOfTheFrame) |
                             (GST_BUFFER_FLAGS(left) & kOfTheFrame) |
                             // a map of a corrupted frame is corrupted
                             (GST_BUFFER_FLAGS(right) & GST_BUFFER_FLAG_CORRUPTED);
  GST_BUFFER_PTS(output) = GST_BUFFER_PTS(left);
  GST_BUFFER_DTS(output) = GST_CLOCK_TIME_NONE;
  GST_BUFFER_DURATION(output) = GST_BUFFER_DURATION(left);
  GST_BUFFER_OFFSET(output) = GST_BUFFER_OFFSET(left);
  GST_BUFFER_OFFSET_END(output) = GST_BUFFER_OFFSET_END(left);
  gst_buffer_foreach_meta(left, copy_meta, output);
}

}  // namespace mtstereo::plugin
