// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace mtstereo::plugin {

/// A color, 8 bits per component.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// The color of every 16-bit disparity value: black for 0 (no disparity), otherwise the color map
/// Turbo (Mikhailov, 2019) from blue at 0 px (or the offset of the values) to red at
/// `max_disparity` px and above. The range is fixed, so that a color stands for the same disparity
/// in every frame.
std::vector<Rgb> color_table(int max_disparity, int disparity_scale);

/// How the colors are spread over a range of depths.
enum class ColorScale {
  kInverse,  ///< evenly over 1 / depth, as over disparities
  kLinear,   ///< evenly over the depth
  kLog,      ///< evenly over the logarithm: a color per ratio of depths
};

/// The input range of a color table of depths.
struct DepthColors {
  double unit = 0;  ///< of the values [m]
  double near = 0;  ///< of the last color, positive [m]
  double far = 0;   ///< of the first color, more than `near` [m]
  ColorScale scale = ColorScale::kLog;
  bool operator==(const DepthColors&) const = default;
};

/// The color of every 16-bit depth: black for 0 (no depth), otherwise Turbo from red at `near` and
/// below to blue at `far` and above, so that near is red as in the colors of disparities.
std::vector<Rgb> depth_color_table(const DepthColors& colors);

}  // namespace mtstereo::plugin
