// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/outlier_removal.hpp"

#include <algorithm>
#include <cstdlib>

#include "mtstereo/image.hpp"

#define HWY_TARGET_INCLUDE "stages/nodes/outlier_removal.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Largest window in columns, rounded up to the widest vector.
constexpr int kMaxColumns = 64;
static_assert(2 * kLargestOutlierRadius <= kMaxColumns);

/// Number of pixels, in the window that begins at `first`, whose disparity is within their column's
/// tolerance of `disparity`. May stop once it reaches `enough`.
template <class D>
int count_inliers(D du, const std::uint16_t* first, std::ptrdiff_t stride, int rows, int columns,
                  const std::uint16_t* tolerance, std::uint16_t disparity, int enough) {
  constexpr int kRowsBetweenChecks = 8;
  const int lanes = static_cast<int>(hn::Lanes(du));
  const auto center = hn::Set(du, disparity);
  const auto one = hn::Set(du, 1);
  int inliers = 0;
  for (int row = 0; row < rows; row += kRowsBetweenChecks) {
    const int last = std::min(row + kRowsBetweenChecks, rows);
    auto count = hn::Zero(du);
    for (int y = row; y < last; ++y) {
      const std::uint16_t* line = first + y * stride;
      for (int x = 0; x < columns; x += lanes) {
        const auto value = hn::LoadU(du, line + x);
        // One of the two saturated differences is 0, the other one is the distance.
        const auto distance =
            hn::Or(hn::SaturatedSub(value, center), hn::SaturatedSub(center, value));
        const auto beyond = hn::SaturatedSub(hn::Load(du, tolerance + x), distance);
        count = hn::Add(count, hn::Min(beyond, one));
      }
    }
    inliers += static_cast<int>(hn::GetLane(hn::SumOfLanes(du, count)));
    if (inliers >= enough) break;
  }
  return inliers;
}

void remove_rows(const VoteMap& votes, int y0, int y1, Image<std::int32_t>& map) {
  const hn::CappedTag<std::uint16_t, kAlignment / 2> du;
  const int radius = votes.radius;
  // One more than the largest difference of an inlier, so that 0, right of the window, admits none.
  alignas(kAlignment) std::uint16_t tolerance[kMaxColumns] = {};
  for (int i = 0; i < 2 * radius; ++i) {
    tolerance[i] = static_cast<std::uint16_t>(std::abs(i - radius) * kVoteOne + 1);
  }
  const int width = map.width();
  const int height = map.height();
  const std::ptrdiff_t stride = votes.disparity.stride();
  for (int y = y0; y < y1; ++y) {
    std::int32_t* out = map.row(y);
    const int top = std::max(y - radius, 0);
    const int bottom = std::min(y + radius, height);
    const std::uint32_t* above = votes.integral.row(top);
    const std::uint32_t* below = votes.integral.row(bottom);
    for (int x = 0; x < width; ++x) {
      if (out[x] == kNoDisparity) continue;
      const int left = std::max(x - radius, 0);
      const int right = std::min(x + radius, width);
      const int voters = static_cast<int>(below[right] - below[left] - above[right] + above[left]);
      const int enough = (voters + 1) / 2;
      // Column x of the view is column x + radius of the padded copy.
      const int inliers =
          count_inliers(du, votes.disparity.row(top) + x, stride, bottom - top, 2 * radius,
                        tolerance, votes.disparity.row(y)[x + radius], enough);
      if (inliers < enough) out[x] = kNoDisparity;
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(remove_rows);

void VoteMap::resize(int width, int height, int window_radius) {
  radius = window_radius;
  disparity.resize(width + 2 * radius, height);
  integral.resize(width + 1, height + 1);
}

void copy_votes(const Image<std::int32_t>& map, int y0, int y1, VoteMap& votes) {
  constexpr int kRatio = kDisparityOne / kVoteOne;
  const int width = map.width();
  if (y0 == 0) std::fill_n(votes.integral.row(0), width + 1, 0u);
  for (int y = y0; y < y1; ++y) {
    const std::int32_t* in = map.row(y);
    std::uint16_t* out = votes.disparity.row(y);
    std::fill_n(out, votes.disparity.stride(), kVoteNone);
    std::uint32_t* sums = votes.integral.row(y + 1);
    sums[0] = 0;
    for (int x = 0; x < width; ++x) {
      const bool known = in[x] != kNoDisparity;
      if (known) out[x + votes.radius] = static_cast<std::uint16_t>((in[x] + kRatio / 2) / kRatio);
      sums[x + 1] = sums[x] + known;
    }
  }
}

void sum_votes(int x0, int x1, VoteMap& votes) {
  for (int y = 1; y < votes.integral.height(); ++y) {
    const std::uint32_t* above = votes.integral.row(y - 1);
    std::uint32_t* sums = votes.integral.row(y);
    for (int x = x0; x < x1; ++x) sums[x] += above[x];
  }
}

void remove_outliers(const VoteMap& votes, int y0, int y1, Image<std::int32_t>& map) {
  if (votes.radius == 0) return;
  HWY_DYNAMIC_DISPATCH(remove_rows)(votes, y0, y1, map);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
