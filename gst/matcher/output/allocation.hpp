// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstaggregator.h>
#include <gst/video/video.h>

#include "shared/ownership.hpp"

namespace mtstereo::plugin {

// All of it runs in the task of the source pad.

/// The base class' decide_allocation(): configures the buffer pool of the output.
gboolean decide_allocation(GstAggregator* aggregator, GstQuery* query);
/// The base class' propose_allocation(): accepts frames of any stride and offset.
gboolean propose_allocation(GstAggregator* aggregator, GstAggregatorPad* pad,
                            GstQuery* decide_query, GstQuery* query);
/// Acquires a buffer for one disparity map of `size` bytes.
GstFlowReturn acquire_output(GstAggregator* aggregator, gsize size, BufferPointer& buffer);
/// Copies the properties of the left frame to the disparity map, except the pixels: time stamps,
/// flags and metas.
void copy_frame_properties(GstBuffer* left, GstBuffer* right, GstBuffer* output);

}  // namespace mtstereo::plugin
