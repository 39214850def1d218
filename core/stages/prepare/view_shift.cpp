// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/view_shift.hpp"

#include <algorithm>

namespace mtstereo {

GrayView cropped_left(GrayView left, int min_disparity) {
  return {left.data + min_disparity, left.width - min_disparity, left.height, left.stride};
}

GrayView cropped_right(GrayView right, int min_disparity) {
  return {right.data, right.width - min_disparity, right.height, right.stride};
}

void extend_rows(GrayView view, int before, int after, int y0, int y1, Image<std::uint8_t>& out) {
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* in = view.row(y);
    std::uint8_t* row = out.row(y);
    std::fill_n(row, before, in[0]);
    std::copy_n(in, view.width, row + before);
    std::fill_n(row + before + view.width, after, in[view.width - 1]);
  }
}

}  // namespace mtstereo
