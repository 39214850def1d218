// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/disparity_meta.hpp"

#include "shared/pixel_meta.hpp"

namespace mtstereo::plugin {
namespace {

/// GStreamer calls it; it calls C functions only, so that it throws nothing.
gboolean transform_disparity(GstBuffer* to, GstCustomMeta* meta, GstBuffer*, GQuark type,
                             gpointer data, gpointer) noexcept {
  if (!keeps_pixels(type, data)) return FALSE;
  GstCustomMeta* copy = gst_buffer_get_custom_meta(to, kDisparityMeta);
  if (copy == nullptr) copy = gst_buffer_add_custom_meta(to, kDisparityMeta);
  GstStructure* fields = gst_custom_meta_get_structure(copy);
  gst_structure_foreach(
      gst_custom_meta_get_structure(meta),
      [](GQuark field, const GValue* value, gpointer target) noexcept -> gboolean {
        gst_structure_id_set_value(static_cast<GstStructure*>(target), field, value);
        return TRUE;
      },
      fields);
  return TRUE;
}

}  // namespace

bool register_disparity_meta() {
  // Once per process, by the first caller.
  static const bool registered = register_pixel_meta(kDisparityMeta, transform_disparity);
  return registered;
}

void set_disparity_unit(GstBuffer* disparity, const DisparityUnit& unit) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(disparity, kDisparityMeta);
  if (meta == nullptr) meta = gst_buffer_add_custom_meta(disparity, kDisparityMeta);
  gst_structure_set(gst_custom_meta_get_structure(meta), kScaleField, G_TYPE_INT, unit.scale,
                    kMaxDisparityField, G_TYPE_INT, unit.max_disparity, kMinDisparityField,
                    G_TYPE_INT, unit.min_disparity, kOffsetField, G_TYPE_INT, unit.offset, nullptr);
}

std::optional<DisparityUnit> read_disparity_unit(const GstStructure* fields) {
  DisparityUnit unit;
  const bool complete = gst_structure_get_int(fields, kScaleField, &unit.scale) &&
                        gst_structure_get_int(fields, kMaxDisparityField, &unit.max_disparity);
  gst_structure_get_int(fields, kMinDisparityField, &unit.min_disparity);
  gst_structure_get_int(fields, kOffsetField, &unit.offset);
  const bool valid = complete && unit.scale >= 1 && unit.scale <= 65535 &&
                     unit.max_disparity >= 1 && unit.max_disparity > unit.min_disparity &&
                     unit.offset <= 0 && unit.offset >= -65535;
  return valid ? std::optional(unit) : std::nullopt;
}

std::optional<DisparityUnit> disparity_unit_of(GstBuffer* disparity) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(disparity, kDisparityMeta);
  return meta != nullptr ? read_disparity_unit(gst_custom_meta_get_structure(meta)) : std::nullopt;
}

}  // namespace mtstereo::plugin
