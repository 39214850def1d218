// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The segment of a stream and where it comes from.
struct StreamSegment {
  GstSegment segment{};
  guint32 seqnum = GST_SEQNUM_INVALID;  ///< of its event
  guint64 seek = 0;                     ///< number of the flushing seek that it follows; 0: none
  guint64 known_seek = 0;               ///< number of the seek that its event names; 0: none
  guint64 seeks_before = 0;             ///< number of the last seek when it arrived
  gint64 pad_offset = 0;  ///< the property offset of the pad, part of the segment [ns]
};

}  // namespace mtstereo::plugin
