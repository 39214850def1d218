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

}  // namespace mtstereo::plugin
