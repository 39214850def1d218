// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/completion.hpp"

#include <algorithm>

#include "mtstereo/image.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/completion.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

// Compilers vectorize the loops, for the target.

/// Raises the confidence of known disparities.
void raise_known(const std::int32_t* __restrict__ disparity, int width,
                 std::uint8_t* __restrict__ confidence) {
  for (int x = 0; x < width; ++x) {
    const std::uint8_t least = disparity[x] == kNoDisparity ? 0 : kMostInferred + 1;
    confidence[x] = std::max(confidence[x], least);
  }
}

/// The end of the blocks of 32 known disparities from `begin` on.
std::int32_t* known_blocks(std::int32_t* begin, std::int32_t* end) {
  constexpr int kBlock = 32;
  const auto whole = [](const std::int32_t* block) HWY_ATTR {
    int unknown = 0;
    for (int i = 0; i < kBlock; ++i) unknown |= block[i] == kNoDisparity;
    return unknown == 0;
  };
  while (end - begin >= kBlock && whole(begin)) begin += kBlock;
  return begin;
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(raise_known);
HWY_EXPORT(known_blocks);

namespace {

/// A row's disparities and their confidence.
struct Row {
  std::int32_t* disparity;
  std::uint8_t* confidence;
  int width;
};

/// Fills the pixels begin .. end - 1. The pixels before and after them have disparities, or are
/// outside of the row; not both are outside.
void fill(const Row& row, int begin, int end) {
  const bool has_left = begin > 0, has_right = end < row.width;
  const std::int32_t before = row.disparity[has_left ? begin - 1 : end];
  const std::int32_t after = row.disparity[has_right ? end : begin - 1];
  std::fill(row.disparity + begin, row.disparity + end, std::min(before, after));
  for (int x = begin; x < end; ++x) {
    const int from_left = has_left ? x - begin : row.width;
    const int from_right = has_right ? end - 1 - x : row.width;
    const int distance = std::min(from_left, from_right);
    row.confidence[x] =
        static_cast<std::uint8_t>(std::max(kMostInferred - distance / kInferredStep, 1));
  }
}

/// The first unknown disparity, or `end`.
std::int32_t* find_gap(std::int32_t* begin, std::int32_t* end) {
  return std::find(HWY_DYNAMIC_DISPATCH(known_blocks)(begin, end), end, kNoDisparity);
}

/// Completes the row, unless it is empty.
void complete(const Row& row) {
  std::int32_t* const begin = row.disparity;
  std::int32_t* const end = begin + row.width;
  HWY_DYNAMIC_DISPATCH(raise_known)(begin, row.width, row.confidence);
  std::int32_t* gap = find_gap(begin, end);
  while (gap != end) {
    std::int32_t* const after = std::find_if(gap, end, [](auto d) { return d != kNoDisparity; });
    if (gap == begin && after == end) return;
    fill(row, static_cast<int>(gap - begin), static_cast<int>(after - begin));
    gap = find_gap(after, end);
  }
}

}  // namespace

void complete_rows(int y0, int y1, Image<std::int32_t>& map, Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) complete({map.row(y), confidence.row(y), map.width()});
}

void complete_empty_rows(Image<std::int32_t>& map, Image<std::uint8_t>& confidence) {
  const int width = map.width(), height = map.height();
  // Rows are complete or empty, so the first pixel says which.
  const auto empty = [&](int y) { return map.row(y)[0] == kNoDisparity; };
  const auto copy = [&](int from, int to) {
    std::copy_n(map.row(from), width, map.row(to));
    std::fill_n(confidence.row(to), width, std::uint8_t{1});
  };
  int last = -1;  // the last row that was not empty
  for (int y = 0; y < height; ++y) {
    if (!empty(y)) {
      // The upper rows are nearest to the first one; in a gap the lower half to the one after it.
      const int first = last < 0 ? 0 : last + 1 + (y - last - 1 + 1) / 2;
      for (int to = first; to < y; ++to) copy(y, to);
      for (int to = last + 1; last >= 0 && to < first; ++to) copy(last, to);
      last = y;
    }
  }
  if (last < 0) {
    std::fill_n(map.row(0), width, std::int32_t{1});
    std::fill_n(confidence.row(0), width, std::uint8_t{1});
    last = 0;
  }
  for (int to = last + 1; to < height; ++to) copy(last, to);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
