// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/output_caps.hpp"

#include "shared/stereo_geometry.hpp"

namespace mtstereo::plugin {

CapsPointer output_caps(const StreamFormat& left, const DisparityUnit& unit) {
  CapsPointer caps(gst_caps_new_simple(
      "video/x-raw", "format", G_TYPE_STRING, "GRAY16_LE", "width", G_TYPE_INT, left.video.width,
      "height", G_TYPE_INT, left.video.height, "framerate", GST_TYPE_FRACTION, left.video.fps_n,
      left.video.fps_d, "pixel-aspect-ratio", GST_TYPE_FRACTION, left.video.par_n, left.video.par_d,
      "interlace-mode", G_TYPE_STRING, "progressive", kScaleField, G_TYPE_INT, unit.scale,
      kMaxDisparityField, G_TYPE_INT, unit.max_disparity, nullptr));
  // Absent fields are 0.
  if (unit.min_disparity != 0) {
    gst_caps_set_simple(caps.get(), kMinDisparityField, G_TYPE_INT, unit.min_disparity, nullptr);
  }
  if (unit.offset != 0) {
    gst_caps_set_simple(caps.get(), kOffsetField, G_TYPE_INT, unit.offset, nullptr);
  }
  if (left.geometry) {
    copy_geometry_fields(left.geometry.get(), gst_caps_get_structure(caps.get(), 0));
  }
  return caps;
}

}  // namespace mtstereo::plugin
