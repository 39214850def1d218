// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/gray_mapping.hpp"

#include <algorithm>
#include <cmath>

#include "base/ramp.hpp"
#include "stages/pixels/gray_differences.hpp"

namespace mtstereo {
namespace {

constexpr int kGrays = 256;
constexpr int kBins = kGrays / kMappedGrays;

static_assert(1 << 8 == kDisparityOne);

/// The matched pixels whose partner has a gray value of one bin.
struct Bin {
  GrayDifferences differences;
  std::int64_t right = 0;  ///< sum of their gray values

  /// The others are there by chance.
  bool is_used() const { return differences.pixels() >= kLeastMappedPixels / kBins; }
  float pixels() const { return static_cast<float>(differences.pixels()); }
  float difference() const { return static_cast<float>(differences.median()); }
  float middle() const { return static_cast<float>(right) / pixels(); }
};

void add_row(const std::uint8_t* left, const std::uint8_t* right, const std::int32_t* map,
             int width, std::array<Bin, kBins>& bins) {
  for (int x = 0; x < width; ++x) {
    if (map[x] == kNoDisparity) continue;
    const int partner = (x * kDisparityOne - map[x] + kDisparityOne / 2) >> 8;
    if (partner < 0) continue;
    Bin& bin = bins[right[partner] / kMappedGrays];
    bin.differences.add(left[x] - right[partner]);
    bin.right += right[partner];
  }
}

/// The difference at a gray value, between the middles of the two nearest bins that have pixels.
float difference_at(int gray, const std::array<Bin, kBins>& bins) {
  const Bin* before = nullptr;
  const auto value = static_cast<float>(gray);
  for (const Bin& bin : bins) {
    if (!bin.is_used()) continue;
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

GrayMapping find_gray_mapping(GrayView left, GrayView right, const Image<std::int32_t>& map) {
  std::array<Bin, kBins> bins;
  for (int y = 0; y < map.height(); y += kMappedRows) {
    add_row(left.row(y), right.row(y), map.row(y), map.width(), bins);
  }
  float pixels = 0, sum = 0;
  for (const Bin& bin : bins) {
    if (!bin.is_used()) continue;
    pixels += bin.pixels();
    sum += bin.pixels() * std::abs(bin.difference());
  }
  GrayMapping mapping;
  if (pixels < kLeastMappedPixels) return mapping;
  const float mean = sum / pixels;
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

void map_row(const std::uint8_t* right, int width, const GrayMapping& mapping, std::uint8_t* out) {
  if (mapping.is_identity) {
    std::copy_n(right, width, out);
  } else {
    std::transform(right, right + width, out,
                   [&](std::uint8_t gray) { return mapping.left_of_right[gray]; });
  }
}

}  // namespace mtstereo
