// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/pixel_meta.hpp"

#include "shared/confidence_meta.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/valid_columns_meta.hpp"

namespace mtstereo::plugin {

bool register_pixel_meta(const char* name, GstCustomMetaTransformFunction transform) {
  // An application may have registered it already, for its own maps.
  if (const GstMetaInfo* known = gst_meta_get_info(name)) return gst_meta_info_is_custom(known);
  const gchar* tags[] = {GST_META_TAG_VIDEO_STR, GST_META_TAG_VIDEO_SIZE_STR,
                         GST_META_TAG_VIDEO_ORIENTATION_STR, nullptr};
  return gst_meta_register_custom(name, tags, transform, nullptr, nullptr) != nullptr;
}

bool keeps_pixels(GQuark type, gpointer data) {
  if (GST_META_TRANSFORM_IS_COPY(type)) return !static_cast<GstMetaTransformCopy*>(data)->region;
  if (!GST_VIDEO_META_TRANSFORM_IS_SCALE(type)) return false;
  const auto& scale = *static_cast<GstVideoMetaTransform*>(data);
  return scale.in_info->width == scale.out_info->width &&
         scale.in_info->height == scale.out_info->height;
}

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
