// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/disparity_selection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mtstereo/image.hpp"
#include "stages/pixels/census_cost.hpp"
#include "stages/pixels/subpixel.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/disparity_selection.cpp"
#include "base/simd.hpp"
#include "stages/pixels/selection_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

constexpr int kGroup = SelectionScratch::kGroup;

using Words = hn::CappedTag<std::int16_t, kWindowStep>;
using WordsVector = hn::Vec<Words>;

/// The words of the disparities d, d + 1 ... of a pixel; kNone from `count` on.
template <bool kAtBorder>
HWY_INLINE WordsVector load_words(const std::uint16_t* costs, const std::int16_t* index, int d,
                                  int count) {
  const Words d16;
  const hn::RebindToUnsigned<Words> du16;
  const auto cost = hn::BitCast(d16, hn::LoadU(du16, costs + d));
  const auto words = hn::Add(hn::ShiftLeft<kDisparityBits>(cost), hn::LoadU(d16, index + d));
  if (!kAtBorder) return words;
  const auto place = hn::Add(hn::Iota(d16, 0), hn::Set(d16, static_cast<std::int16_t>(d)));
  const auto exists = hn::Lt(place, hn::Set(d16, static_cast<std::int16_t>(count)));
  return hn::IfThenElse(exists, words, hn::Set(d16, kNone));
}

/// Per lane the least and the second-least word of the disparities lane, lane + lanes, lane + 2
/// lanes ... of a group.
struct Leasts {
  WordsVector least;
  WordsVector second;
};

/// Finds the least words of the disparities d0 .. d1 - 1. Each word also replaces the least word of
/// its right pixel, at right[d], if it is less.
template <bool kAtBorder>
HWY_INLINE Leasts compete(const std::uint16_t* costs, const std::int16_t* index, int d0, int d1,
                          int count, std::int16_t* right) {
  const Words d16;
  Leasts leasts = {hn::Set(d16, kNone), hn::Set(d16, kNone)};
  for (int d = d0; d < d1; d += static_cast<int>(hn::Lanes(d16))) {
    const auto words = load_words<kAtBorder>(costs, index, d, count);
    std::int16_t* shown = right + d;
    hn::StoreU(hn::Min(words, hn::LoadU(d16, shown)), d16, shown);
    leasts.second = hn::Min(leasts.second, hn::Max(leasts.least, words));
    leasts.least = hn::Min(leasts.least, words);
  }
  return leasts;
}

/// The cost in each word; kNone for kNone.
template <class D16>
HWY_INLINE hn::Vec<D16> costs_of(D16 d16, hn::Vec<D16> words) {
  const hn::RebindToUnsigned<D16> du16;
  const auto lowest = hn::Set(du16, std::uint16_t{1} << 15);
  const auto costs = hn::ShiftRight<kDisparityBits>(hn::Xor(hn::BitCast(du16, words), lowest));
  const auto none = hn::Set(d16, kNone);
  return hn::IfThenElse(hn::Eq(words, none), none, hn::BitCast(d16, costs));
}

constexpr int kLanes = static_cast<int>(hn::MaxLanes(Words()));

/// Pixels whose words are reduced together.
constexpr int kBatch = 8;

/// The words of a batch: one per lane for each pixel.
using BatchWords = std::int16_t[kBatch][kLanes];

/// Reduces the words of one pixel to eight.
using Eight = hn::CappedTag<std::int16_t, kBatch>;
HWY_INLINE hn::Vec<Eight> least_eight(const std::int16_t* words) {
  const Eight d8;
  auto least = hn::Load(d8, words);
  for (int i = kBatch; i < kLanes; i += kBatch) least = hn::Min(least, hn::Load(d8, words + i));
  return least;
}

/// Halves the number of words per pixel: interleaves the lanes of `a` and `b`, and takes the lesser
/// of the lower and upper halves.
template <class V>
HWY_INLINE V fold(V a, V b) {
  const Eight d8;
  return hn::Min(hn::InterleaveLower(d8, a, b), hn::InterleaveUpper(d8, a, b));
}

/// The least word of each pixel of a batch, in the order of the pixels.
HWY_INLINE hn::Vec<Eight> least_words(const BatchWords& words) {
  const auto even = fold(fold(least_eight(words[0]), least_eight(words[4])),
                         fold(least_eight(words[2]), least_eight(words[6])));
  const auto odd = fold(fold(least_eight(words[1]), least_eight(words[5])),
                        fold(least_eight(words[3]), least_eight(words[7])));
  return fold(even, odd);
}

/// The least and the second-least words of a batch in one group of disparities, per lane.
struct BatchGroup {
  BatchWords least;
  BatchWords second;
};

/// The costs of a batch of pixels from column x on. The last batch of a range may have fewer
/// pixels.
struct Batch {
  const std::uint16_t* costs;
  int x;
  int pixels;
  int lanes;
  int disparities;
  int width;
  const CostWindow* windows;  // of the row's tiles
};

template <bool kAtBorder>
HWY_INLINE void compete_in_group(const Batch& batch, int group, SelectionScratch& scratch,
                                 BatchGroup& out) {
  const Words d16;
  const int d0 = group * kGroup;
  const int groups = (batch.lanes + kGroup - 1) / kGroup;
  // Copies: the compiler knows that no store of words changes them.
  const std::ptrdiff_t stride = scratch.right_stride;
  std::int16_t* const first = scratch.right.data();
  const std::int16_t* const index = scratch.index.data();
  for (int i = 0; i < batch.pixels; ++i) {
    const int x = batch.x + i;
    const std::ptrdiff_t competition = (x % SelectionScratch::kTurns * groups + group) * stride;
    std::int16_t* right = first + competition + (batch.width - 1 - x);
    const int count = std::min(batch.disparities, x + 1);  // disparities with a right pixel
    const CostWindow window = window_at(batch.windows, batch.lanes, x);
    const Leasts leasts =
        compete<kAtBorder>(batch.costs + i * batch.lanes, index, std::max<int>(window.begin, d0),
                           std::min<int>(window.end, d0 + kGroup), count, right);
    hn::Store(leasts.least, d16, out.least[i]);
    hn::Store(leasts.second, d16, out.second[i]);
  }
}

/// The least costs of disparities that differ from the batch's best ones by more than 1. `best` is
/// relative to the group's first disparity. Adjacent lanes hold adjacent disparities, so at most
/// one word of each lane is excluded, and then the lane's second-least word takes its place.
HWY_INLINE hn::Vec<Eight> runners_up(const std::int16_t* best, BatchGroup& group) {
  const Words d16;
  for (int i = 0; i < kBatch; ++i) {
    const auto least = hn::Load(d16, group.least[i]);
    // best - 1 .. best + 1 become 0 .. 2.
    const auto before = hn::Set(d16, static_cast<std::int16_t>(best[i] - 1));
    const auto disparity = hn::And(least, hn::Set(d16, kGroup - 1));
    const auto offset = hn::Sub(disparity, before);
    const auto beside = hn::And(hn::Gt(offset, hn::Set(d16, -1)), hn::Lt(offset, hn::Set(d16, 3)));
    hn::Store(hn::IfThenElse(beside, hn::Load(d16, group.second[i]), least), d16, group.least[i]);
  }
  return costs_of(Eight(), least_words(group.least));
}

/// Writes one value for each pixel of a batch and leaves the elements after the batch unchanged.
template <class V>
HWY_INLINE void write_batch(V values, const Batch& batch, Buffer<std::int16_t>& row) {
  const Eight d8;
  if (batch.pixels == kBatch) {
    hn::StoreU(values, d8, row.data() + batch.x);
    return;
  }
  HWY_ALIGN std::int16_t all[kBatch];
  hn::Store(values, d8, all);
  std::copy_n(all, batch.pixels, row.data() + batch.x);
}

template <bool kAtBorder>
HWY_INLINE void offer_batch(const Batch& batch, SelectionScratch& scratch) {
  const Eight d8;
  HWY_ALIGN BatchGroup groups[kMostGroups];
  const int count = (batch.lanes + kGroup - 1) / kGroup;
  auto least = hn::Set(d8, kNone);
  auto best = hn::Zero(d8);
  for (int g = 0; g < count; ++g) {
    compete_in_group<kAtBorder>(batch, g, scratch, groups[g]);
    const auto words = least_words(groups[g].least);
    const auto costs = costs_of(d8, words);
    const auto disparities = hn::Add(hn::And(words, hn::Set(d8, kGroup - 1)),
                                     hn::Set(d8, static_cast<std::int16_t>(g * kGroup)));
    best = hn::IfThenElse(hn::Lt(costs, least), disparities, best);
    least = hn::Min(least, costs);
  }
  auto second = hn::Set(d8, kNone);
  for (int g = 0; g < count; ++g) {
    HWY_ALIGN std::int16_t in_group[kBatch];
    hn::Store(hn::Sub(best, hn::Set(d8, static_cast<std::int16_t>(g * kGroup))), d8, in_group);
    second = hn::Min(second, runners_up(in_group, groups[g]));
  }
  write_batch(best, batch, scratch.best);
  write_batch(least, batch, scratch.least);
  write_batch(second, batch, scratch.second);
}

void offer(const std::uint16_t* costs, int begin, int end, int width, int disparities,
           const CostWindow* windows, SelectionScratch& scratch) {
  const int lanes = cost_lanes(disparities);
  for (int x = begin; x < end; x += kBatch, costs += kBatch * lanes) {
    const Batch batch = {costs, x, std::min(kBatch, end - x), lanes, disparities, width, windows};
    if (x + 1 < disparities) {
      offer_batch<true>(batch, scratch);
    } else {
      offer_batch<false>(batch, scratch);
    }
  }
}

/// Finds the disparity of each right pixel's least word. Overwrites the words of the first turn and
/// group with it.
void decide_right(int width, int groups, SelectionScratch& scratch) {
  const Words d16;
  const std::ptrdiff_t turn = scratch.right_stride * groups;
  std::int16_t* first = scratch.right.data();
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    auto least = hn::Set(d16, kNone);  // costs
    auto best = hn::Zero(d16);         // disparities
    for (int g = 0; g < groups; ++g) {
      const std::int16_t* competition = first + g * scratch.right_stride + x;
      auto word = hn::LoadU(d16, competition);
      for (int t = 1; t < SelectionScratch::kTurns; ++t) {
        word = hn::Min(word, hn::LoadU(d16, competition + t * turn));
      }
      const auto cost = costs_of(d16, word);
      const auto disparity = hn::Add(hn::And(word, hn::Set(d16, kGroup - 1)),
                                     hn::Set(d16, static_cast<std::int16_t>(g * kGroup)));
      best = hn::IfThenElse(hn::Lt(cost, least), disparity, best);
      least = hn::Min(least, cost);
    }
    hn::StoreU(best, d16, first + x);
  }
}

void finish(int width, const SelectionOptions& options, const std::uint16_t* low,
            const std::uint16_t* high, const SelectionScratch& scratch, std::int32_t* disparity,
            std::uint8_t* ratio) {
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Finished()));
  for (int x = 0; x + kLanes <= width; x += kLanes) {
    finish_at(x, options, low, high, scratch, disparity, ratio);
  }
  // The last vector ends with the row. It may repeat some pixels.
  if (width % kLanes != 0) {
    finish_at(width - kLanes, options, low, high, scratch, disparity, ratio);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(offer);
HWY_EXPORT(decide_right);
HWY_EXPORT(finish);

namespace {

int groups_of(int disparities) {
  return (cost_lanes(disparities) + SelectionScratch::kGroup - 1) / SelectionScratch::kGroup;
}

/// The least cost of the disparities first .. last that are not within 1 of `best`, or kNone.
int runner_up_of_range(const std::uint16_t* costs, int best, int first, int last) {
  int least = SelectionScratch::kNone;
  for (int d = first; d <= last; ++d) {
    if (std::abs(d - best) > 1) least = std::min<int>(least, costs[d]);
  }
  return least;
}

}  // namespace

RunnerUpTable runner_up_table(double confidence) {
  RunnerUpTable table{};
  for (int cost = 0; cost < kCostLimit; ++cost) {
    table[cost] = static_cast<std::uint16_t>(std::floor(cost * (1 + confidence)) + 1);
  }
  return table;
}

void SelectionScratch::resize(int width, int disparities) {
  constexpr int kVector = kAlignment / sizeof(std::uint16_t);
  const int lanes = cost_lanes(disparities);
  index.resize(lanes);
  for (int d = 0; d < lanes; ++d) {
    // Cells from D on have the highest cost, which this turns into kNone.
    const int word = d < disparities ? kLowestWord + d % kGroup : kNone - kMostCost;
    index[d] = static_cast<std::int16_t>(word);
  }
  // Pixels offer all their lanes, including those past the end of the row.
  right_stride = (width + lanes + 2 * kVector - 1) / kVector * kVector;
  right.resize(right_stride * groups_of(disparities) * kTurns);
  const int padded = std::max(width, kFinishedTogether);
  for (Buffer<std::int16_t>* row : {&best, &least, &second, &before, &after, &other}) {
    row->resize(padded);
    // The pixels after the end are finished as well.
    std::fill_n(row->data() + width, padded - width, std::int16_t{0});
  }
  sufficient.resize(padded);
  std::fill_n(sufficient.data() + width, padded - width, std::uint16_t{0});
}

void start_selection(SelectionScratch& scratch) {
  std::fill_n(scratch.right.data(), scratch.right.size(), SelectionScratch::kNone);
}

void offer_costs(const std::uint16_t* costs, int begin, int end, int width,
                 const SelectionOptions& options, const std::uint16_t* low,
                 const std::uint16_t* high, const CostWindow* windows, SelectionScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(offer)(costs, begin, end, width, options.disparities, windows, scratch);
  const int lanes = cost_lanes(options.disparities);
  for (int x = begin; x < end; ++x, costs += lanes) {
    const int best = scratch.best[x];
    const CostWindow window = window_at(windows, lanes, x);
    const int first = window.begin;
    const int last = std::min<int>(std::min(options.disparities, x + 1), window.end) - 1;
    const bool inside = best > first && best < last;
    scratch.before[x] =
        inside ? static_cast<std::int16_t>(costs[best - 1]) : SelectionScratch::kNone;
    scratch.after[x] =
        inside ? static_cast<std::int16_t>(costs[best + 1]) : SelectionScratch::kNone;
    if (options.runner_up_in_range) {
      scratch.second[x] = static_cast<std::int16_t>(runner_up_of_range(
          costs, best, std::max<int>(low[x], first), std::min<int>(high[x], last)));
    }
  }
}

void finish_selection(int width, const SelectionOptions& options, const std::uint16_t* low,
                      const std::uint16_t* high, const RunnerUpTable& runner_up,
                      SelectionScratch& scratch, std::int32_t* disparity, std::uint8_t* ratio) {
  const int tolerance = options.left_right_tolerance;
  if (tolerance >= 0) {
    HWY_DYNAMIC_DISPATCH(decide_right)(width, groups_of(options.disparities), scratch);
  }
  for (int x = 0; x < width; ++x) {
    const int best = scratch.best[x];
    const int least = scratch.least[x];
    // Costs without a disparity have no runner-up.
    scratch.sufficient[x] = runner_up[std::min(least, kCostLimit - 1)];
    scratch.other[x] = scratch.right[width - 1 - x + best];
  }
  if (width >= kFinishedTogether) {
    HWY_DYNAMIC_DISPATCH(finish)(width, options, low, high, scratch, disparity, ratio);
    return;
  }
  // Too few pixels for a vector.
  std::uint16_t padded_low[kFinishedTogether] = {}, padded_high[kFinishedTogether] = {};
  std::int32_t disparities[kFinishedTogether];
  std::uint8_t ratios[kFinishedTogether];
  std::copy_n(low, width, padded_low);
  std::copy_n(high, width, padded_high);
  HWY_DYNAMIC_DISPATCH(finish)
  (kFinishedTogether, options, padded_low, padded_high, scratch, disparities, ratios);
  std::copy_n(disparities, width, disparity);
  std::copy_n(ratios, width, ratio);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
