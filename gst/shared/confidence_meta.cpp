// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/confidence_meta.hpp"

namespace mtstereo::plugin {
namespace {

GstSample* sample_in(GstCustomMeta& meta) {
  const GValue* value =
      gst_structure_get_value(gst_custom_meta_get_structure(&meta), kConfidenceField);
  return value != nullptr && GST_VALUE_HOLDS_SAMPLE(value) ? gst_value_get_sample(value) : nullptr;
}

bool same_size(const GstVideoMetaTransform& scale) {
  return scale.in_info->width == scale.out_info->width &&
         scale.in_info->height == scale.out_info->height;
}

/// True if each pixel of the confidence map still belongs to the same pixel of the new buffer.
bool stays_valid(GQuark type, gpointer data) {
  if (GST_META_TRANSFORM_IS_COPY(type)) return !static_cast<GstMetaTransformCopy*>(data)->region;
  if (GST_VIDEO_META_TRANSFORM_IS_SCALE(type)) {
    return same_size(*static_cast<GstVideoMetaTransform*>(data));
  }
  return false;
}

/// GStreamer calls it; it calls C functions only, so that it throws nothing.
gboolean transform_meta(GstBuffer* to, GstCustomMeta* meta, GstBuffer*, GQuark type, gpointer data,
                        gpointer) noexcept {
  GstSample* confidence = sample_in(*meta);
  if (confidence == nullptr || !stays_valid(type, data)) return FALSE;
  set_confidence(to, confidence);  // shared, not copied
  return TRUE;
}

const GstMetaInfo* registered() {
  // Once per process, by the first caller.
  static const GstMetaInfo* const info = []() -> const GstMetaInfo* {
    // An application may have registered it already, for the confidence of its own maps.
    if (const GstMetaInfo* known = gst_meta_get_info(kConfidenceMeta)) {
      return gst_meta_info_is_custom(known) ? known : nullptr;
    }
    // Elements that move, rotate or scale pixels check these tags and do not copy the meta.
    const gchar* tags[] = {GST_META_TAG_VIDEO_STR, GST_META_TAG_VIDEO_SIZE_STR,
                           GST_META_TAG_VIDEO_ORIENTATION_STR, nullptr};
    return gst_meta_register_custom(kConfidenceMeta, tags, transform_meta, nullptr, nullptr);
  }();
  return info;
}

}  // namespace

bool register_confidence_meta() { return registered() != nullptr; }

bool belongs_to_pixels(const GstMetaInfo& info) {
  return &info == registered() || gst_meta_api_type_has_tag(info.api, _gst_meta_tag_memory) ||
         gst_meta_api_type_has_tag(info.api, _gst_meta_tag_memory_reference) ||
         gst_meta_api_type_has_tag(info.api,
                                   g_quark_from_static_string(GST_META_TAG_VIDEO_COLORSPACE_STR));
}

void set_confidence(GstBuffer* disparity, GstSample* confidence) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(disparity, kConfidenceMeta);
  if (meta == nullptr) meta = gst_buffer_add_custom_meta(disparity, kConfidenceMeta);
  gst_structure_set(gst_custom_meta_get_structure(meta), kConfidenceField, GST_TYPE_SAMPLE,
                    confidence, nullptr);
}

GstSample* confidence_of(GstBuffer* disparity) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(disparity, kConfidenceMeta);
  return meta != nullptr ? sample_in(*meta) : nullptr;
}

}  // namespace mtstereo::plugin
