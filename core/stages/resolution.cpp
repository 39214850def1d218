// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/resolution.hpp"

#include <algorithm>
#include <cstdlib>

namespace mtstereo {
namespace {

/// The neighbor's disparity where it continues this one's, else this one's.
inline std::int32_t continued(std::int32_t neighbor, std::int32_t disparity) {
  // No short cut: without a branch the loop over a row works on whole vectors.
  const bool continues =
      (neighbor != kNoDisparity) & (std::abs(neighbor - disparity) <= kDisparityOne);
  return continues ? neighbor : disparity;
}

/// The rows of half pixels that a row of pixels lies between, and what its disparities are limited
/// to.
struct EnlargedRow {
  const std::int32_t* __restrict__ nearest;
  const std::int32_t* __restrict__ next;
  std::int32_t limit;

  /// The disparity of pixel x of half pixel `column`, on its side to column `beside`: the pixel's
  /// center is a quarter of a half pixel off in both directions.
  std::int32_t at(int x, int column, int beside) const {
    const std::int32_t disparity = nearest[column];
    const std::int32_t sum = 9 * disparity + 3 * continued(nearest[beside], disparity) +
                             3 * continued(next[column], disparity) +
                             continued(next[beside], disparity);
    // Sixteenths of half pixels are eighths of pixels.
    const std::int32_t rounded = (sum + 4) >> 3;
    const std::int32_t possible = std::min(rounded, std::min(x * kDisparityOne, limit));
    return disparity == kNoDisparity ? kNoDisparity : possible;
  }
};

void enlarge_row(const EnlargedRow& row, int half_width, int width,
                 std::int32_t* __restrict__ out) {
  const int last = half_width - 1;
  out[0] = row.at(0, 0, 0);
  if (width > 1) out[1] = row.at(1, 0, std::min(1, last));
  for (int x = 1; x < last; ++x) {
    out[2 * x] = row.at(2 * x, x, x - 1);
    out[2 * x + 1] = row.at(2 * x + 1, x, x + 1);
  }
  if (last == 0) return;
  out[2 * last] = row.at(2 * last, last, last - 1);
  if (2 * last + 1 < width) out[2 * last + 1] = row.at(2 * last + 1, last, last);
}

}  // namespace

void halve_rows(GrayView view, int y0, int y1, Image<std::uint8_t>& half) {
  const int pairs = view.width / 2;
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* __restrict__ upper = view.row(2 * y);
    const std::uint8_t* __restrict__ lower = view.row(std::min(2 * y + 1, view.height - 1));
    std::uint8_t* __restrict__ out = half.row(y);
    for (int x = 0; x < pairs; ++x) {
      const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
      out[x] = static_cast<std::uint8_t>((sum + 2) / 4);
    }
    if (pairs < half.width()) {
      out[pairs] = static_cast<std::uint8_t>((upper[2 * pairs] + lower[2 * pairs] + 1) / 2);
    }
  }
}

void enlarge_rows(const Image<std::int32_t>& half, int max_disparity, int y0, int y1,
                  Image<std::int32_t>& map) {
  for (int y = y0; y < y1; ++y) {
    const int next = std::clamp(y % 2 == 0 ? y / 2 - 1 : y / 2 + 1, 0, half.height() - 1);
    const EnlargedRow row = {half.row(y / 2), half.row(next), max_disparity * kDisparityOne - 1};
    enlarge_row(row, half.width(), map.width(), map.row(y));
  }
}

void enlarge_confidence(const Image<std::uint8_t>& half, int y0, int y1,
                        Image<std::uint8_t>& confidence) {
  const int width = confidence.width();
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* __restrict__ in = half.row(y / 2);
    std::uint8_t* __restrict__ out = confidence.row(y);
    for (int x = 0; x < width / 2; ++x) out[2 * x] = out[2 * x + 1] = in[x];
    if (width % 2 != 0) out[width - 1] = in[width / 2];
  }
}

}  // namespace mtstereo
