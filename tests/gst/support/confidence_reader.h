/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef MTSTEREO_CONFIDENCE_READER_H
#define MTSTEREO_CONFIDENCE_READER_H

#include <gst/video/video.h>

G_BEGIN_DECLS

gboolean map_confidence(GstBuffer* disparity, GstVideoFrame* frame);

G_END_DECLS

#endif
