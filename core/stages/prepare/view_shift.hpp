// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Shifts the views by the smallest disparity, so that all later steps search disparities from 0
/// on. Both views get the width of the input minus that disparity. A disparity d of the input is
/// then d - min_disparity, and a partner outside of the right view is outside of the shifted one,
/// or in its border.

/// The views for a smallest disparity of at least 0: the left view without its first columns, which
/// have no partner, and the right view without its last ones, which are the partner of none.
GrayView cropped_left(GrayView left, int min_disparity);
GrayView cropped_right(GrayView right, int min_disparity);

/// Writes the rows y0 .. y1 - 1 of `out`: the view with `before` and `after` more columns on the
/// left and on the right, which repeat the first and the last pixel. For a negative smallest
/// disparity the left view needs columns before it, and the right view the same number after it.
void extend_rows(GrayView view, int before, int after, int y0, int y1, Image<std::uint8_t>& out);

}  // namespace mtstereo
