// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/map_shift.hpp"

#include <algorithm>

namespace mtstereo {
namespace {

/// Adds a positive smallest disparity. The first columns have no partner.
void shift_up(const std::int32_t* in, const std::uint8_t* in_confidence, int width, int least,
              std::int32_t* out, std::uint8_t* out_confidence) {
  std::fill_n(out, least, kNoDisparity);
  std::fill_n(out_confidence, least, std::uint8_t{0});
  std::copy_n(in_confidence, width - least, out_confidence + least);
  for (int x = least; x < width; ++x) {
    const std::int32_t value = in[x - least];
    out[x] = value == kNoDisparity ? kNoDisparity : value + least * kDisparityOne;
  }
}

/// Removes what matches the columns that were added to the right view.
void crop(const std::int32_t* in, const std::uint8_t* in_confidence, int width, int added,
          std::int32_t* out, std::uint8_t* out_confidence) {
  for (int x = 0; x < width; ++x) {
    const std::int32_t value = in[x + added];
    const std::int32_t smallest = (x + added - (width - 1)) * kDisparityOne;
    const bool inside = value != kNoDisparity && value >= smallest;
    out[x] = inside ? value : kNoDisparity;
    out_confidence[x] = inside ? in_confidence[x + added] : std::uint8_t{0};
  }
}

}  // namespace

void shift_map(const Image<std::int32_t>& map, const Image<std::uint8_t>& confidence,
               int min_disparity, int y0, int y1, Image<std::int32_t>& out,
               Image<std::uint8_t>& out_confidence) {
  for (int y = y0; y < y1; ++y) {
    if (min_disparity > 0) {
      shift_up(map.row(y), confidence.row(y), out.width(), min_disparity, out.row(y),
               out_confidence.row(y));
    } else {
      crop(map.row(y), confidence.row(y), out.width(), -min_disparity, out.row(y),
           out_confidence.row(y));
    }
  }
}

}  // namespace mtstereo
