// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/census_cost.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

#include "stages/pixels/census_window.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/census_cost.cpp"
#include "base/simd.hpp"
#include "stages/pixels/window_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Narrow = hn::CappedTag<std::uint8_t, kCostStep>;
using Wide = hn::CappedTag<std::uint8_t, 2 * kCostStep>;

/// Whether each pixel's costs fill whole wide vectors.
bool is_wide(const CensusWindow& window) {
  const int wide = static_cast<int>(hn::MaxLanes(Wide()));
  return wide > static_cast<int>(hn::MaxLanes(Narrow())) && window.lanes % wide == 0 &&
         window.matched == nullptr;
}

/// Counts the differing bits of one left pixel and its right pixels at all disparities.
template <class D8>
class Difference {
 public:
  /// In the mirrored row, the right pixel of column x at disparity d is width - 1 - x + d.
  Difference(const CensusRow& row, int width, int x)
      : bits0_(hn::Set(D8(), row.left[0][x])),
        bits1_(hn::Set(D8(), row.left[1][x])),
        bits2_(hn::Set(D8(), row.left[2][x])),
        right0_(row.right[0] + (width - 1 - x)),
        right1_(row.right[1] + (width - 1 - x)),
        right2_(row.right[2] + (width - 1 - x)) {}

  HWY_INLINE hn::Vec<D8> count(int d) const {
    const D8 d8;
    const auto count0 = hn::PopulationCount(hn::Xor(bits0_, hn::LoadU(d8, right0_ + d)));
    const auto count1 = hn::PopulationCount(hn::Xor(bits1_, hn::LoadU(d8, right1_ + d)));
    const auto count2 = hn::PopulationCount(hn::Xor(bits2_, hn::LoadU(d8, right2_ + d)));
    return hn::Add(hn::Add(count0, count1), count2);
  }

 private:
  static_assert(kCensusBytes == 3);
  hn::Vec<D8> bits0_, bits1_, bits2_;
  const std::uint8_t* right0_;
  const std::uint8_t* right1_;
  const std::uint8_t* right2_;
};

/// Calls `vector(d)` for each vector of a window; kVectors: their number, or 0 if it is not known.
template <int kVectors, class D8, class Vector>
HWY_INLINE void for_each_vector(CostWindow window, const Vector& vector) {
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(D8()));
  if constexpr (kVectors > 0) {
    for (int i = 0; i < kVectors; ++i) vector(window.begin + i * kLanes);
  } else {
    for (int d = window.begin; d < window.end; d += kLanes) vector(d);
  }
}

/// Counts the differing bits of the columns x0 .. x1 - 1 of the entering rows.
void count_columns(const CensusWindow& window, CostWindow lanes, int x0, int x1,
                   std::uint8_t* const (&rows)[kPairedRows]) {
  const Narrow d8;
  for (int row = 0; row < kPairedRows; ++row) {
    for (int x = x0; x < x1; ++x) {
      std::uint8_t* counts = rows[row] + static_cast<std::ptrdiff_t>(x) * window.lanes;
      const Difference<Narrow> in(window.in[row], window.width, x);
      for_each_vector<0, Narrow>(lanes,
                                 [&](int d) HWY_ATTR { hn::StoreU(in.count(d), d8, counts + d); });
    }
  }
}

/// Counts the bits of the entering rows, and sums the counts of the rows of both windows.
template <int kSize, class D8>
void sum_columns(const CensusWindow& window, CostWindow lanes, int x0, int x1) {
  with_vectors<D8>(lanes, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
    for (int x = x0; x < x1; ++x) {
      const D8 d8;
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * window.lanes;
      std::uint8_t* sums = window.sums_of(x);
      const Difference<D8> upper(window.in[0], window.width, x);
      const Difference<D8> lower(window.in[1], window.width, x);
      for_each_vector<kVectors, D8>(lanes, [&](int d) HWY_ATTR {
        const auto upper_count = upper.count(d);
        const auto lower_count = lower.count(d);
        if constexpr (kSize == 1) {
          hn::StoreU(upper_count, d8, sums + d);
          hn::StoreU(lower_count, d8, sums + window.lanes + d);
        } else {
          auto shared = upper_count;
          for (int i = 1; i < kSize - 1; ++i) {
            shared = hn::Add(shared, hn::LoadU(d8, window.rows[i] + first + d));
          }
          const auto leaving = hn::LoadU(d8, window.rows[0] + first + d);
          hn::StoreU(hn::Add(shared, leaving), d8, sums + d);
          hn::StoreU(hn::Add(shared, lower_count), d8, sums + window.lanes + d);
          hn::StoreU(upper_count, d8, window.rows[kSize - 1] + first + d);
          hn::StoreU(lower_count, d8, window.rows[kSize] + first + d);
        }
      });
    }
  });
}

/// Divides the columns x0 .. x1 - 1 by the lanes that must be counted for the costs of the columns
/// up to `reach` away, and calls `count(lanes, begin, end)`.
template <class Count>
HWY_INLINE void for_counted_lanes(const CensusWindow& window, int reach, int x0, int x1,
                                  const Count& count) {
  const auto tile_of = [&](int x) {
    return std::clamp(x, 0, window.width - 1) / kWindowTile * kWindowTile;
  };
  while (x0 < x1) {
    const int left = tile_of(x0 - reach), right = tile_of(x0 + reach);
    // Up to here both tiles stay the same.
    const int left_end = left + kWindowTile + reach, right_end = right + kWindowTile - reach;
    const int end = right + kWindowTile < window.width ? std::min(left_end, right_end) : left_end;
    const int begin = std::exchange(x0, std::min(end, x1));
    count(joined(window_at(window.counted, window.lanes, left),
                 window_at(window.counted, window.lanes, right)),
          begin, x0);
  }
}

/// Counts two of the window's first rows.
void add_rows(const CensusWindow& of_window, int reach) {
  const CensusWindow window = of_window;
  std::uint8_t* const rows[] = {window.rows[2 * reach], window.rows[2 * reach + 1]};
  for_counted_lanes(window, reach, 0, window.width, [&](CostWindow lanes, int x0, int x1) {
    count_columns(window, lanes, x0, x1, rows);
  });
}

/// The binomially weighted mean of 1, 3 or 5 columns' sums from `at` on.
template <int kSize, class D8>
HWY_INLINE hn::Vec<D8> mean_along_row(D8 d8, const ColumnSums& sums, int at) {
  const auto middle = hn::LoadU(d8, sums.of[2] + at);
  if (kSize == 1) return middle;
  const auto near =
      hn::AverageRound(hn::LoadU(d8, sums.of[1] + at), hn::LoadU(d8, sums.of[3] + at));
  if (kSize == 3) return hn::AverageRound(near, middle);
  // Weights 1 4 6 4 1, in sixteenths.
  const auto far = hn::AverageRound(hn::LoadU(d8, sums.of[0] + at), hn::LoadU(d8, sums.of[4] + at));
  const auto rest = hn::AverageRound(middle, hn::AverageRound(far, middle));
  return hn::AverageRound(near, rest);
}

/// Writes the costs of both rows' pixels in one column, where the disparities low .. high are
/// expected.
template <int kSize, int kVectors, class D8>
HWY_INLINE void write_costs(const CensusWindow& window, CostWindow matched, int disparities,
                            const ColumnSums& sums, int low, int high, const CensusTables& tables,
                            std::uint8_t* upper, std::uint8_t* lower) {
  const D8 d8;
  const int lanes = window.lanes;
  const auto mean = [&](int at) HWY_ATTR { return mean_along_row<kSize>(d8, sums, at); };
  if (low > high || (low == 0 && high == disparities - 1)) {
    for_each_vector<kVectors, D8>(matched, [&](int d) HWY_ATTR {
      const auto never = hn::LoadU(d8, tables.never + d);
      hn::StoreU(hn::Max(mean(d), never), d8, upper + d);
      hn::StoreU(hn::Max(mean(lanes + d), never), d8, lower + d);
    });
    return;
  }
  // Views into tables of two halves, shifted such that disparities below `low` and above `high` get
  // the penalty.
  const std::uint8_t* below = tables.below + lanes - low;
  const std::uint8_t* above = tables.above + lanes - 1 - high;
  for_each_vector<kVectors, D8>(matched, [&](int d) HWY_ATTR {
    const auto penalty = hn::Max(hn::LoadU(d8, below + d), hn::LoadU(d8, above + d));
    const auto never = hn::LoadU(d8, tables.never + d);
    hn::StoreU(hn::Max(hn::SaturatedAdd(mean(d), penalty), never), d8, upper + d);
    hn::StoreU(hn::Max(hn::SaturatedAdd(mean(lanes + d), penalty), never), d8, lower + d);
  });
}

/// Counts the rows that enter the windows and writes the costs, tile by tile, while the sums of the
/// adjacent columns are in the cache.
template <int kSize, class D8>
void write_rows_of(const CensusWindow& of_window, int disparities, const std::uint16_t* low,
                   const std::uint16_t* high, const CensusTables& of_tables, std::uint8_t* costs) {
  // Copies: the compiler knows that no store of bytes changes them.
  const CensusWindow window = of_window;
  const CensusTables tables = of_tables;
  constexpr int kReach = kSize / 2;
  const int last = window.width - 1;
  const std::ptrdiff_t lanes = window.lanes;
  const auto sums_at = [&](int x) { return window.sums_of(std::clamp(x, 0, last)); };
  int summed = 0;
  for (int x0 = 0; x0 < window.width; x0 += kWindowTile) {
    const int x1 = std::min(x0 + kWindowTile, window.width);
    const int needed = std::min(x1 + kReach, window.width);
    for_counted_lanes(window, kReach, summed, needed, [&](CostWindow counted, int begin, int end) {
      sum_columns<kSize, D8>(window, counted, begin, end);
    });
    summed = needed;
    const CostWindow matched = window_at(window.matched, window.lanes, x0);
    with_vectors<D8>(matched, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
      std::uint8_t* upper = costs + x0 * lanes;
      std::uint8_t* lower = upper + window.width * lanes;
      ColumnSums sums = {{sums_at(x0 - 2), sums_at(x0 - 1), sums_at(x0), sums_at(x0 + 1), nullptr}};
      for (int x = x0; x < x1; ++x, upper += lanes, lower += lanes) {
        sums.of[4] = sums_at(x + 2);
        write_costs<kSize, kVectors, D8>(window, matched, disparities, sums, low[x], high[x],
                                         tables, upper, lower);
        for (int i = 0; i < 4; ++i) sums.of[i] = sums.of[i + 1];
      }
    });
  }
}

void write_rows(const CensusWindow& window, const CensusCostOptions& options,
                const std::uint16_t* low, const std::uint16_t* high, const CensusTables& tables,
                std::uint8_t* costs) {
  const auto by_size = [&]<class D8>(D8) {
    return options.kernel_size == 5   ? write_rows_of<5, D8>
           : options.kernel_size == 3 ? write_rows_of<3, D8>
                                      : write_rows_of<1, D8>;
  };
  const auto write = is_wide(window) ? by_size(Wide()) : by_size(Narrow());
  write(window, options.disparities, low, high, tables, costs);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(add_rows);
HWY_EXPORT(write_rows);

namespace {

int wrapped(int i, int count) { return (i % count + count) % count; }

/// Rows of which two successive windows consist.
int window_rows(const CensusCostOptions& options) { return options.kernel_size + 1; }

/// Bytes of the planes of a row of both views.
std::size_t plane_bytes(int width, int lanes) {
  return kCensusBytes * (2 * static_cast<std::size_t>(width) + lanes);
}

/// Splits row y of both views into planes. Rows outside of the image repeat the border's row.
CensusRow split_row(const CensusImage& left, const CensusImage& right, int y, int lanes,
                    std::uint8_t* planes) {
  const int width = left.bits.width();
  const int inside = std::clamp(y, 0, left.bits.height() - 1);
  CensusRow row{};
  for (std::uint8_t*& plane : row.left) plane = std::exchange(planes, planes + width);
  for (std::uint8_t*& plane : row.right) plane = std::exchange(planes, planes + width + lanes);
  split_census_row(left.bits.row(inside), width, RowOrder::kForward, 0, row.left);
  split_census_row(right.bits.row(inside), width, RowOrder::kMirrored, lanes, row.right);
  return row;
}

/// Prepares the windows of the rows y and y + 1, which the last two of their rows enter.
CensusWindow windows_of(const CensusImage& left, const CensusImage& right,
                        const SearchWindows& windows, const CensusCostOptions& options, int y,
                        CensusCostScratch& scratch) {
  const int width = left.bits.width();
  const int lanes = cost_lanes(options.disparities);
  const int reach = options.kernel_size / 2, rows = window_rows(options);
  const int entering = y + reach;
  CensusWindow window = {};
  window.width = width;
  window.lanes = lanes;
  for (int i = 0; i < kPairedRows; ++i) {
    std::uint8_t* planes = scratch.planes.data() + i * plane_bytes(width, lanes);
    window.in[i] = split_row(left, right, entering + i, lanes, planes);
  }
  for (int i = 0; i < rows; ++i) {
    const std::ptrdiff_t slot = wrapped(y - reach + i, rows);
    window.rows[i] = scratch.counts.data() + slot * width * lanes;
  }
  window.counted = windows.covering(entering - reach, entering + 1 + reach);
  window.sums = scratch.sums.data();
  return window;
}

}  // namespace

void CensusCostScratch::resize(int width, const CensusCostOptions& options) {
  const int lanes = cost_lanes(options.disparities);
  planes.resize(kPairedRows * plane_bytes(width, lanes));
  counts.resize(static_cast<std::size_t>(width) * lanes * window_rows(options));
  sums.resize(static_cast<std::size_t>(kSummedColumns) * kPairedRows * lanes);
  tables.resize(5 * static_cast<std::size_t>(lanes));
  const int penalty = std::min(options.range_penalty * cost_scale(options), 255);
  std::uint8_t* below = tables.data();
  std::uint8_t* above = below + 2 * lanes;
  std::uint8_t* never = above + 2 * lanes;
  std::memset(below, penalty, lanes);
  std::memset(below + lanes, 0, lanes);
  std::memset(above, 0, lanes);
  std::memset(above + lanes, penalty, lanes);
  std::memset(never, 0, options.disparities);
  std::memset(never + options.disparities, kCensusNever, lanes - options.disparities);
}

void start_census_costs(const CensusImage& left, const CensusImage& right,
                        const SearchWindows& windows, const CensusCostOptions& options, int y,
                        CensusCostScratch& scratch) {
  const int reach = options.kernel_size / 2;
  for (int before = reach; before > 0; --before) {
    HWY_DYNAMIC_DISPATCH(add_rows)
    (windows_of(left, right, windows, options, y - kPairedRows * before, scratch), reach);
  }
}

void census_cost_rows(const CensusImage& left, const CensusImage& right,
                      const SearchWindows& windows, const CensusCostOptions& options, int y,
                      const std::uint16_t* low, const std::uint16_t* high,
                      CensusCostScratch& scratch, std::uint8_t* costs) {
  const std::size_t lanes = cost_lanes(options.disparities);
  const std::uint8_t* tables = scratch.tables.data();
  CensusWindow window = windows_of(left, right, windows, options, y, scratch);
  window.matched = windows.row(y);
  HWY_DYNAMIC_DISPATCH(write_rows)
  (window, options, low, high, {tables, tables + 2 * lanes, tables + 4 * lanes}, costs);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
