// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/pixel_meta.hpp"

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

}  // namespace mtstereo::plugin
