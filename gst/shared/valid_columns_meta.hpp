// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <vector>

#include "mtstereo/geometry/rectification.hpp"

// The columns of each row of a rectified frame that show the camera's image; the other pixels are
// border. mtrectify attaches them, mtstereo removes the disparities of border pixels. It is a
// custom meta of the buffer, so that applications read and write it with GStreamer alone.

namespace mtstereo::plugin {

/// The name of the meta for gst_buffer_get_custom_meta(). It is part of the public interface.
inline constexpr const char* kValidColumnsMeta = "MtStereoValidColumnsMeta";
/// The field of its structure: a GBytes with two 32-bit integers in the byte order of the machine
/// for each row, the first valid column and the one after the last. All frames with the same
/// columns share it.
inline constexpr const char* kColumnsField = "columns";

/// Registers the meta with GStreamer; further calls have no effect. False if another type of meta
/// has the name. Any thread.
bool register_valid_columns_meta();

/// The columns as a GBytes for set_valid_columns(). The caller owns it.
GBytes* pack_valid_columns(const std::vector<ValidColumns>& columns);

/// Attaches the columns to a writable frame; replaces existing ones. The meta stays with a buffer
/// of a pool: for the next frame with the same columns, nothing is allocated.
void set_valid_columns(GstBuffer* frame, GBytes* columns);
/// Removes the columns of a writable frame.
void remove_valid_columns(GstBuffer* frame);

/// The columns of a frame, or NULL if it has none. The buffer owns them.
GBytes* valid_columns_of(GstBuffer* frame);

/// The columns of an image of this size; empty if they do not fit it.
std::vector<ValidColumns> unpack_valid_columns(GBytes* columns, int width, int height);

}  // namespace mtstereo::plugin
