// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/depth_report.hpp"

#include <algorithm>

namespace mtstereo::plugin {

void report_depths(gpointer element, const DepthGeometry& geometry, const DepthOptions& options) {
  // The farthest depth that has a value and that a disparity of one step gives.
  const double largest_value = 65535 * options.unit;
  const double one_step = geometry.focal_length * geometry.baseline * geometry.scale;
  const double far = std::min({options.far, largest_value, one_step});
  const double step = 1 / geometry.scale;
  const double depth_step = geometry.depth_step(far, step);
  const double depth_error = geometry.depth_step(far, kTypicalError);
  gst_element_post_message(
      GST_ELEMENT_CAST(element),
      gst_message_new_element(
          GST_OBJECT_CAST(element),
          gst_structure_new(
              kDepthMessage, "near", G_TYPE_DOUBLE, options.near, "far", G_TYPE_DOUBLE, far,
              "depth-unit", G_TYPE_DOUBLE, options.unit, "focal-length", G_TYPE_DOUBLE,
              geometry.focal_length, "baseline", G_TYPE_DOUBLE, geometry.baseline,
              "principal-offset", G_TYPE_DOUBLE, geometry.principal_offset, "disparity-step",
              G_TYPE_DOUBLE, step, "depth-step", G_TYPE_DOUBLE, depth_step, "disparity-error",
              G_TYPE_DOUBLE, kTypicalError, "depth-error", G_TYPE_DOUBLE, depth_error, nullptr)));
  GST_ELEMENT_INFO(
      element, STREAM, FORMAT,
      ("Depths from %g to %g m in steps of %g mm. At %g m, one step of the disparity (%g px) is "
       "%.3g m, and the typical error of a disparity (%g px) is %.3g m.",
       options.near, far, options.unit * 1000, far, step, depth_step, kTypicalError, depth_error),
      ("focal length %g px, baseline %g m, principal offset %g px", geometry.focal_length,
       geometry.baseline, geometry.principal_offset));
}

}  // namespace mtstereo::plugin
