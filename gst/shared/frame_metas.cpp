// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/frame_metas.hpp"

#include <gst/video/video.h>

#include "shared/confidence_meta.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/valid_columns_meta.hpp"

namespace mtstereo::plugin {

bool belongs_to_pixels(const GstMetaInfo& info) {
  return &info == gst_meta_get_info(kConfidenceMeta) ||
         &info == gst_meta_get_info(kDisparityMeta) ||
         &info == gst_meta_get_info(kValidColumnsMeta) ||
         gst_meta_api_type_has_tag(info.api, _gst_meta_tag_memory) ||
         gst_meta_api_type_has_tag(info.api, _gst_meta_tag_memory_reference) ||
         gst_meta_api_type_has_tag(info.api,
                                   g_quark_from_static_string(GST_META_TAG_VIDEO_COLORSPACE_STR));
}

}  // namespace mtstereo::plugin
