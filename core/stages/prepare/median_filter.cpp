// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/median_filter.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#define HWY_TARGET_INCLUDE "stages/prepare/median_filter.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Bytes = hn::CappedTag<std::uint8_t, kAlignment>;
using Vector = hn::Vec<Bytes>;

HWY_INLINE int lanes() { return static_cast<int>(hn::Lanes(Bytes())); }

HWY_INLINE Vector load(const std::uint8_t* from) { return hn::LoadU(Bytes(), from); }

HWY_INLINE void store(const Vector& vector, std::uint8_t* to) { hn::StoreU(vector, Bytes(), to); }

HWY_INLINE void exchange(Vector& smaller, Vector& larger) {
  const Vector least = hn::Min(smaller, larger);
  larger = hn::Max(smaller, larger);
  smaller = least;
}

/// A compare-exchange of two elements: the first one gets the smaller value.
struct Exchange {
  std::uint8_t smaller, larger;
};

/// Sorts 5 values.
constexpr Exchange kSortColumn[] = {{0, 3}, {1, 4}, {0, 2}, {1, 3}, {0, 1},
                                    {2, 4}, {1, 2}, {3, 4}, {2, 3}};

/// Moves the median of 5x5 values with sorted columns to the middle. Element 5 i + k is the i-th of
/// column k. The network is the result of a computer search for few exchanges; only one output of
/// half of them is used, and compilers drop the other one. Such a network is correct for all values
/// if it is correct for all sorted columns of zeros and ones.
constexpr Exchange kFindMedian[] = {
    {21, 23}, {9, 8},   {0, 2},   {6, 7},   {20, 22}, {1, 4},   {12, 14}, {2, 4},   {1, 2},
    {11, 14}, {12, 13}, {3, 4},   {16, 19}, {5, 8},   {15, 17}, {21, 24}, {5, 6},   {7, 9},
    {10, 13}, {8, 9},   {12, 16}, {10, 12}, {6, 7},   {15, 24}, {0, 3},   {20, 23}, {17, 19},
    {2, 3},   {15, 18}, {11, 12}, {12, 18}, {13, 14}, {15, 16}, {11, 15}, {7, 8},   {4, 17},
    {20, 21}, {13, 8},  {12, 16}, {21, 22}, {3, 7},   {7, 15},  {17, 18}, {4, 12},  {8, 16},
    {20, 13}, {12, 13}, {8, 12},  {12, 17}, {15, 8},  {8, 21},  {9, 13},  {15, 4},  {8, 12},
    {4, 20},  {8, 9},   {12, 20}, {8, 12}};

/// Runs a network. `values` is a tuple of references, since vectors of some targets cannot be array
/// elements.
template <const auto& kNetwork, class Values>
HWY_INLINE void exchange_all(const Values& values) {
  [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) HWY_ATTR {
    (exchange(std::get<kNetwork[kIndex].smaller>(values),
              std::get<kNetwork[kIndex].larger>(values)),
     ...);
  }
  (std::make_index_sequence<std::size(kNetwork)>());
}

void sort_vector(const std::uint8_t* const* rows, int from, std::uint8_t* const* sorted, int to) {
  const auto column = [&](int i) HWY_ATTR { return load(rows[i] + from); };
  Vector v0 = column(0), v1 = column(1), v2 = column(2), v3 = column(3), v4 = column(4);
  exchange_all<kSortColumn>(std::tie(v0, v1, v2, v3, v4));
  store(v0, sorted[0] + to);
  store(v1, sorted[1] + to);
  store(v2, sorted[2] + to);
  store(v3, sorted[3] + to);
  store(v4, sorted[4] + to);
}

/// Sorts the columns of five rows. Reads nothing past the end of the rows, which may be in the
/// caller's image.
void sort_columns(const std::uint8_t* const* rows, int width, std::uint8_t* const* sorted) {
  const int step = lanes();
  int x = 0;
  for (; x + step <= width; x += step) sort_vector(rows, x, sorted, x);
  if (x < width) {
    alignas(kAlignment) std::uint8_t copies[kMedianSide][kAlignment] = {};
    const std::uint8_t* last[kMedianSide];
    for (int i = 0; i < kMedianSide; ++i) {
      std::memcpy(copies[i], rows[i] + x, width - x);
      last[i] = copies[i];
    }
    sort_vector(last, 0, sorted, x);
  }
}

/// The medians of a row from its sorted columns and two further columns on both sides.
void write_medians(const std::uint8_t* const* sorted, int width, std::uint8_t* medians) {
  for (int x = 0; x < width; x += lanes()) {
    const auto place = [&](int i, int k)
                           HWY_ATTR { return load(sorted[i] + x + k - kMedianSide / 2); };
    Vector a0 = place(0, 0), a1 = place(0, 1), a2 = place(0, 2), a3 = place(0, 3), a4 = place(0, 4);
    Vector b0 = place(1, 0), b1 = place(1, 1), b2 = place(1, 2), b3 = place(1, 3), b4 = place(1, 4);
    Vector c0 = place(2, 0), c1 = place(2, 1), c2 = place(2, 2), c3 = place(2, 3), c4 = place(2, 4);
    Vector d0 = place(3, 0), d1 = place(3, 1), d2 = place(3, 2), d3 = place(3, 3), d4 = place(3, 4);
    Vector e0 = place(4, 0), e1 = place(4, 1), e2 = place(4, 2), e3 = place(4, 3), e4 = place(4, 4);
    exchange_all<kFindMedian>(std::tie(a0, a1, a2, a3, a4, b0, b1, b2, b3, b4, c0, c1, c2, c3, c4,
                                       d0, d1, d2, d3, d4, e0, e1, e2, e3, e4));
    store(c2, medians + x);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(sort_columns);
HWY_EXPORT(write_medians);

namespace {

constexpr int kRadius = kMedianSide / 2;

/// Repeats the end elements of a row.
void repeat_ends(std::uint8_t* row, int width) {
  std::memset(row - kRadius, row[0], kRadius);
  std::memset(row + width, row[width - 1], kRadius);
}

}  // namespace

void MedianScratch::resize(int width) {
  // The last vector may extend past the end of the row.
  for (Buffer<std::uint8_t>& row : sorted) row.resize(width + 2 * kRadius + kAlignment);
}

void median_rows(GrayView image, int y0, int y1, MedianScratch& scratch,
                 Image<std::uint8_t>& median) {
  scratch.resize(image.width);
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* rows[kMedianSide];
    std::uint8_t* sorted[kMedianSide];
    for (int i = 0; i < kMedianSide; ++i) {
      rows[i] = image.row(std::clamp(y + i - kRadius, 0, image.height - 1));
      sorted[i] = scratch.sorted[i].data() + kRadius;
    }
    HWY_DYNAMIC_DISPATCH(sort_columns)(rows, image.width, sorted);
    for (std::uint8_t* row : sorted) repeat_ends(row, image.width);
    HWY_DYNAMIC_DISPATCH(write_medians)(sorted, image.width, median.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
