// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/scanline_optimization.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <type_traits>
#include <utility>

#include "stages/pixels/census_cost.hpp"
#include "stages/pixels/scanline_ends.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/scanline_optimization.cpp"
#include "base/simd.hpp"
#include "stages/pixels/path_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// The state of one path along the row: the costs of its last pixel and the inputs of the next
/// step.
class Path {
 public:
  Path(const ScanlineRow& row, int lanes, int path, ScanlineScratch& scratch)
      : costs_(row.costs),
        gray_(row.gray),
        large_step_(row.large_step->data()),
        windows_(row.windows),
        width_(row.width),
        lanes_(lanes),
        back_(path == kFromLeft ? -1 : 1),
        small_step_(hn::Set(Bytes(), static_cast<std::uint8_t>(std::min(row.small_step, 255)))),
        least_(hn::Set(Bytes(), static_cast<std::uint8_t>(scratch.least[path]))),
        newest_(path_end(scratch.ends.data(), lanes, path, scratch.newest[path])),
        other_(path_end(scratch.ends.data(), lanes, path, 1 - scratch.newest[path])) {}

  /// Starts at the path's first pixel, which has no predecessor.
  void begin() {
    std::memset(newest_, 0, lanes_);
    least_ = hn::Zero(Bytes());
  }

  /// Enters the tile of column x, the next one.
  HWY_INLINE void enter(int x) {
    window_ = window_at(windows_, lanes_, x);
    const int last = x + back_;
    if (last < 0 || last >= width_) return;
    extend_lanes(window_at(windows_, lanes_, last), window_, newest_);
  }

  /// The number of the window's vectors.
  int vectors() const { return vectors_of(Bytes(), window_); }

  /// Advances to column x, the next one.
  template <int kVectors>
  HWY_INLINE void step(int x) {
    const Bytes d8;
    const int last = x + back_;
    const bool first = last < 0 || last >= width_;
    const int change = first ? 0 : std::abs(gray_[x] - gray_[last]);
    const StepCosts steps = {small_step_, least_,
                             hn::SaturatedAdd(least_, hn::Set(d8, large_step_[change]))};
    const std::uint8_t* costs = costs_ + static_cast<std::ptrdiff_t>(x) * lanes_;
    if constexpr (kVectors > 0) {
      least_ = step_vectors<kVectors>(window_, costs, newest_, steps, other_);
    } else {
      least_ = step_window(window_, costs, newest_, steps, other_);
    }
    std::swap(newest_, other_);
  }

  /// Stores the last pixel's costs for the other path.
  template <int kVectors>
  HWY_INLINE void keep(std::uint8_t* paths, int x) const {
    std::uint8_t* kept = paths + static_cast<std::ptrdiff_t>(x) * lanes_;
    const Bytes d8;
    const int end = last_lane<kVectors>();
    for (int d = window_.begin; d < end; d += static_cast<int>(hn::MaxLanes(d8))) {
      hn::StoreU(hn::LoadU(d8, newest_ + d), d8, kept + d);
    }
  }

  /// Writes the last pixel's costs plus the costs that the other path has stored for it.
  template <int kVectors>
  HWY_INLINE void add(const std::uint8_t* paths, int x, std::uint16_t* sums) const {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * lanes_;
    const int end = last_lane<kVectors>();
    for (int d = window_.begin; d < end; d += static_cast<int>(hn::Lanes(Sums()))) {
      hn::StoreU(sum(paths + first, d), Sums(), sums + d);
    }
  }

  /// The same with the paths along the columns: half the sums of all four.
  template <int kVectors>
  HWY_INLINE void add_columns(const std::uint8_t* paths, const ColumnCosts& columns, int x,
                              std::uint16_t* sums) const {
    const hn::Rebind<std::uint8_t, Sums> d8;
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(x) * lanes_;
    const int end = last_lane<kVectors>();
    for (int d = window_.begin; d < end; d += static_cast<int>(hn::Lanes(Sums()))) {
      const auto above = hn::PromoteTo(Sums(), hn::LoadU(d8, columns.from_above + first + d));
      const auto below = hn::PromoteTo(Sums(), hn::LoadU(d8, columns.from_below + first + d));
      const auto all = hn::Add(sum(paths + first, d), hn::Add(above, below));
      hn::StoreU(hn::ShiftRight<1>(all), Sums(), sums + d);
    }
  }

  /// Saves the state for the next block.
  void leave(int path, ScanlineScratch& scratch) const {
    scratch.least[path] = hn::GetLane(least_);
    scratch.newest[path] = newest_ == path_end(scratch.ends.data(), lanes_, path, 0) ? 0 : 1;
  }

 private:
  /// The end of the window, in a form that compilers unroll loops by.
  template <int kVectors>
  HWY_INLINE int last_lane() const {
    return kVectors > 0 ? window_.begin + kVectors * static_cast<int>(hn::MaxLanes(Bytes()))
                        : window_.end;
  }

  using Sums = hn::CappedTag<std::uint16_t, kCostStep>;

  HWY_INLINE hn::Vec<Sums> sum(const std::uint8_t* kept, int d) const {
    const hn::Rebind<std::uint8_t, Sums> d8;
    return hn::Add(hn::PromoteTo(Sums(), hn::LoadU(d8, newest_ + d)),
                   hn::PromoteTo(Sums(), hn::LoadU(d8, kept + d)));
  }

  const std::uint8_t* costs_;
  const std::uint8_t* gray_;
  const std::uint8_t* large_step_;
  const CostWindow* windows_;
  int width_;
  int lanes_;
  int back_;  // offset from a column to the path's previous one
  hn::Vec<Bytes> small_step_;
  hn::Vec<Bytes> least_;  // of the last pixel's costs, in every lane
  std::uint8_t* newest_;
  std::uint8_t* other_;
  CostWindow window_{};  // of the last pixel
};

/// The number of vectors of both paths' windows, or 0 if they differ.
int common_vectors(const Path& from_left, const Path& from_right) {
  return from_left.vectors() == from_right.vectors() ? from_left.vectors() : 0;
}

/// The columns of a tile from x on, and back from x.
int steps_right(int x) { return kWindowTile - x % kWindowTile; }
int steps_left(int x) { return x % kWindowTile + 1; }

/// Each step of a path depends on the previous one, but the two paths are independent. So their
/// steps alternate.
void walk_to_middle(const ScanlineRow& row, ScanlineScratch& scratch) {
  const int lanes = cost_lanes(row.disparities);
  const int middle = row.width / 2;
  Path from_left(row, lanes, kFromLeft, scratch);
  Path from_right(row, lanes, kFromRight, scratch);
  from_left.begin();
  from_right.begin();
  std::uint8_t* paths = scratch.paths.data();
  const auto mirrored = [&](int i) { return row.width - 1 - i; };
  for (int begin = 0, end = 0; begin < middle; begin = end) {
    end = std::min({begin + steps_right(begin), begin + steps_left(mirrored(begin)), middle});
    from_left.enter(begin);
    from_right.enter(mirrored(begin));
    const auto steps = [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
      for (int i = begin; i < end; ++i) {
        from_left.step<kVectors>(i);
        from_left.keep<kVectors>(paths, i);
        from_right.step<kVectors>(mirrored(i));
        from_right.keep<kVectors>(paths, mirrored(i));
      }
    };
    with_vectors(common_vectors(from_left, from_right), steps);
  }
  if (row.width % 2 != 0) {
    from_right.enter(middle);
    from_right.step<0>(middle);
    from_right.keep<0>(paths, middle);
  }
  from_left.leave(kFromLeft, scratch);
  from_right.leave(kFromRight, scratch);
}

/// Advances both paths over their blocks: the left one over left_begin .. left_end - 1, the right
/// one backwards from right_end - 1 to right_begin. `add` writes the sums of a path's column.
template <class Add>
HWY_INLINE void walk(const ScanlineRow& row, int left_begin, int left_end, int right_begin,
                     int right_end, const Add& add, ScanlineScratch& scratch) {
  const int lanes = cost_lanes(row.disparities);
  Path from_left(row, lanes, kFromLeft, scratch);
  Path from_right(row, lanes, kFromRight, scratch);
  std::uint16_t* left_sums = scratch.sums.data();
  std::uint16_t* right_sums = left_sums + kScanlineBlock * lanes;
  const auto step_left = [&]<int kVectors>(std::integral_constant<int, kVectors>, int x) HWY_ATTR {
    from_left.step<kVectors>(x);
    add(std::integral_constant<int, kVectors>(), from_left, x,
        left_sums + (x - left_begin) * lanes);
  };
  const auto step_right = [&]<int kVectors>(std::integral_constant<int, kVectors>, int x) HWY_ATTR {
    from_right.step<kVectors>(x);
    add(std::integral_constant<int, kVectors>(), from_right, x,
        right_sums + (x - right_begin) * lanes);
  };
  int left = left_begin, right = right_end - 1;
  while (left < left_end && right >= right_begin) {
    const int steps =
        std::min({steps_right(left), left_end - left, steps_left(right), right + 1 - right_begin});
    from_left.enter(left);
    from_right.enter(right);
    with_vectors(common_vectors(from_left, from_right), [&](auto vectors) HWY_ATTR {
      for (int i = 0; i < steps; ++i) {
        step_left(vectors, left++);
        step_right(vectors, right--);
      }
    });
  }
  for (; left < left_end; ++left) {
    from_left.enter(left);
    step_left(std::integral_constant<int, 0>(), left);
  }
  for (; right >= right_begin; --right) {
    from_right.enter(right);
    step_right(std::integral_constant<int, 0>(), right);
  }
  from_left.leave(kFromLeft, scratch);
  from_right.leave(kFromRight, scratch);
}

void walk_block(const ScanlineRow& row, int left_begin, int left_end, int right_begin,
                int right_end, ScanlineScratch& scratch) {
  const std::uint8_t* paths = scratch.paths.data();
  if (row.columns.from_above == nullptr) {
    const auto add = [&]<int kVectors>(std::integral_constant<int, kVectors>, const Path& path,
                                       int x, std::uint16_t* sums)
                         HWY_ATTR { path.add<kVectors>(paths, x, sums); };
    walk(row, left_begin, left_end, right_begin, right_end, add, scratch);
  } else {
    const auto add = [&]<int kVectors>(std::integral_constant<int, kVectors>, const Path& path,
                                       int x, std::uint16_t* sums)
                         HWY_ATTR { path.add_columns<kVectors>(paths, row.columns, x, sums); };
    walk(row, left_begin, left_end, right_begin, right_end, add, scratch);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(walk_to_middle);
HWY_EXPORT(walk_block);

LargeStepTable large_step_table(const SmoothnessOptions& options) {
  LargeStepTable table{};
  for (int change = 0; change < 256; ++change) {
    const int cost = std::max(options.large_step * 8 / (8 + change), options.small_step);
    table[change] = static_cast<std::uint8_t>(std::min(options.large_step == 0 ? 0 : cost, 255));
  }
  return table;
}

void ScanlineScratch::resize(int width, int disparities) {
  const std::size_t lanes = cost_lanes(disparities);
  paths.resize(width * lanes);
  sums.resize(2 * kScanlineBlock * lanes);
  ends.resize(4 * lanes);
}

int scanline_blocks(int width) { return (width - width / 2 + kScanlineBlock - 1) / kScanlineBlock; }

void start_scanline(const ScanlineRow& row, ScanlineScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(walk_to_middle)(row, scratch);
}

std::array<ScanlineSums, 2> scanline_block(const ScanlineRow& row, int block,
                                           ScanlineScratch& scratch) {
  const int middle = row.width / 2;
  const int left_begin = middle + block * kScanlineBlock;
  const int left_end = std::min(left_begin + kScanlineBlock, row.width);
  const int right_end = std::max(middle - block * kScanlineBlock, 0);
  const int right_begin = std::max(right_end - kScanlineBlock, 0);
  HWY_DYNAMIC_DISPATCH(walk_block)(row, left_begin, left_end, right_begin, right_end, scratch);
  const std::uint16_t* sums = scratch.sums.data();
  return {
      ScanlineSums{left_begin, left_end, sums},
      ScanlineSums{right_begin, right_end, sums + kScanlineBlock * cost_lanes(row.disparities)}};
}

}  // namespace mtstereo
#endif  // HWY_ONCE
