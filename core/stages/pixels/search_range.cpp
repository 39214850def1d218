// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/search_range.hpp"

#include <algorithm>
#include <cstring>

#include "mtstereo/image.hpp"
#include "stages/pixels/range_block.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/search_range.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Doubles = hn::CappedTag<double, kRangeBlock>;
using Disparities = hn::Rebind<std::int32_t, Doubles>;
using Ends = hn::Rebind<std::uint16_t, Doubles>;

/// The ranges of a vector of pixels; `none` for pixels without a node. A disparity in px is exact,
/// so that the result does not depend on whether compilers fuse its product and the sums.
void write_vector(const std::int32_t* nodes, const SearchRangeOptions& options, SearchRange none,
                  std::uint16_t* low, std::uint16_t* high) {
  const Doubles df64;
  const Disparities d32;
  const Ends d16;
  const auto node = hn::LoadU(d32, nodes);
  const auto disparity = hn::Mul(hn::PromoteTo(df64, node), hn::Set(df64, 1.0 / kDisparityOne));
  const auto reach =
      hn::Max(hn::Mul(disparity, hn::Set(df64, options.range)), hn::Set(df64, kMinSearch));
  const auto first = hn::Max(hn::Sub(disparity, reach), hn::Zero(df64));
  // Adding 2^52 rounds to the nearest whole number; a result below the operand is raised by 1.
  const auto whole = hn::Set(df64, 4503599627370496.0);
  const auto rounded = hn::Sub(hn::Add(first, whole), whole);
  const auto up = hn::IfThenElseZero(hn::Lt(rounded, first), hn::Set(df64, 1.0));
  const auto lows = hn::DemoteTo(d16, hn::DemoteTo(d32, hn::Add(rounded, up)));
  const auto last = hn::DemoteTo(d32, hn::Add(disparity, reach));
  const auto highs = hn::DemoteTo(d16, hn::Min(last, hn::Set(d32, options.disparities - 1)));
  // 1 for a node, since disparities are positive, else 0.
  const auto known = hn::DemoteTo(d16, hn::Min(node, hn::Set(d32, 1)));
  const auto missing = hn::Eq(known, hn::Zero(d16));
  hn::StoreU(hn::IfThenElse(missing, hn::Set(d16, none.low), lows), d16, low);
  hn::StoreU(hn::IfThenElse(missing, hn::Set(d16, none.high), highs), d16, high);
}

/// Writes the ranges of kRangeBlock pixels, at least one of which has a node.
void write_block(const std::int32_t* nodes, const SearchRangeOptions& options, SearchRange none,
                 std::uint16_t* low, std::uint16_t* high) {
  for (int i = 0; i < kRangeBlock; i += static_cast<int>(hn::Lanes(Doubles()))) {
    write_vector(nodes + i, options, none, low + i, high + i);
  }
}

void write_row(const std::int32_t* nodes, int width, const SearchRangeOptions& options,
               SearchRange none, std::uint16_t* low, std::uint16_t* high) {
  int x = 0;
  for (; x + kRangeBlock <= width; x += kRangeBlock) {
    if (has_node(nodes + x)) {
      write_block(nodes + x, options, none, low + x, high + x);
    } else {
      std::fill_n(low + x, kRangeBlock, none.low);
      std::fill_n(high + x, kRangeBlock, none.high);
    }
  }
  if (x < width) {
    std::int32_t last_nodes[kRangeBlock] = {};
    std::uint16_t last_low[kRangeBlock], last_high[kRangeBlock];
    std::memcpy(last_nodes, nodes + x, (width - x) * sizeof(*nodes));
    write_block(last_nodes, options, none, last_low, last_high);
    std::copy_n(last_low, width - x, low + x);
    std::copy_n(last_high, width - x, high + x);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(write_row);

void find_search_ranges(const std::int32_t* nodes, int width, const SearchRangeOptions& options,
                        std::uint16_t* low, std::uint16_t* high) {
  HWY_DYNAMIC_DISPATCH(write_row)(nodes, width, options, SearchRange{1, 0}, low, high);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
