// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/coarse_search.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>

#define HWY_TARGET_INCLUDE "alignment/coarse_search.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// The sums of the absolute differences of eight adjacent lanes each.
template <typename Vector>
auto sums_of_differences(Vector a, Vector b) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128
  // One instruction; Highway has it from 1.1 on.
  return hn::VFromD<hn::Repartition<std::uint64_t, hn::DFromV<Vector>>>{_mm_sad_epu8(a.raw, b.raw)};
#else
  return hn::SumsOf8(hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a)));
#endif
}

/// The sum of the absolute differences of the rows y0 .. y1 - 1 of two patches.
std::int32_t compare_rows(const std::uint8_t* patch, std::ptrdiff_t patch_stride,
                          const std::uint8_t* place, std::ptrdiff_t stride, int y0, int y1) {
  const hn::FixedTag<std::uint8_t, kPatchWidth> d8;
  const hn::Repartition<std::uint64_t, decltype(d8)> d64;
  auto sums = hn::Zero(d64);
  for (int y = y0; y < y1; ++y) {
    const auto a = hn::LoadU(d8, patch + y * patch_stride);
    const auto b = hn::LoadU(d8, place + y * stride);
    sums = hn::Add(sums, sums_of_differences(a, b));
  }
  return static_cast<std::int32_t>(hn::GetLane(hn::SumOfLanes(d64, sums)));
}

/// The costs of `count` adjacent places in one row: costs[i] compares the patches whose first
/// pixels are `patch` and `places` + i. A cost that is clearly too large to matter is not summed up
/// to the end: more than `factor` times the least one so far, `least`.
void compare_patches(const std::uint8_t* patch, std::ptrdiff_t patch_stride,
                     const std::uint8_t* places, std::ptrdiff_t stride, int count, double factor,
                     std::int32_t& least, std::int32_t* costs) {
  constexpr int kFirstRows = 4;
  double limit = factor * least;
  for (int i = 0; i < count; ++i) {
    // The middle rows first: there the patch has its corner.
    constexpr int kStart = (kPatchRows - kFirstRows) / 2, kEnd = kStart + kFirstRows;
    costs[i] = compare_rows(patch, patch_stride, places + i, stride, kStart, kEnd);
    if (costs[i] > limit) continue;
    costs[i] += compare_rows(patch, patch_stride, places + i, stride, 0, kStart) +
                compare_rows(patch, patch_stride, places + i, stride, kEnd, kPatchRows);
    if (costs[i] >= least) continue;
    least = costs[i];
    limit = factor * least;
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(compare_patches);

namespace {

/// Places x0 .. x1, y0 .. y1.
struct Area {
  int x0, x1, y0, y1;

  int width() const { return x1 - x0 + 1; }
};

/// All places in reach of (x, y) whose patches lie inside the image.
Area area_around(int x0, int x1, int y, int rows, const Image<std::uint8_t>& image) {
  return {std::max(x0, kPatchWidth / 2), std::min(x1, image.width() - kPatchWidth / 2),
          std::max(y - rows, kPatchRows / 2),
          std::min(y + rows, image.height() - 1 - kPatchRows / 2)};
}

const std::uint8_t* patch_at(const Image<std::uint8_t>& image, int x, int y) {
  return image.row(y - kPatchRows / 2) + x - kPatchWidth / 2;
}

/// The least costs of an area: the best place, and the best one that is not near it.
struct Best {
  int x = 0;
  int y = 0;
  std::int32_t cost = 0;
  std::int32_t other = -1;  ///< -1 if there is no other place

  bool is_distinct() const { return other < 0 || other > kDistinctness * cost; }
};

/// The best places for the patch at (x, y). Costs of more than `factor` times the least one may be
/// too small, but are above that limit.
std::optional<Best> search(const Image<std::uint8_t>& from, int x, int y,
                           const Image<std::uint8_t>& in, const Area& area, double factor,
                           SearchScratch& scratch) {
  if (area.x0 > area.x1 || area.y0 > area.y1) return {};
  const int width = area.width();
  std::int32_t* costs = scratch.costs.data();
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  const auto compare_row = [&](int j) {
    HWY_DYNAMIC_DISPATCH(compare_patches)
    (patch_at(from, x, y), from.stride(), patch_at(in, area.x0, j), in.stride(), width, factor,
     least, costs + (j - area.y0) * width);
  };
  // Near the middle first, where the place most likely is: then few others are compared fully.
  const int middle = std::clamp(y, area.y0, area.y1);
  for (int j = middle; j <= area.y1; ++j) compare_row(j);
  for (int j = middle - 1; j >= area.y0; --j) compare_row(j);
  const int count = width * (area.y1 - area.y0 + 1);
  const int at = static_cast<int>(std::min_element(costs, costs + count) - costs);
  Best best;
  best.x = area.x0 + at % width;
  best.y = area.y0 + at / width;
  best.cost = costs[at];
  for (int i = 0; i < count; ++i) {
    if (best.other >= 0 && costs[i] >= best.other) continue;
    if (std::abs(i % width - at % width) <= kNeighborhood &&
        std::abs(i / width - at / width) <= kNeighborhood) {
      continue;
    }
    best.other = costs[i];
  }
  return best;
}

/// Sum of the absolute differences of a patch from the local mean.
int contrast_at(const Image<std::uint8_t>& image, int x, int y) {
  int sum = 0;
  for (int j = 0; j < kPatchRows; ++j) {
    const std::uint8_t* row = patch_at(image, x, y) + j * image.stride();
    for (int i = 0; i < kPatchWidth; ++i) sum += std::abs(row[i] - 128);
  }
  return sum;
}

}  // namespace

void SearchScratch::resize(const SearchWindow& window) {
  costs.resize(static_cast<std::size_t>(window.most_disparity - window.least_disparity + 1) *
               (2 * window.rows + 1));
}

Place find_in_right_view(const Image<std::uint8_t>& left, const Image<std::uint8_t>& right,
                         const Corner& corner, const SearchWindow& window, SearchScratch& scratch) {
  using Outcome = Place::Outcome;
  scratch.resize(window);
  const Area there = area_around(corner.x - window.most_disparity,
                                 corner.x - window.least_disparity, corner.y, window.rows, right);
  const std::optional<Best> best =
      search(left, corner.x, corner.y, right, there, kDistinctness, scratch);
  if (!best) return {};
  if (!best->is_distinct()) {
    const bool similar = best->cost < kRepeatedCost * contrast_at(left, corner.x, corner.y);
    return {similar ? Outcome::kRepeated : Outcome::kNotFound};
  }
  const Area here = area_around(best->x + window.least_disparity, best->x + window.most_disparity,
                                best->y, window.rows, left);
  const std::optional<Best> back = search(right, best->x, best->y, left, here, 1, scratch);
  if (!back || std::abs(back->x - corner.x) > 1 || std::abs(back->y - corner.y) > 1) return {};
  return {Outcome::kFound, best->x, best->y};
}

}  // namespace mtstereo
#endif  // HWY_ONCE
