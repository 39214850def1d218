// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mtstereo/geometry/rectification.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"
#include "shared/disparity_meta.hpp"

namespace mtstereo::plugin {

/// The distance from a border up to which disparities are removed [px]: the border is in the
/// neighborhood by which they were found. In textured pairs with borders, 0.1 % or less of the
/// disparities farther away are wrong because of it; of those within the distance it is up to 20 %.
inline int border_margin(Preset preset) { return preset == Preset::kPaper ? 8 : 5; }

/// The columns without the pixels that are at most `margin` from a border, in their row or another
/// one. The edge of the image is not a border.
std::vector<ValidColumns> without_margin(const std::vector<ValidColumns>& columns, int width,
                                         int margin);

/// Sets each disparity to 0 whose left pixel or right pixel is not in the columns of its view; a
/// view without columns (empty) has no border. Returns the number of removed disparities.
long remove_border(ImageView<std::uint16_t> map, const std::vector<ValidColumns>& left,
                   const std::vector<ValidColumns>& right, const DisparityUnit& unit);

}  // namespace mtstereo::plugin
