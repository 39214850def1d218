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
  HWY_INLINE Difference(const CensusRow& row, int width, int x) {
    const std::uint8_t* bits = row.left + std::ptrdiff_t{4} * x;
    for (int i = 0; i < kCensusBytes; ++i) {
      bits_[i] = hn::Set(D8(), bits[i]);
      right_[i] = row.right[i] + (width - 1 - x);
    }
  }

  HWY_INLINE hn::Vec<D8> count(int d) const {
    return hn::Add(hn::Add(count(0, d), count(1, d)), count(2, d));
  }

 private:
  static_assert(kCensusBytes == 3);

  HWY_INLINE hn::Vec<D8> count(int i, int d) const {
    return hn::PopulationCount(hn::Xor(bits_[i], hn::LoadU(D8(), right_[i] + d)));
  }

  hn::Vec<D8> bits_[kCensusBytes];
  const std::uint8_t* right_[kCensusBytes];
};

/// What the difference of the gray values of one left pixel and its right pixels costs.
template <class D8>
class GrayDifference {
 public:
  HWY_INLINE GrayDifference(const GrayRow& row, int width, int x)
      : left_(hn::Set(D8(), row.left[x])), right_(row.right + (width - 1 - x)) {}

  HWY_INLINE hn::Vec<D8> cost(int d) const {
    static_assert(kGrayCost == 2);
    const D8 d8;
    const auto right = hn::LoadU(d8, right_ + d);
    const auto difference = hn::Or(hn::SaturatedSub(left_, right), hn::SaturatedSub(right, left_));
    const auto counted = hn::Min(difference, hn::Set(d8, kMostGrayDifference));
    return hn::Add(counted, counted);
  }

 private:
  hn::Vec<D8> left_;
  const std::uint8_t* right_;
};

/// Costs without the gray values.
template <class D8>
class NoGrayDifference {
 public:
  HWY_INLINE NoGrayDifference(const GrayRow&, int, int) {}
  HWY_INLINE hn::Vec<D8> cost(int) const { return hn::Zero(D8()); }
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
void count_columns(const CensusWindow& window, CostWindow lanes, int x0, int x1) {
  const Narrow d8;
  for (int x = x0; x < x1; ++x) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * window.lanes;
    const Difference<Narrow> upper(window.in[0], window.width, x);
    const Difference<Narrow> lower(window.in[1], window.width, x);
    for_each_vector<0, Narrow>(lanes, [&](int d) HWY_ATTR {
      const auto count = lower.count(d);
      hn::StoreU(hn::Add(upper.count(d), count), d8, window.first.both + first + d);
      hn::StoreU(count, d8, window.first.lower + first + d);
    });
  }
}

/// Counts the bits of the entering rows, and sums the counts of the rows of both windows.
template <int kSize, class D8>
void sum_columns(const CensusWindow& window, CostWindow lanes, int x0, int x1,
                 std::uint8_t* first_sums) {
  with_vectors<D8>(lanes, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
    std::uint8_t* sums = first_sums;
    for (int x = x0; x < x1; ++x, sums += kPairedRows * window.lanes) {
      const D8 d8;
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * window.lanes;
      std::uint8_t* both_of_pair = window.first.both + first;
      std::uint8_t* lower_of_pair = window.first.lower + first;
      const Difference<D8> upper(window.in[0], window.width, x);
      const Difference<D8> lower(window.in[1], window.width, x);
      for_each_vector<kVectors, D8>(lanes, [&](int d) HWY_ATTR {
        auto upper_sum = upper.count(d);
        auto lower_sum = lower.count(d);
        if constexpr (kSize > 1) {
          const auto entering = hn::Add(upper_sum, lower_sum);
          const auto leaving_both = hn::LoadU(d8, both_of_pair + d);
          const auto leaving = hn::LoadU(d8, lower_of_pair + d);
          hn::StoreU(entering, d8, both_of_pair + d);
          hn::StoreU(lower_sum, d8, lower_of_pair + d);
          upper_sum = hn::Add(leaving_both, upper_sum);
          lower_sum = hn::Add(leaving, entering);
          if constexpr (kSize == 5) {
            const auto middle = hn::LoadU(d8, window.middle + first + d);
            upper_sum = hn::Add(upper_sum, middle);
            lower_sum = hn::Add(lower_sum, middle);
          }
        }
        hn::StoreU(upper_sum, d8, sums + d);
        hn::StoreU(lower_sum, d8, sums + window.lanes + d);
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

/// Counts the first rows of the windows.
void add_rows(const CensusWindow& of_window, int reach) {
  const CensusWindow window = of_window;
  for_counted_lanes(window, reach, 0, window.width, [&](CostWindow lanes, int x0, int x1) {
    count_columns(window, lanes, x0, x1);
  });
}

/// The binomially weighted mean of the sums of 1, 3 or 5 columns, `stride` apart.
template <int kSize, class D8>
HWY_INLINE hn::Vec<D8> mean_along_row(D8 d8, const std::uint8_t* sums, std::ptrdiff_t stride) {
  const auto column = [&](int i) HWY_ATTR { return hn::LoadU(d8, sums + i * stride); };
  const auto middle = column(kSize / 2);
  if constexpr (kSize == 1) return middle;
  const auto near = hn::AverageRound(column(kSize / 2 - 1), column(kSize / 2 + 1));
  if constexpr (kSize == 3) return hn::AverageRound(near, middle);
  // Weights 1 4 6 4 1, in sixteenths.
  const auto far = hn::AverageRound(column(0), column(kSize - 1));
  const auto rest = hn::AverageRound(middle, hn::AverageRound(far, middle));
  return hn::AverageRound(near, rest);
}

/// Writes the costs of both rows in the columns x0 .. x1 - 1 of a tile. `sums` are those of the
/// columns x0 - kSize / 2 ..
template <int kSize, int kVectors, class D8, class Gray>
HWY_INLINE void write_costs(const CensusWindow& window, CostWindow matched, int x0, int x1,
                            const std::uint8_t* sums, const ExpectedCosts& expected,
                            std::uint8_t* upper, std::uint8_t* lower) {
  const D8 d8;
  const std::ptrdiff_t lanes = window.lanes, stride = kPairedRows * lanes;
  for (int x = x0; x < x1; ++x, sums += stride, upper += matched.size(), lower += matched.size()) {
    // Views into tables of two halves, shifted such that disparities below `low` and above `high`
    // get the penalty.
    const std::uint8_t* below = expected.below + lanes - expected.low[x];
    const std::uint8_t* above = expected.above + lanes - 1 - expected.high[x];
    const Gray upper_gray(window.gray[0], window.width, x);
    const Gray lower_gray(window.gray[1], window.width, x);
    for_each_vector<kVectors, D8>(matched, [&](int d) HWY_ATTR {
      const auto penalty = hn::Max(hn::LoadU(d8, below + d), hn::LoadU(d8, above + d));
      const auto cost = [&](const std::uint8_t* of_row, const Gray& gray) HWY_ATTR {
        const auto bits = mean_along_row<kSize>(d8, of_row + d, stride);
        return hn::SaturatedAdd(hn::SaturatedAdd(bits, gray.cost(d)), penalty);
      };
      hn::StoreU(cost(sums, upper_gray), d8, upper + (d - matched.begin));
      hn::StoreU(cost(sums + lanes, lower_gray), d8, lower + (d - matched.begin));
    });
  }
}

/// Replaces the costs of disparities that do not exist, in a tile of so many pixels.
void hide_nonexistent(CostWindow matched, int disparities, int pixels, std::uint8_t* costs) {
  const Narrow d8;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(d8));
  const auto never = hn::Set(d8, kCensusNever);
  for (int d = matched.begin; d < matched.end; d += kLanes) {
    const int exist = disparities - d;
    if (exist >= kLanes) continue;
    const auto hidden = hn::IfThenZeroElse(hn::FirstN(d8, std::max(exist, 0)), never);
    for (int i = 0; i < pixels; ++i) {
      std::uint8_t* to = costs + i * matched.size() + (d - matched.begin);
      hn::StoreU(hn::Max(hn::LoadU(d8, to), hidden), d8, to);
    }
  }
}

/// Counts the rows that enter the windows and writes the costs, tile by tile, while the sums of the
/// adjacent columns are in the cache.
template <int kSize, class D8, class Gray>
void write_rows_of(const CensusWindow& of_window, int disparities, const ExpectedCosts& of_expected,
                   std::uint8_t* (&costs)[kPairedRows]) {
  // Copies: the compiler knows that no store of bytes changes them.
  const CensusWindow window = of_window;
  const ExpectedCosts expected = of_expected;
  constexpr int kReach = kSize / 2;
  const std::ptrdiff_t stride = kPairedRows * std::ptrdiff_t{window.lanes};
  std::uint8_t* upper = costs[0];
  std::uint8_t* lower = costs[1];
  const int last = window.width - 1;
  int summed = 0;
  for (int x0 = 0; x0 < window.width; x0 += kWindowTile) {
    const int x1 = std::min(x0 + kWindowTile, window.width);
    const int needed = std::min(x1 + kReach, window.width);
    const auto sums_of = [&](int x) { return window.sums + (x - x0 + kReach) * stride; };
    // The last columns of the tile before.
    if (x0 > 0) std::memmove(window.sums, sums_of(x0 + kWindowTile - kReach), 2 * kReach * stride);
    for_counted_lanes(window, kReach, summed, needed, [&](CostWindow counted, int begin, int end) {
      sum_columns<kSize, D8>(window, counted, begin, end, sums_of(begin));
    });
    summed = needed;
    // Outside of the image the columns at the border repeat.
    for (int i = 1; i <= kReach; ++i) {
      if (x0 == 0) std::memcpy(sums_of(-i), sums_of(0), stride);
      if (x1 + i > window.width) std::memcpy(sums_of(x1 - 1 + i), sums_of(last), stride);
    }
    const CostWindow matched = window_at(window.matched, window.lanes, x0);
    with_vectors<D8>(matched, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
      write_costs<kSize, kVectors, D8, Gray>(window, matched, x0, x1, window.sums, expected, upper,
                                             lower);
    });
    for (std::uint8_t** row : {&upper, &lower}) {
      hide_nonexistent(matched, disparities, x1 - x0, *row);
      *row += (x1 - x0) * matched.size();
    }
  }
}

void write_rows(const CensusWindow& window, const CensusCostOptions& options,
                const ExpectedCosts& expected, std::uint8_t* (&costs)[kPairedRows]) {
  const auto by_size = [&]<class D8, class Gray>(D8, const Gray*) {
    return options.kernel_size == 5   ? write_rows_of<5, D8, Gray>
           : options.kernel_size == 3 ? write_rows_of<3, D8, Gray>
                                      : write_rows_of<1, D8, Gray>;
  };
  const auto by_gray = [&]<class D8>(D8 d8) {
    return window.gray[0].left == nullptr
               ? by_size(d8, static_cast<const NoGrayDifference<D8>*>(nullptr))
               : by_size(d8, static_cast<const GrayDifference<D8>*>(nullptr));
  };
  const auto write = is_wide(window) ? by_gray(Wide()) : by_gray(Narrow());
  write(window, options.disparities, expected, costs);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(add_rows);
HWY_EXPORT(write_rows);

namespace {

int wrapped(int i, int count) { return (i % count + count) % count; }

/// Bytes of the planes of a row.
std::size_t plane_bytes(int width, int lanes) {
  return kCensusBytes * (static_cast<std::size_t>(width) + lanes);
}

/// Bytes of the gray values of a row.
std::size_t gray_bytes(int width, int lanes) { return 2 * static_cast<std::size_t>(width) + lanes; }

/// Row y of both views. Rows outside of the image repeat the border's row.
CensusRow row_of(const CensusImage& left, const CensusImage& right, int y, int lanes,
                 std::uint8_t* planes) {
  const int width = left.bits.width();
  const int inside = std::clamp(y, 0, left.bits.height() - 1);
  CensusRow row{reinterpret_cast<const std::uint8_t*>(left.bits.row(inside)), {}};
  for (std::uint8_t*& plane : row.right) plane = std::exchange(planes, planes + width + lanes);
  mirror_census_row(right.bits.row(inside), width, lanes, row.right);
  return row;
}

/// Prepares the windows of the rows y and y + 1, which the last two of their rows enter. Before
/// them the windows have as many pairs of rows as they reach.
CensusWindow windows_of(const CostViews& views, const SearchWindows& windows,
                        const CensusCostOptions& options, int y, CensusCostScratch& scratch) {
  const int width = views.left.bits.width();
  const int lanes = cost_lanes(options.disparities);
  const int reach = options.kernel_size / 2;
  const bool up = scratch.direction == RowDirection::kUp;
  CensusWindow window = {};
  window.width = width;
  window.lanes = lanes;
  for (int i = 0; i < kPairedRows; ++i) {
    std::uint8_t* planes = scratch.planes.data() + i * plane_bytes(width, lanes);
    const int entering = up ? y + 1 - reach - i : y + reach + i;
    window.in[i] = row_of(views.left, views.right, entering, lanes, planes);
  }
  if (reach > 0) {
    const std::size_t cells = static_cast<std::size_t>(width) * lanes;
    const auto counts_of = [&](int pair) {
      return scratch.counts.data() + 2 * cells * wrapped(pair, reach);
    };
    window.first = {counts_of(y / 2), counts_of(y / 2) + cells};
    window.middle = counts_of(y / 2 + 1);
  }
  window.counted = windows.covering(up ? y - 2 * reach : y, up ? y + 1 : y + 1 + 2 * reach);
  window.sums = scratch.sums.data();
  return window;
}

/// The gray values of row y; outside of the image those of the border's row.
GrayRow gray_row(const GrayPair& pair, int y, int lanes, std::uint8_t* memory) {
  const int width = pair.left.width, inside = std::min(y, pair.left.height - 1);
  std::uint8_t* left = memory;
  std::uint8_t* right = memory + width;
  balance_row(pair.left, inside, pair.balance, 2 * kBalanceTile, left);
  map_row(pair.right.row(inside), width, pair.balance.mapping, right);
  std::reverse(right, right + width);
  std::fill_n(right + width, lanes, right[width - 1]);
  return {left, right};
}

}  // namespace

void CensusCostScratch::resize(int width, const CensusCostOptions& options) {
  const int lanes = cost_lanes(options.disparities);
  planes.resize(kPairedRows * plane_bytes(width, lanes));
  const int reach = options.kernel_size / 2;
  counts.resize(static_cast<std::size_t>(width) * lanes * kPairedRows * reach);
  sums.resize(static_cast<std::size_t>(kWindowTile + 2 * reach) * kPairedRows * lanes);
  tables.resize(4 * static_cast<std::size_t>(lanes));
  grays.resize(kPairedRows * gray_bytes(width, lanes));
  const int penalty = std::min(options.range_penalty * cost_scale(options), 255);
  std::uint8_t* below = tables.data();
  std::uint8_t* above = below + 2 * lanes;
  std::memset(below, penalty, lanes);
  std::memset(below + lanes, 0, lanes);
  std::memset(above, 0, lanes);
  std::memset(above + lanes, penalty, lanes);
}

void start_census_costs(const CostViews& views, const SearchWindows& windows,
                        const CensusCostOptions& options, int y, RowDirection direction,
                        CensusCostScratch& scratch) {
  scratch.direction = direction;
  const int reach = options.kernel_size / 2;
  for (int before = reach; before > 0; --before) {
    const int rows = kPairedRows * before;
    const int pair = direction == RowDirection::kUp ? y + rows : y - rows;
    HWY_DYNAMIC_DISPATCH(add_rows)
    (windows_of(views, windows, options, pair, scratch), reach);
  }
}

void census_cost_rows(const CostViews& views, const SearchWindows& windows,
                      const CensusCostOptions& options, int y, const std::uint16_t* low,
                      const std::uint16_t* high, CensusCostScratch& scratch, std::uint8_t* upper,
                      std::uint8_t* lower) {
  const int lanes = cost_lanes(options.disparities);
  const std::uint8_t* tables = scratch.tables.data();
  CensusWindow window = windows_of(views, windows, options, y, scratch);
  window.matched = windows.row(y);
  const bool up = scratch.direction == RowDirection::kUp;
  for (int i = 0; views.gray != nullptr && i < kPairedRows; ++i) {
    std::uint8_t* memory = scratch.grays.data() + i * gray_bytes(window.width, lanes);
    window.gray[i] = gray_row(*views.gray, up ? y + 1 - i : y + i, lanes, memory);
  }
  if (up) std::swap(upper, lower);
  std::uint8_t* rows[kPairedRows] = {upper, lower};
  HWY_DYNAMIC_DISPATCH(write_rows)
  (window, options, {low, high, tables, tables + std::ptrdiff_t{2} * lanes}, rows);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
