// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/depth_properties.hpp"

namespace mtstereo::plugin {
namespace {

GType overflow_type() {
  static const GType type = enum_type<DepthOverflow>(
      "GstMtStereoDepthOverflow",
      {{DepthOverflow::kNone, "Such pixels become 0 (no depth)", "none"},
       {DepthOverflow::kClamp, "Such pixels become 65535, the largest value", "clamp"}});
  return type;
}

}  // namespace

const PropertyTable<DepthProperties>& depth_properties() {
  using Values = DepthProperties;
  using Row = Property<Values>;
  static const PropertyTable<Values> table(
      {
          {"unit", &Values::unit, 0.001, 1000,
           "Length of the value 1, in mm; the caps of the output state it in meters, as "
           "depth-unit (1: depths up to 65.535 m)"},
          Row("near", {&Values::range, &DepthRange::near}, 0, kLargestDepthLimit,
              "Minimum depth in meters; nearer pixels become 0"),
          Row("far", {&Values::range, &DepthRange::far}, 0, kLargestDepthLimit,
              "Maximum depth in meters; farther pixels become 0 (0: no limit)"),
          {"overflow", &Values::overflow, overflow_type(),
           "Depths that do not fit in 16 bits: more than 65535 units, or infinite"},
          {"free-space", &Values::free_space,
           "Give unknown pixels the distance up to which their rays are free, estimated from the "
           "nearest disparities to the left, right, above and below; needs one on the left and the "
           "right; not guaranteed (false: no depth)"},
      },
      geometry_rows<Values>());
  return table;
}

}  // namespace mtstereo::plugin
