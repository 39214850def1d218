// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/edge_alignment.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/edge_alignment.cpp"
#include "base/simd.hpp"
#include "base/simd_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Words = hn::CappedTag<std::int16_t, kAlignment / sizeof(std::int16_t)>;
using Vec = hn::Vec<Words>;

constexpr int kSide = kEdgeSide;
constexpr std::int16_t kMostWeight = kEdgeContrast + 1;
constexpr std::int16_t kMostDisparity = 0x7FFE;
static_assert(kLargestMaxDisparity * kEdgeOne < kMostDisparity);

/// The weights of a window's pixels, for a vector of windows.
struct Weights {
  std::int16_t of[kSide][kSide][hn::MaxLanes(Words())];
};

/// The sum of the weights of the disparities below `end`.
HWY_INLINE Vec weight_below(const EdgeWindow& rows, int x, const Weights& weights, Vec end) {
  const Words d16;
  auto sum = hn::Zero(d16);
  for (int row = 0; row < kSide; ++row) {
    const std::int16_t* disparities = rows.disparity[row] + x;
    for (int i = 0; i < kSide; ++i) {
      const auto below = hn::Gt(end, hn::LoadU(d16, disparities + kEdgeStep * i));
      sum = hn::Add(sum, hn::IfThenElseZero(below, hn::Load(d16, weights.of[row][i])));
    }
  }
  return sum;
}

/// What one pass over the windows of the columns from x on finds out.
struct Weighed {
  Vec half;               ///< half of a window's weight
  Vec below;              ///< kEdgeKept less than the pixel's own disparity
  Vec above;              ///< kEdgeKept more
  Vec least;              ///< the least disparity of the window
  Vec most;               ///< the largest
  hn::Mask<Words> stays;  ///< the median is more than `below`
  hn::Mask<Words> rises;  ///< it is `above` at least
};

/// Finds the weights of the windows, and where the medians are about.
HWY_INLINE Weighed weigh(const EdgeWindow& rows, int x, Weights& weights) {
  const Words d16;
  const hn::Rebind<std::uint8_t, Words> d8;
  const auto gray = hn::PromoteTo(d16, hn::LoadU(d8, rows.middle + kEdgeRadius + x));
  const auto zero = hn::Zero(d16), one = hn::Set(d16, 1), alike = hn::Set(d16, kMostWeight);
  const auto own = hn::LoadU(d16, rows.disparity[kSide / 2] + kEdgeRadius + x);
  const auto below = hn::Sub(own, hn::Set(d16, kEdgeKept));
  const auto above = hn::Add(own, hn::Set(d16, kEdgeKept));
  auto total = one, up_to_below = zero, less_than_above = zero, least = own, most = own;
  for (int row = 0; row < kSide; ++row) {
    const std::int16_t* disparities = rows.disparity[row] + x;
    const std::uint8_t* grays = rows.gray[row] + x;
    for (int i = 0; i < kSide; ++i) {
      const auto other = hn::PromoteTo(d16, hn::LoadU(d8, grays + kEdgeStep * i));
      const auto weight = hn::Max(hn::Sub(alike, hn::Abs(hn::Sub(gray, other))), one);
      hn::Store(weight, d16, weights.of[row][i]);
      total = hn::Add(total, weight);
      const auto disparity = hn::LoadU(d16, disparities + kEdgeStep * i);
      least = hn::Min(least, disparity);
      most = hn::Max(most, disparity);
      const auto larger = hn::Gt(disparity, below);
      up_to_below = hn::Add(up_to_below, hn::IfThenZeroElse(larger, weight));
      const auto less = hn::Gt(above, disparity);
      less_than_above = hn::Add(less_than_above, hn::IfThenElseZero(less, weight));
    }
  }
  const auto half = hn::ShiftRight<1>(total);
  return {
      half, below, above, least, most, hn::Lt(up_to_below, half), hn::Lt(less_than_above, half)};
}

/// The weighted medians of the windows of the columns from x on: the least disparity such that it
/// and all below it have half the weight. For pixels that are not near a jump, or that differ from
/// their median by less than kEdgeKept, their own disparities.
Vec medians_at(const EdgeWindow& rows, const std::uint8_t* near, int x) {
  const Words d16;
  const hn::Rebind<std::uint8_t, Words> d8;
  HWY_ALIGN Weights weights;
  const auto zero = hn::Zero(d16), one = hn::Set(d16, 1);
  const auto own = hn::LoadU(d16, rows.disparity[kSide / 2] + kEdgeRadius + x);
  const Weighed w = weigh(rows, x, weights);
  const auto far = hn::Eq(hn::PromoteTo(d16, hn::LoadU(d8, near + x)), zero);
  const auto kept = hn::Or(far, hn::AndNot(w.rises, w.stays));
  if (hn::AllTrue(d16, kept)) return own;
  auto low = hn::IfThenElse(kept, own, hn::IfThenElse(w.rises, w.above, w.least));
  auto high = hn::IfThenElse(kept, own, hn::IfThenElse(w.rises, w.most, w.below));
  // Lanes after the end of the row hold any values; so neither the difference of the bounds nor
  // the next value can overflow.
  const auto most = hn::Set(d16, kMostDisparity);
  low = hn::Min(hn::Max(low, zero), most);
  high = hn::Min(hn::Max(high, low), most);
  while (!hn::AllFalse(d16, hn::Lt(low, high))) {
    const auto middle = hn::Add(low, hn::ShiftRight<1>(hn::Sub(high, low)));
    const auto next = hn::Add(middle, one);
    const auto less = hn::Lt(weight_below(rows, x, weights, next), w.half);
    low = hn::IfThenElse(less, hn::Min(next, high), low);
    high = hn::IfThenElse(less, high, middle);
  }
  return low;
}

constexpr int kLanes = static_cast<int>(hn::MaxLanes(Words()));

/// Runs body(x0, lanes) for vectors of columns that have all marked pixels of a row. Each begins at
/// a marked pixel; `lanes` has the bits of those in the row.
template <typename Body>
HWY_INLINE void for_each_marked(const std::uint8_t* marks, int width, Body&& body) {
  const auto next = [&](int x) {
    const void* mark = x < width ? std::memchr(marks + x, 1, width - x) : nullptr;
    return mark == nullptr ? width
                           : static_cast<int>(static_cast<const std::uint8_t*>(mark) - marks);
  };
  for (int x0 = next(0); x0 < width; x0 = next(x0 + kLanes)) {
    body(x0, first_bits(std::min(kLanes, width - x0)));
  }
}

/// Aligns a row; `near` marks its pixels near a jump.
void align_row(const EdgeWindow& rows, const std::uint8_t* near, int width, std::int32_t* map,
               std::uint8_t* confidence) {
  const Words d16;
  HWY_ALIGN std::int16_t medians[kLanes];
  for_each_marked(near, width, [&](int x0, std::uint64_t lanes) {
    const auto own = hn::LoadU(d16, rows.disparity[kSide / 2] + kEdgeRadius + x0);
    const auto found = medians_at(rows, near, x0);
    hn::Store(found, d16, medians);
    for (std::uint64_t bits = lanes & bits_of(d16, hn::Ne(found, own)); bits != 0;
         bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      map[x0 + i] = std::max(medians[i] * (kDisparityOne / kEdgeOne), 1);
      confidence[x0 + i] = std::min<std::uint8_t>(confidence[x0 + i], kMostInferred);
    }
  });
}

/// Doubts the matched pixels of a row that align_row() would change; `near` marks those near a
/// jump, then the matched ones of them.
void doubt_row(const EdgeWindow& rows, int width, std::uint8_t* near, std::uint8_t* confidence) {
  for (int x = 0; x < width; ++x) {
    near[x] &= static_cast<std::uint8_t>(confidence[x] > kMostInferred);
  }
  const Words d16;
  HWY_ALIGN Weights weights;
  for_each_marked(near, width, [&](int x0, std::uint64_t lanes) {
    const Weighed w = weigh(rows, x0, weights);
    const auto changed = hn::Or(w.rises, hn::Not(w.stays));
    for (std::uint64_t bits = lanes & bits_of(d16, changed); bits != 0; bits &= bits - 1) {
      const int x = x0 + std::countr_zero(bits);
      if (near[x] != 0) confidence[x] = kMostInferred;
    }
  });
}

/// The jumps of kWord columns.
struct Jumps {
  std::uint64_t any = 0;    ///< to the next column or row
  std::uint64_t right = 0;  ///< to the next column
};

/// The bits of kWord marks.
HWY_INLINE std::uint64_t marked_bits(const std::uint8_t* marks) {
  const hn::CappedTag<std::uint8_t, 32> d8;
  std::uint64_t bits = 0;
  for (int i = 0; i < kWord; i += static_cast<int>(hn::Lanes(d8))) {
    bits |= bits_of(d8, hn::Ne(hn::LoadU(d8, marks + i), hn::Zero(d8))) << i;
  }
  return bits;
}

/// The jumps of the columns from x0 on. The padding of the rows may hold some, too.
HWY_INLINE Jumps find_word_jumps(const JumpRows& rows, int x0, int width) {
  const hn::CappedTag<std::int32_t, kAlignment / sizeof(std::int32_t)> d32;
  const auto jump = hn::Set(d32, kJump);
  Jumps jumps;
  const int columns = std::min(width - x0, kWord);
  for (int i = 0; i < columns; i += static_cast<int>(hn::Lanes(d32))) {
    const auto own = hn::LoadU(d32, rows.map + x0 + i);
    const auto down = hn::Abs(hn::Sub(own, hn::LoadU(d32, rows.next + x0 + i)));
    const auto right = hn::Abs(hn::Sub(own, hn::LoadU(d32, rows.map + x0 + i + 1)));
    jumps.any |= bits_of(d32, hn::Gt(down, jump)) << i;
    jumps.right |= bits_of(d32, hn::Gt(right, jump)) << i;
  }
  if (rows.changed != nullptr) {
    const std::uint64_t own = marked_bits(rows.changed + x0);
    jumps.any &= own | marked_bits(rows.next_changed + x0);
    jumps.right &= own | marked_bits(rows.changed + x0 + 1);
  }
  jumps.right &= first_bits(width - x0 - 1);
  jumps.any = (jumps.any & first_bits(columns)) | jumps.right;
  return jumps;
}

/// Marks the columns within kEdgeReach of a jump. Accesses the padding of the rows.
void mark_row(const JumpRows& rows, int width, std::uint8_t* near) {
  const hn::CappedTag<std::uint8_t, kAlignment> d8;
  const auto one = hn::Set(d8, 1);
  Jumps before, here = find_word_jumps(rows, 0, width), after;
  for (int x0 = 0; x0 < width; x0 += kWord, before = here, here = after) {
    after = x0 + kWord < width ? find_word_jumps(rows, x0 + kWord, width) : Jumps();
    // A jump to the next column has a pixel on each side.
    std::uint64_t marked =
        here.any | here.right << (kEdgeReach + 1) | before.right >> (kWord - kEdgeReach - 1);
    for (int away = 1; away <= kEdgeReach; ++away) {
      marked |= here.any << away | before.any >> (kWord - away);
      marked |= here.any >> away | after.any << (kWord - away);
    }
    std::uint8_t bits[2 * sizeof marked] = {};  // vectors read more than their own
    std::memcpy(bits, &marked, sizeof marked);
    for (int i = 0; i < kWord; i += static_cast<int>(hn::Lanes(d8))) {
      const auto mask = hn::LoadMaskBits(d8, bits + i / 8);
      hn::StoreU(hn::IfThenElseZero(mask, one), d8, near + x0 + i);
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(align_row);
HWY_EXPORT(doubt_row);
HWY_EXPORT(mark_row);

namespace {

/// Repeats the outermost of the `width` elements at row + kEdgeRadius on both sides.
template <typename T>
void repeat_ends(T* row, int width) {
  std::fill_n(row, kEdgeRadius, row[kEdgeRadius]);
  std::fill_n(row + kEdgeRadius + width, kEdgeRadius, row[kEdgeRadius + width - 1]);
}

/// Adds the marks of another row; compilers vectorize the loop.
void add_marks(const std::uint8_t* __restrict__ row, int width, std::uint8_t* __restrict__ near) {
  for (int x = 0; x < width; ++x) near[x] |= row[x];
}

/// Adds the marks of the rows within kEdgeReach. EdgeMap may be larger than the map.
void mark_near(const EdgeMap& edges, int y, int width, int height, std::uint8_t* near) {
  std::memcpy(near, edges.near.row(y), width);
  const int last = std::min(y + kEdgeReach, height - 1);
  for (int other = std::max(y - kEdgeReach, 0); other <= last; ++other) {
    add_marks(edges.near.row(other), width, near);
  }
}

/// The windows of the pixels of row y.
EdgeWindow window_rows(const EdgeMap& edges, int y, int height) {
  EdgeWindow rows{};
  rows.middle = edges.gray.row(y);
  for (int i = 0; i < kEdgeSide; ++i) {
    const int other = std::clamp(y + kEdgeStep * i - kEdgeRadius, 0, height - 1);
    rows.disparity[i] = edges.disparity.row(other);
    rows.gray[i] = edges.gray.row(other);
  }
  return rows;
}

}  // namespace

void EdgeMap::resize(int width, int height, ReusedMemory* reused) {
  disparity.resize(width + 2 * kEdgeRadius, height, reused);
  gray.resize(width + 2 * kEdgeRadius, height, reused);
  near.resize(width, height, reused);
}

void EdgeScratch::resize(int width) { near.resize(width); }

void find_jumps(GrayView left_view, const Image<std::int32_t>& map,
                const Image<std::uint8_t>* changed, int y0, int y1, EdgeMap& edges) {
  const int width = map.width();
  for (int y = y0; y < y1; ++y) {
    const std::int32_t* row = map.row(y);
    std::int16_t* disparity = edges.disparity.row(y);
    for (int x = 0; x < width; ++x) {
      disparity[kEdgeRadius + x] = static_cast<std::int16_t>(row[x] / (kDisparityOne / kEdgeOne));
    }
    repeat_ends(disparity, width);
    std::memcpy(edges.gray.row(y) + kEdgeRadius, left_view.row(y), width);
    repeat_ends(edges.gray.row(y), width);
    const int next = std::min(y + 1, map.height() - 1);
    const auto changed_row = [&](int i) { return changed == nullptr ? nullptr : changed->row(i); };
    HWY_DYNAMIC_DISPATCH(mark_row)
    ({row, map.row(next), changed_row(y), changed_row(next)}, width, edges.near.row(y));
  }
}

void align_edges(const EdgeMap& edges, int y0, int y1, EdgeScratch& scratch,
                 Image<std::int32_t>& map, Image<std::uint8_t>& confidence) {
  const int width = map.width(), height = map.height();
  for (int y = y0; y < y1; ++y) {
    mark_near(edges, y, width, height, scratch.near.data());
    HWY_DYNAMIC_DISPATCH(align_row)
    (window_rows(edges, y, height), scratch.near.data(), width, map.row(y), confidence.row(y));
  }
}

void doubt_edges(const EdgeMap& edges, int y0, int y1, EdgeScratch& scratch,
                 Image<std::uint8_t>& confidence) {
  const int width = confidence.width(), height = confidence.height();
  for (int y = y0; y < y1; ++y) {
    mark_near(edges, y, width, height, scratch.near.data());
    HWY_DYNAMIC_DISPATCH(doubt_row)
    (window_rows(edges, y, height), width, scratch.near.data(), confidence.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
