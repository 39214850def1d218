// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/map_smoothing.hpp"

#include <algorithm>
#include <cstdlib>

#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

/// Pixels of a row that are smoothed at a time: their sums stay in the first cache.
constexpr int kBlock = 256;

/// The sums of some neighboring pixels.
struct Sums {
  std::int32_t rise[kBlock];   ///< how much the pairs are above the pixel [1 / kDisparityOne px]
  std::int32_t count[kBlock];  ///< pixels that are taken, itself included
};

/// Adds a pair of pixels where both continue the one between them. Plain arithmetic without
/// branches: compilers turn it into vectors.
void add_pairs(const std::int32_t* __restrict__ middle, const std::int32_t* __restrict__ one,
               const std::int32_t* __restrict__ other, int count, Sums& sums) {
  for (int i = 0; i < count; ++i) {
    const std::int32_t rise = one[i] - middle[i];
    const std::int32_t fall = other[i] - middle[i];
    const bool taken = (one[i] != kNoDisparity) & (other[i] != kNoDisparity) &
                       (std::abs(rise) <= kDisparityOne) & (std::abs(fall) <= kDisparityOne);
    sums.rise[i] += taken ? rise + fall : 0;
    sums.count[i] += taken ? 2 : 0;
  }
}

void write_means(const std::int32_t* __restrict__ middle, const Sums& sums, int count,
                 std::int32_t* __restrict__ out) {
  for (int i = 0; i < count; ++i) {
    // Towards zero, which keeps to the pixel's own.
    const auto rise = static_cast<std::int32_t>(static_cast<float>(sums.rise[i]) /
                                                static_cast<float>(sums.count[i]));
    out[i] = middle[i] == kNoDisparity ? kNoDisparity : middle[i] + rise;
  }
}

/// Smooths a row; pair(distance) gives the two rows that hold the pixels at this distance.
template <typename Pair>
void smooth_row(const std::int32_t* middle, int width, int radius, Pair&& pair, std::int32_t* out) {
  Sums sums;
  for (int x = 0; x < width; x += kBlock) {
    const int count = std::min(width - x, kBlock);
    std::fill_n(sums.rise, count, 0);
    std::fill_n(sums.count, count, 1);
    for (int distance = 1; distance <= radius; ++distance) {
      const auto [one, other] = pair(distance);
      add_pairs(middle + x, one + x, other + x, count, sums);
    }
    write_means(middle + x, sums, count, out + x);
  }
}

}  // namespace

void SmoothingScratch::resize(int width, int radius) { line.resize(width + 2 * radius); }

void smooth_along_rows(const Image<std::int32_t>& map, int radius, int y0, int y1,
                       SmoothingScratch& scratch, Image<std::int32_t>& smoothed) {
  const int width = map.width();
  std::int32_t* middle = scratch.line.data() + radius;
  std::fill_n(middle - radius, radius, kNoDisparity);
  std::fill_n(middle + width, radius, kNoDisparity);
  for (int y = y0; y < y1; ++y) {
    std::copy_n(map.row(y), width, middle);
    smooth_row(
        middle, width, radius,
        [&](int distance) { return std::pair(middle - distance, middle + distance); },
        smoothed.row(y));
  }
}

void smooth_along_columns(const Image<std::int32_t>& smoothed, int radius, int y0, int y1,
                          SmoothingScratch& scratch, Image<std::int32_t>& map) {
  const int width = map.width();
  std::fill_n(scratch.line.data(), width, kNoDisparity);
  const auto row = [&](int y) {
    return y >= 0 && y < map.height() ? smoothed.row(y) : scratch.line.data();
  };
  for (int y = y0; y < y1; ++y) {
    smooth_row(
        smoothed.row(y), width, radius,
        [&](int distance) { return std::pair(row(y - distance), row(y + distance)); }, map.row(y));
  }
}

}  // namespace mtstereo
