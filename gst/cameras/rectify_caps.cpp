// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/rectify_caps.hpp"

#include "shared/caps.hpp"
#include "shared/luma.hpp"
#include "shared/stereo_geometry.hpp"

namespace mtstereo::plugin {
namespace {

constexpr const char* kSquarePixels = "pixel-aspect-ratio";

CapsPointer with_formats(const GstCaps* caps, const std::string& formats) {
  const CapsPointer allowed(gst_caps_from_string(("video/x-raw, format = " + formats).c_str()));
  return CapsPointer(
      gst_caps_intersect_full(const_cast<GstCaps*>(caps), allowed.get(), GST_CAPS_INTERSECT_FIRST));
}

void remove_geometry(GstStructure* fields) {
  for (const char* field : kGeometryFields) gst_structure_remove_field(fields, field);
  gst_structure_remove_field(fields, kCameraField);
}

void set_size(GstStructure* fields, const char* name, int size) {
  if (size > 0) {
    gst_structure_set(fields, name, G_TYPE_INT, size, nullptr);
  } else {
    gst_structure_set(fields, name, GST_TYPE_INT_RANGE, 1, kLargestImageSide, nullptr);
  }
}

/// A pixel becomes another color, and no color at all without `color`.
void remove_format(GstStructure* fields) {
  gst_structure_remove_fields(fields, "format", "colorimetry", "chroma-site", nullptr);
}

}  // namespace

CapsPointer rectified_caps(const GstCaps* sink, const RectifySettings& settings) {
  CapsPointer result = with_formats(sink, kColorFormats);
  // Without a format to keep, the caps say gray: fixed caps are then refused with a reason.
  const bool color = settings.color && !gst_caps_is_empty(result.get());
  if (!color) result.reset(gst_caps_copy(sink));
  result.reset(gst_caps_make_writable(result.release()));
  for (guint i = 0; i < gst_caps_get_size(result.get()); ++i) {
    GstStructure* fields = gst_caps_get_structure(result.get(), i);
    remove_geometry(fields);
    if (!color) {
      remove_format(fields);
      gst_structure_set(fields, "format", G_TYPE_STRING, "GRAY8", nullptr);
    }
    set_size(fields, "width", settings.options.width);
    set_size(fields, "height", settings.options.height);
    if (gst_structure_has_field(fields, kSquarePixels)) {
      gst_structure_set(fields, kSquarePixels, GST_TYPE_FRACTION, 1, 1, nullptr);
    }
  }
  return result;
}

CapsPointer unrectified_caps(const GstCaps* source, const RectifySettings& settings,
                             const std::optional<FrameSize>& preferred) {
  CapsPointer result(gst_caps_copy(source));
  for (guint i = 0; i < gst_caps_get_size(result.get()); ++i) {
    GstStructure* fields = gst_caps_get_structure(result.get(), i);
    remove_geometry(fields);
    gst_structure_remove_field(fields, kSquarePixels);
    if (!settings.color) remove_format(fields);
    set_size(fields, "width", 0);
    set_size(fields, "height", 0);
  }
  result = with_formats(result.get(), settings.color ? kColorFormats : luma_formats());
  if (!preferred) return result;
  CapsPointer best(gst_caps_copy(result.get()));
  for (guint i = 0; i < gst_caps_get_size(best.get()); ++i) {
    GstStructure* fields = gst_caps_get_structure(best.get(), i);
    set_size(fields, "width", preferred->width);
    set_size(fields, "height", preferred->height);
  }
  gst_caps_append(best.get(), result.release());
  return best;
}

bool has_color_format(const GstCaps* caps) {
  return !gst_caps_is_empty(with_formats(caps, kColorFormats).get());
}

CapsPointer fixed_caps(CapsPointer caps, FrameSize size) {
  CapsPointer first(gst_caps_truncate(caps.release()));
  first.reset(gst_caps_make_writable(first.release()));
  if (gst_caps_get_size(first.get()) == 0) return first;
  GstStructure* fields = gst_caps_get_structure(first.get(), 0);
  gst_structure_fixate_field_nearest_int(fields, "width", size.width);
  gst_structure_fixate_field_nearest_int(fields, "height", size.height);
  return CapsPointer(gst_caps_fixate(first.release()));
}

FrameSize size_in(const GstCaps* caps) {
  FrameSize size;
  const GstStructure* fields = gst_caps_get_structure(caps, 0);
  gst_structure_get_int(fields, "width", &size.width);
  gst_structure_get_int(fields, "height", &size.height);
  return size;
}

void write_plan(GstCaps* caps, const RectificationPlan& plan, PixelRectangle region) {
  StereoGeometry geometry;
  const Rectification& rectification = plan.rectification;
  geometry.focal_length = rectification.focal_length;
  geometry.baseline = rectification.baseline;
  geometry.principal_offset = rectification.principal_offset();
  geometry.principal_x = rectification.left_center_x;
  geometry.principal_y = rectification.center_y;
  geometry.valid_region = region;
  GstStructure* fields = gst_caps_get_structure(caps, 0);
  write_geometry(fields, geometry);
  const bool left = plan.settings.side == Rectifier::Side::kLeft;
  gst_structure_set(fields, kCameraField, G_TYPE_STRING, left ? "left" : "right", nullptr);
}

}  // namespace mtstereo::plugin
