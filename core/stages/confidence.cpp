// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/confidence.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "mtstereo/image.hpp"
#include "stages/outlier_removal.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/confidence.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once more for each processor.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mtstereo {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint16_t, 32>;

/// Sums up the support of each pixel of a row.
void sum_row(const SupportMap& support, int y, SupportScratch& scratch) {
  const Words d16;
  const int step = static_cast<int>(hn::Lanes(d16));
  const int width = support.disparity.width() - 2 * kSupportRadius;
  const int top = std::max(y - kSupportRadius, 0);
  const int bottom = std::min(y + kSupportRadius, support.disparity.height() - 1);
  const auto one = hn::Set(d16, 1);
  for (int x = 0; x < width; x += step) {
    const auto middle = hn::LoadU(d16, support.disparity.row(y) + x + kSupportRadius);
    auto count = hn::Zero(d16);
    auto sum = hn::Zero(d16);
    for (int row = top; row <= bottom; ++row) {
      const std::uint16_t* disparities = support.disparity.row(row) + x;
      const std::uint16_t* ratios = support.ratio.row(row) + x;
      for (int i = 0; i <= 2 * kSupportRadius; ++i) {
        const int away = std::max(std::abs(row - y), std::abs(i - kSupportRadius));
        const auto tolerance =
            hn::Set(d16, static_cast<std::uint16_t>(kSupportTolerance + away * kSupportSlope));
        const auto other = hn::LoadU(d16, disparities + i);
        // One of the two saturating differences is 0, the other one is the distance.
        const auto distance =
            hn::Or(hn::SaturatedSub(other, middle), hn::SaturatedSub(middle, other));
        const auto supports = hn::Eq(hn::SaturatedSub(distance, tolerance), hn::Zero(d16));
        count = hn::Add(count, hn::IfThenElseZero(supports, one));
        sum = hn::Add(sum, hn::IfThenElseZero(supports, hn::LoadU(d16, ratios + i)));
      }
    }
    hn::StoreU(count, d16, scratch.count.data() + x);
    hn::StoreU(sum, d16, scratch.ratio.data() + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace mtstereo
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(sum_row);

namespace {

constexpr int kSide = 2 * kSupportRadius + 1;
constexpr int kRootSteps = 4096;

/// 255 times the cube root of i / kRootSteps, rounded half up. In whole numbers: the cube root of
/// 1/8 is half a step, and what std::cbrt() makes of it differs from library to library.
constexpr std::array<std::uint8_t, kRootSteps + 1> kCubeRoots = [] {
  std::array<std::uint8_t, kRootSteps + 1> roots{};
  std::int64_t root = 0;
  for (std::int64_t i = 0; i <= kRootSteps; ++i) {
    // Up where root + 1/2 is not above the exact one.
    const std::int64_t cube = std::int64_t{255} * 255 * 255 * i;
    while ((2 * root + 1) * (2 * root + 1) * (2 * root + 1) * kRootSteps <= 8 * cube) ++root;
    roots[i] = static_cast<std::uint8_t>(root);
  }
  return roots;
}();

}  // namespace

void SupportMap::resize(int width, int height) {
  // As wide as the vectors that begin inside reach.
  disparity.resize(width + 2 * kSupportRadius, height);
  ratio.resize(width + 2 * kSupportRadius, height);
}

void SupportScratch::resize(int width) {
  constexpr int kVector = 32;
  count.resize(width + kVector);
  ratio.resize(width + kVector);
}

void copy_support(const Image<std::int32_t>& map, const Image<std::uint8_t>& ratio, int y0, int y1,
                  SupportMap& support) {
  constexpr int kRatio = kDisparityOne / kVoteOne;
  const int width = map.width();
  for (int y = y0; y < y1; ++y) {
    const std::int32_t* in = map.row(y);
    const std::uint8_t* in_ratio = ratio.row(y);
    std::uint16_t* out = support.disparity.row(y);
    std::uint16_t* out_ratio = support.ratio.row(y);
    std::fill_n(out, support.disparity.stride(), kVoteNone);
    std::fill_n(out_ratio, support.ratio.stride(), std::uint16_t{0});
    for (int x = 0; x < width; ++x) {
      if (in[x] == kNoDisparity) continue;
      out[x + kSupportRadius] = static_cast<std::uint16_t>((in[x] + kRatio / 2) / kRatio);
      out_ratio[x + kSupportRadius] = in_ratio[x];
    }
  }
}

void rate_support(const SupportMap& support, int y0, int y1, SupportScratch& scratch,
                  Image<std::uint8_t>& confidence) {
  const int width = confidence.width();
  const int height = confidence.height();
  for (int y = y0; y < y1; ++y) {
    HWY_DYNAMIC_DISPATCH(sum_row)(support, y, scratch);
    const std::uint16_t* middle = support.disparity.row(y) + kSupportRadius;
    std::uint8_t* out = confidence.row(y);
    const int rows = std::min(y + kSupportRadius, height - 1) - std::max(y - kSupportRadius, 0) + 1;
    for (int x = 0; x < width; ++x) {
      if (middle[x] == kVoteNone) {
        out[x] = 0;
        continue;
      }
      const bool whole = x >= kSupportRadius && x + kSupportRadius < width;
      const int columns =
          whole ? kSide
                : std::min(x + kSupportRadius, width - 1) - std::max(x - kSupportRadius, 0) + 1;
      const std::uint64_t pixels = static_cast<std::uint64_t>(rows) * columns;
      const std::uint64_t all = 255 * pixels * pixels * pixels;
      const std::uint64_t count = scratch.count[x];
      const std::uint64_t product = count * count * scratch.ratio[x];
      out[x] = std::max<std::uint8_t>(kCubeRoots[product * kRootSteps / all], 1);
    }
  }
}

void remove_doubtful(int least, int y0, int y1, Image<std::int32_t>& map,
                     Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::uint8_t* values = confidence.row(y);
    for (int x = 0; x < map.width(); ++x) {
      if (values[x] >= least) continue;
      row[x] = kNoDisparity;
      values[x] = 0;
    }
  }
}

void clear_confidence(const Image<std::int32_t>& map, int y0, int y1,
                      Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (map.row(y)[x] == kNoDisparity) confidence.row(y)[x] = 0;
    }
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
