// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/gray_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/ramp.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

constexpr int kGrays = 256;
constexpr int kBins = kGrays / kMappedGrays;

static_assert(1 << 8 == kDisparityOne);

/// Sums over the matched pixels whose partner has a gray value of one bin.
struct Bin {
  std::int64_t pixels = 0;
  std::int64_t left = 0;
  std::int64_t right = 0;

  float difference() const { return static_cast<float>(left - right) / static_cast<float>(pixels); }
  float middle() const { return static_cast<float>(right) / static_cast<float>(pixels); }
};

void add_row(const RatedViews& views, const std::int32_t* map, const std::uint8_t* confidence,
             int width, int y, std::array<Bin, kBins>& bins) {
  const std::uint8_t* left = views.left.row(y);
  const std::uint8_t* right = views.right.row(y);
  for (int x = 0; x < width; ++x) {
    if (confidence[x] <= kMostInferred) continue;
    const int partner = (x * kDisparityOne - map[x] + kDisparityOne / 2) >> 8;
    if (partner < 0 || partner >= views.right.width) continue;
    Bin& bin = bins[right[partner] / kMappedGrays];
    ++bin.pixels;
    bin.left += left[x];
    bin.right += right[partner];
  }
}

/// The difference at a gray value, between the middles of the two nearest bins that have pixels.
float difference_at(int gray, const std::array<Bin, kBins>& bins) {
  const Bin* before = nullptr;
  const auto value = static_cast<float>(gray);
  for (const Bin& bin : bins) {
    if (bin.pixels == 0) continue;
    if (bin.middle() >= value) {
      if (before == nullptr) return bin.difference();
      const float share = (value - before->middle()) / (bin.middle() - before->middle());
      return before->difference() + share * (bin.difference() - before->difference());
    }
    before = &bin;
  }
  return before == nullptr ? 0 : before->difference();
}

}  // namespace

GrayMapping find_gray_mapping(const RatedViews& views, const Image<std::int32_t>& map,
                              const Image<std::uint8_t>& confidence) {
  std::array<Bin, kBins> bins;
  for (int y = 0; y < map.height(); y += kMappedRows) {
    add_row(views, map.row(y), confidence.row(y), map.width(), y, bins);
  }
  std::int64_t pixels = 0;
  float sum = 0;
  for (Bin& bin : bins) {
    if (bin.pixels < kLeastMappedPixels / kBins) bin = {};  // chance
    pixels += bin.pixels;
    sum += static_cast<float>(std::abs(bin.left - bin.right));
  }
  GrayMapping mapping;
  if (pixels < kLeastMappedPixels) return mapping;
  const float mean = sum / static_cast<float>(pixels);
  const float share = ramp(kLeastMapped, kFullyMapped, mean);
  if (share == 0) return mapping;
  mapping.is_identity = false;
  for (int gray = 0; gray < kGrays; ++gray) {
    const float mapped = static_cast<float>(gray) + share * difference_at(gray, bins);
    mapping.left_of_right[gray] =
        static_cast<std::uint8_t>(std::clamp(std::lround(mapped), 0L, 255L));
  }
  return mapping;
}

}  // namespace mtstereo
