// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/census_cost.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

#include "stages/pixels/census_window.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/census_cost.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Narrow = hn::CappedTag<std::uint8_t, kCostStep>;
using Wide = hn::CappedTag<std::uint8_t, 2 * kCostStep>;

/// Whether each pixel's costs fill whole wide vectors.
bool is_wide(int lanes) {
  const int wide = static_cast<int>(hn::MaxLanes(Wide()));
  return wide > static_cast<int>(hn::MaxLanes(Narrow())) && lanes % wide == 0;
}

/// Whether the bits of the row that leaves the window are counted again instead of being stored.
/// This is cheaper where counting is one instruction and vectors are short, and needs less of the
/// cache.
#if HWY_TARGET == HWY_NEON
constexpr bool kCountTwice = true;
#else
constexpr bool kCountTwice = false;
#endif

/// Counts the differing bits of one left pixel and its right pixels at all disparities. kBytes: 3
/// or 4 planes.
template <int kBytes, class D8>
class Difference {
 public:
  /// In the mirrored row, the right pixel of column x at disparity d is width - 1 - x + d.
  Difference(const CensusRow& row, int width, int x)
      : bits0_(hn::Set(D8(), row.left[0][x])),
        bits1_(hn::Set(D8(), row.left[1][x])),
        bits2_(hn::Set(D8(), row.left[2][x])),
        bits3_(hn::Set(D8(), row.left[3][x])),
        right0_(row.right[0] + (width - 1 - x)),
        right1_(row.right[1] + (width - 1 - x)),
        right2_(row.right[2] + (width - 1 - x)),
        right3_(row.right[3] + (width - 1 - x)) {}

  HWY_INLINE hn::Vec<D8> count(int d) const {
    const D8 d8;
    const auto count0 = hn::PopulationCount(hn::Xor(bits0_, hn::LoadU(d8, right0_ + d)));
    const auto count1 = hn::PopulationCount(hn::Xor(bits1_, hn::LoadU(d8, right1_ + d)));
    const auto count2 = hn::PopulationCount(hn::Xor(bits2_, hn::LoadU(d8, right2_ + d)));
    const auto sum = hn::Add(hn::Add(count0, count1), count2);
    if constexpr (kBytes == 3) return sum;
    return hn::Add(sum, hn::PopulationCount(hn::Xor(bits3_, hn::LoadU(d8, right3_ + d))));
  }

 private:
  hn::Vec<D8> bits0_, bits1_, bits2_, bits3_;
  const std::uint8_t* right0_;
  const std::uint8_t* right1_;
  const std::uint8_t* right2_;
  const std::uint8_t* right3_;
};

/// Advances the sums of column x by one row.
template <int kBytes, class D8>
HWY_INLINE void move_sums(const CensusWindow& window, int x) {
  const D8 d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * window.lanes;
  std::uint8_t* sums = window.sums + first;
  const Difference<kBytes, D8> in(window.in, window.width, x);
  if (kCountTwice) {
    const Difference<kBytes, D8> out(window.out, window.width, x);
    for (int d = 0; d < window.lanes; d += step) {
      const auto sum = hn::Sub(hn::Load(d8, sums + d), out.count(d));
      hn::Store(hn::Add(sum, in.count(d)), d8, sums + d);
    }
    return;
  }
  std::uint8_t* kept = window.kept + first;
  for (int d = 0; d < window.lanes; d += step) {
    const auto count = in.count(d);
    const auto sum = hn::Sub(hn::Load(d8, sums + d), hn::Load(d8, kept + d));
    hn::Store(hn::Add(sum, count), d8, sums + d);
    hn::Store(count, d8, kept + d);
  }
}

/// Resets the sums to those of a window without rows.
void clear_sums(const CensusWindow& window, int rows) {
  const std::size_t cells = static_cast<std::size_t>(window.width) * window.lanes;
  std::memset(window.sums, 0, cells);
  if (!kCountTwice) std::memset(window.kept, 0, cells * rows);
}

/// Adds one of the window's first rows; no row leaves the window yet.
void add_row(const CensusWindow& window) {
  for (int x = 0; x < window.width; ++x) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * window.lanes;
    const Narrow d8;
    const Difference<kCensusBytes, Narrow> in(window.in, window.width, x);
    for (int d = 0; d < window.lanes; d += static_cast<int>(hn::Lanes(d8))) {
      const auto count = in.count(d);
      std::uint8_t* sums = window.sums + first + d;
      hn::Store(hn::Add(hn::Load(d8, sums), count), d8, sums);
      if (!kCountTwice) hn::Store(count, d8, window.kept + first + d);
    }
  }
}

/// The binomially weighted mean of 1, 3 or 5 cells along the row; `offsets` are those of the outer
/// cells from the middle one.
template <int kSize, class D8>
HWY_INLINE hn::Vec<D8> mean_along_row(D8 d8, const std::uint8_t* sums,
                                      const std::ptrdiff_t* offsets) {
  const auto middle = hn::Load(d8, sums);
  if (kSize == 1) return middle;
  const auto near =
      hn::AverageRound(hn::Load(d8, sums + offsets[1]), hn::Load(d8, sums + offsets[2]));
  if (kSize == 3) return hn::AverageRound(near, middle);
  // Weights 1 4 6 4 1, in sixteenths.
  const auto far =
      hn::AverageRound(hn::Load(d8, sums + offsets[0]), hn::Load(d8, sums + offsets[3]));
  const auto rest = hn::AverageRound(middle, hn::AverageRound(far, middle));
  return hn::AverageRound(near, rest);
}

/// Writes the costs of column x, where the disparities low .. high are expected.
template <int kSize, class D8>
HWY_INLINE void write_costs(const CensusWindow& window, int disparities, int x, int low, int high,
                            const CensusTables& tables, std::uint8_t* costs) {
  const D8 d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  const int last = window.width - 1;
  const std::ptrdiff_t lanes = window.lanes;
  const std::ptrdiff_t offsets[4] = {
      (std::max(x - 2, 0) - x) * lanes, (std::max(x - 1, 0) - x) * lanes,
      (std::min(x + 1, last) - x) * lanes, (std::min(x + 2, last) - x) * lanes};
  const std::uint8_t* sums = window.sums + x * lanes;
  std::uint8_t* out = costs + x * lanes;
  const auto mean = [&](int d) { return mean_along_row<kSize>(d8, sums + d, offsets); };
  if (low > high || (low == 0 && high == disparities - 1)) {
    for (int d = 0; d < lanes; d += step) {
      hn::Store(hn::Max(mean(d), hn::Load(d8, tables.never + d)), d8, out + d);
    }
    return;
  }
  // Views into tables of two halves, shifted such that disparities below `low` and above `high` get
  // the penalty.
  const std::uint8_t* below = tables.below + lanes - low;
  const std::uint8_t* above = tables.above + lanes - 1 - high;
  for (int d = 0; d < lanes; d += step) {
    const auto penalty = hn::Max(hn::LoadU(d8, below + d), hn::LoadU(d8, above + d));
    const auto cost = hn::SaturatedAdd(mean(d), penalty);
    hn::Store(hn::Max(cost, hn::Load(d8, tables.never + d)), d8, out + d);
  }
}

/// Advances the sums by one row and writes its costs, column by column, while the sums of the
/// adjacent columns are in the cache.
template <int kBytes, int kSize, class D8>
void write_row_of(const CensusWindow& of_window, int disparities, const std::uint16_t* low,
                  const std::uint16_t* high, const CensusTables& of_tables, std::uint8_t* costs) {
  // Copies: the compiler knows that no store of bytes changes them.
  const CensusWindow window = of_window;
  const CensusTables tables = of_tables;
  constexpr int kReach = kSize / 2;
  const int width = window.width;
  for (int x = 0; x < std::min(kReach, width); ++x) move_sums<kBytes, D8>(window, x);
  for (int x = 0; x < width; ++x) {
    if (x + kReach < width) move_sums<kBytes, D8>(window, x + kReach);
    write_costs<kSize, D8>(window, disparities, x, low[x], high[x], tables, costs);
  }
}

void write_row(const CensusWindow& window, const CensusCostOptions& options,
               const std::uint16_t* low, const std::uint16_t* high, const CensusTables& tables,
               std::uint8_t* costs) {
  const auto by_size = [&]<int kBytes, class D8>(std::integral_constant<int, kBytes>, D8) {
    return options.kernel_size == 5   ? write_row_of<kBytes, 5, D8>
           : options.kernel_size == 3 ? write_row_of<kBytes, 3, D8>
                                      : write_row_of<kBytes, 1, D8>;
  };
  const auto by_bytes = [&](auto d8) {
    return options.bytes == 3 ? by_size(std::integral_constant<int, 3>(), d8)
                              : by_size(std::integral_constant<int, 4>(), d8);
  };
  const auto write = is_wide(window.lanes) ? by_bytes(Wide()) : by_bytes(Narrow());
  write(window, options.disparities, low, high, tables, costs);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(clear_sums);
HWY_EXPORT(add_row);
HWY_EXPORT(write_row);

namespace {

/// The number of rows whose planes are stored: those of the window, and the one that enters it.
int rows_apart(const CensusCostOptions& options) { return options.kernel_size + 1; }

int wrapped(int i, int count) { return (i % count + count) % count; }

/// The planes of row y, which may be outside of the image.
CensusRow place_of(int y, int width, const CensusCostOptions& options, CensusCostScratch& scratch) {
  const int right_width = width + cost_lanes(options.disparities);
  std::uint8_t* bytes =
      scratch.planes.data() + static_cast<std::ptrdiff_t>(wrapped(y, rows_apart(options))) *
                                  kCensusBytes * (width + right_width);
  CensusRow row{};
  for (std::uint8_t*& plane : row.left) plane = std::exchange(bytes, bytes + width);
  for (std::uint8_t*& plane : row.right) plane = std::exchange(bytes, bytes + right_width);
  return row;
}

/// Prepares row y to enter the window. Rows outside of the image repeat the border's row.
CensusWindow window_with(const CensusImage& left, const CensusImage& right,
                         const CensusCostOptions& options, int y, CensusCostScratch& scratch) {
  const int width = left.bits.width();
  const int lanes = cost_lanes(options.disparities);
  const int inside = std::clamp(y, 0, left.bits.height() - 1);
  const CensusRow in = place_of(y, width, options, scratch);
  split_census_row(left.bits.row(inside), width, RowOrder::kForward, 0, in.left);
  split_census_row(right.bits.row(inside), width, RowOrder::kMirrored, lanes, in.right);
  const std::ptrdiff_t kept =
      static_cast<std::ptrdiff_t>(wrapped(y, options.kernel_size)) * width * lanes;
  return {width,
          lanes,
          in,
          place_of(y - options.kernel_size, width, options, scratch),
          scratch.kept.data() + kept,
          scratch.sums.data()};
}

}  // namespace

void CensusCostScratch::resize(int width, const CensusCostOptions& options) {
  const std::size_t lanes = cost_lanes(options.disparities);
  planes.resize(kCensusBytes * (2 * width + lanes) * rows_apart(options));
  std::memset(planes.data(), 0, planes.size());
  kept.resize(width * lanes * options.kernel_size);
  sums.resize(width * lanes);
  tables.resize(5 * lanes);
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
                        const CensusCostOptions& options, int y, CensusCostScratch& scratch) {
  const int reach = options.kernel_size / 2;
  const int width = left.bits.width();
  const int lanes = cost_lanes(options.disparities);
  HWY_DYNAMIC_DISPATCH(clear_sums)
  ({width, lanes, {}, {}, scratch.kept.data(), scratch.sums.data()}, options.kernel_size);
  // The first row that leaves the window precedes all others. Its planes are equal in both views,
  // so that its costs are 0.
  const CensusRow none = place_of(y - reach - 1, width, options, scratch);
  std::memset(none.left[0], 0, kCensusBytes * (2 * width + lanes));
  for (int i = -reach; i < reach; ++i) {
    HWY_DYNAMIC_DISPATCH(add_row)(window_with(left, right, options, y + i, scratch));
  }
}

void census_cost_row(const CensusImage& left, const CensusImage& right,
                     const CensusCostOptions& options, int y, const std::uint16_t* low,
                     const std::uint16_t* high, CensusCostScratch& scratch, std::uint8_t* costs) {
  const std::size_t lanes = cost_lanes(options.disparities);
  const std::uint8_t* tables = scratch.tables.data();
  HWY_DYNAMIC_DISPATCH(write_row)
  (window_with(left, right, options, y + options.kernel_size / 2, scratch), options, low, high,
   {tables, tables + 2 * lanes, tables + 4 * lanes}, costs);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
