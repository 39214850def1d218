/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* As in docs/application.md. */
#include "support/confidence_reader.h"

/* Maps the confidence map of a disparity map; FALSE if it has none. Unmap it with
 * gst_video_frame_unmap(). */
gboolean map_confidence(GstBuffer* disparity, GstVideoFrame* frame) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(disparity, "MtStereoConfidenceMeta");
  GstSample* sample = NULL;
  GstVideoInfo info;
  gboolean mapped;

  if (meta == NULL) return FALSE;
  gst_structure_get(gst_custom_meta_get_structure(meta), "confidence", GST_TYPE_SAMPLE, &sample,
                    NULL);
  if (sample == NULL) return FALSE;
  mapped = gst_video_info_from_caps(&info, gst_sample_get_caps(sample)) &&
           gst_video_frame_map(frame, &info, gst_sample_get_buffer(sample), GST_MAP_READ);
  gst_sample_unref(sample); /* the mapped frame holds its own reference */
  return mapped;
}
