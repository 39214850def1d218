// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/confidence_meta.hpp"

#include "shared/pixel_meta.hpp"

namespace mtstereo::plugin {
namespace {

GstSample* sample_in(GstCustomMeta& meta) {
  const GValue* value =
      gst_structure_get_value(gst_custom_meta_get_structure(&meta), kConfidenceField);
  return value != nullptr && GST_VALUE_HOLDS_SAMPLE(value) ? gst_value_get_sample(value) : nullptr;
}

/// GStreamer calls it; it calls C functions only, so that it throws nothing.
gboolean transform_confidence(GstBuffer* to, GstCustomMeta* meta, GstBuffer*, GQuark type,
                              gpointer data, gpointer) noexcept {
  GstSample* confidence = sample_in(*meta);
  if (confidence == nullptr || !keeps_pixels(type, data)) return FALSE;
  set_confidence(to, confidence);  // shared, not copied
  return TRUE;
}

}  // namespace

bool register_confidence_meta() {
  // Once per process, by the first caller.
  static const bool registered = register_pixel_meta(kConfidenceMeta, transform_confidence);
  return registered;
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

std::string confidence_problem(GstSample* confidence, const GstVideoInfo& disparity,
                               GstVideoInfo& info) {
  GstCaps* caps = gst_sample_get_caps(confidence);
  if (caps == nullptr || gst_sample_get_buffer(confidence) == nullptr ||
      !gst_video_info_from_caps(&info, caps) ||
      GST_VIDEO_INFO_FORMAT(&info) != GST_VIDEO_FORMAT_GRAY8) {
    return "it is not a GRAY8 frame with caps";
  }
  if (info.width == disparity.width && info.height == disparity.height) return {};
  return "it has " + std::to_string(info.width) + "x" + std::to_string(info.height) +
         " px, the disparity map has " + std::to_string(disparity.width) + "x" +
         std::to_string(disparity.height) + " px";
}

}  // namespace mtstereo::plugin
