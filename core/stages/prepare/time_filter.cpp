// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/time_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#define HWY_TARGET_INCLUDE "stages/prepare/time_filter.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Sums the differences of a row of blocks in as many whole vectors as it has. Returns the number
/// of their pixels in a row.
int sum_differences(GrayView view, const Image<std::uint8_t>& filtered, int y0, int y1,
                    std::int32_t* change, std::int32_t* difference) {
  const hn::CappedTag<std::uint8_t, 64> d8;
  const hn::Repartition<std::uint64_t, decltype(d8)> d64;
  constexpr int kMostSums = static_cast<int>(hn::MaxLanes(d64));
  const int lanes = static_cast<int>(hn::Lanes(d8));
  int x = 0;
  for (; x + lanes <= view.width; x += lanes) {
    auto sum_now = hn::Zero(d64), sum_before = hn::Zero(d64), sum = hn::Zero(d64);
    for (int y = y0; y < y1; ++y) {
      const auto now = hn::LoadU(d8, view.row(y) + x);
      const auto before = hn::LoadU(d8, filtered.row(y) + x);
      sum_now = hn::Add(sum_now, hn::SumsOf8(now));
      sum_before = hn::Add(sum_before, hn::SumsOf8(before));
      const auto apart = hn::Or(hn::SaturatedSub(now, before), hn::SaturatedSub(before, now));
      sum = hn::Add(sum, hn::SumsOf8(apart));
    }
    std::uint64_t sums_now[kMostSums], sums_before[kMostSums], sums[kMostSums];
    hn::StoreU(sum_now, d64, sums_now);
    hn::StoreU(sum_before, d64, sums_before);
    hn::StoreU(sum, d64, sums);
    for (int i = 0; i < lanes / kTimeBlock; ++i) {
      change[x / kTimeBlock + i] = static_cast<int>(sums_now[i]) - static_cast<int>(sums_before[i]);
      difference[x / kTimeBlock + i] = static_cast<int>(sums[i]);
    }
  }
  return x;
}

using Steps = hn::CappedTag<std::int16_t, 32>;

/// Adds a vector of a view with these weights to the means `last`, of which `rests` are known, from
/// here on. Returns their rests.
HWY_INLINE hn::Vec<Steps> add_to_means(const std::uint8_t* grays, hn::Vec<Steps> weights,
                                       const std::uint8_t* last, hn::Vec<Steps> rests,
                                       std::uint8_t* filtered) {
  const Steps d16;
  const hn::Rebind<std::uint8_t, Steps> d8;
  const auto rounding = hn::Set(d16, kMeanOne / 2);
  const auto steps = [&](const std::uint8_t* values) {
    return hn::ShiftLeft<kMeanShift>(hn::PromoteTo(d16, hn::LoadU(d8, values)));
  };
  const auto mean = hn::Add(steps(last), rests);  // plus rounding
  const auto difference = hn::Sub(mean, hn::Add(steps(grays), rounding));
  // The product is divided by 2^15, and neither -2 nor the order of the operands changes which way
  // halves are rounded.
  const auto next = hn::Add(mean, hn::MulFixedPoint15(difference, weights));
  hn::StoreU(hn::DemoteTo(d8, hn::ShiftRight<kMeanShift>(next)), d8, filtered);
  return hn::And(next, hn::Set(d16, kMeanOne - 1));
}

/// Adds the rows y, which is even, and y + 1, if there is one, of a frame to the means.
void average_two_rows(GrayView view, int y, const std::int16_t* weights, const Means& last,
                      Means& means) {
  const Steps d16;
  const hn::Rebind<std::uint8_t, Steps> d8;
  const int width = view.width, lanes = static_cast<int>(hn::Lanes(d16));
  const bool both = y + 1 < view.height;
  const auto add = [&](const std::uint8_t* upper, const std::uint8_t* lower, int x) {
    const auto weight = hn::LoadU(d16, weights + x);
    const auto before = hn::PromoteTo(d16, hn::LoadU(d8, last.rests.row(y / 2) + x));
    auto rests =
        add_to_means(upper, weight, last.filtered.row(y) + x,
                     hn::And(before, hn::Set(d16, kMeanOne - 1)), means.filtered.row(y) + x);
    if (both) {
      const auto below =
          add_to_means(lower, weight, last.filtered.row(y + 1) + x,
                       hn::ShiftRight<kMeanShift>(before), means.filtered.row(y + 1) + x);
      rests = hn::Or(rests, hn::ShiftLeft<kMeanShift>(below));
    }
    hn::StoreU(hn::DemoteTo(d8, rests), d8, means.rests.row(y / 2) + x);
  };
  const std::uint8_t *upper = view.row(y), *lower = both ? view.row(y + 1) : upper;
  int x = 0;
  for (; x + lanes <= width; x += lanes) add(upper + x, lower + x, x);
  if (x == width) return;
  // Nothing after the end of the view may be read.
  std::array<std::uint8_t, hn::MaxLanes(d16)> upper_end = {}, lower_end = {};
  std::copy(upper + x, upper + width, upper_end.begin());
  std::copy(lower + x, lower + width, lower_end.begin());
  add(upper_end.data(), lower_end.data(), x);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(sum_differences);
HWY_EXPORT(average_two_rows);

namespace {

static_assert(kWeightOne == 1 << 14, "add_to_means() divides by twice as much");

/// The trust of a block with this sum of differences, 0 from the limit on.
int trust_of(int change, int limit) {
  const std::int64_t size = std::min(std::abs(change), limit);
  const std::int64_t square = std::int64_t{limit} * limit;
  const int rest = static_cast<int>(kTrustOne * (square - size * size) / square);
  return rest * rest / kTrustOne;
}

/// The least trust of a block and those above and below it; the full one outside of the view.
int least_of_column(const Image<std::uint8_t>& trust, int column, int row) {
  if (column == trust.width()) return kTrustOne;
  const int above = trust.row(std::max(row - 1, 0))[column];
  const int below = trust.row(std::min(row + 1, trust.height() - 1))[column];
  return std::min({above, int{trust.row(row)[column]}, below});
}

/// The standard deviation of the sums of the blocks' differences, if most blocks are still.
float deviation_of(float noise, TimeBlocks& blocks) {
  std::int32_t* const sorted = blocks.sorted.data();
  std::int32_t* end = sorted;
  for (int row = 0; row < blocks.change.height(); ++row) {
    const std::int32_t* change = blocks.change.row(row);
    end = std::transform(change, change + blocks.change.width(), end,
                         [](std::int32_t sum) { return std::abs(sum); });
  }
  std::int32_t* const middle = sorted + (end - sorted) / 2;
  std::nth_element(sorted, middle, end);
  // Independent differences of two values with this noise, a fifth more, and what rounding adds.
  const float of_noise = 1.2F * 1.414F * kTimeBlock * noise + kTimeBlock;
  const float found = 1.48F * static_cast<float>(*middle);
  return std::max(std::min(found, of_noise), kLeastDeviation);
}

}  // namespace

void Means::resize(int width, int height, ReusedMemory* reused) {
  filtered.resize(width, height, reused);
  rests.resize(width, (height + 1) / 2, reused);
  frames.resize(time_blocks(width), time_blocks(height), reused);
}

void Means::clear() {
  for (int y = 0; y < filtered.height(); ++y) {
    std::fill_n(filtered.row(y), filtered.width(), std::uint8_t{0});
    std::fill_n(rests.row(y / 2), rests.width(), kNoRests);
  }
}

void TimeBlocks::resize(int width, int height, ReusedMemory* reused) {
  const int columns = time_blocks(width), rows = time_blocks(height);
  change.resize(columns, rows, reused);
  difference.resize(columns, rows, reused);
  trust.resize(columns, rows, reused);
  weights.resize(width, rows, reused);
  sorted.resize(static_cast<std::size_t>(columns) * rows, reused);
}

void measure_changes(GrayView view, const Image<std::uint8_t>& filtered, int y0, int y1,
                     TimeBlocks& blocks) {
  for (int y = y0; y < y1; y += kTimeBlock) {
    const int bottom = std::min(y + kTimeBlock, view.height);
    std::int32_t* change = blocks.change.row(y / kTimeBlock);
    std::int32_t* difference = blocks.difference.row(y / kTimeBlock);
    int x = 0;
    if (bottom - y == kTimeBlock) {
      x = HWY_DYNAMIC_DISPATCH(sum_differences)(view, filtered, y, bottom, change, difference);
    }
    for (; x < view.width; x += kTimeBlock) {
      const int right = std::min(x + kTimeBlock, view.width);
      int sum = 0, magnitude = 0;
      for (int i = y; i < bottom; ++i) {
        for (int j = x; j < right; ++j) {
          const int apart = view.row(i)[j] - filtered.row(i)[j];
          sum += apart;
          magnitude += std::abs(apart);
        }
      }
      const int pixels = (right - x) * (bottom - y);
      change[x / kTimeBlock] = sum * kTimeBlockPixels / pixels;
      difference[x / kTimeBlock] = magnitude * kTimeBlockPixels / pixels;
    }
  }
}

double rate_changes(float noise, const Image<std::uint8_t>& frames, TimeBlocks& blocks) {
  const int limit = static_cast<int>(kMostDeviations * deviation_of(noise, blocks));
  const int columns = blocks.trust.width(), rows = blocks.trust.height();
  std::array<float, kMostFrames * kFramesOne + 1> most;  // by the number of frames
  for (std::size_t i = 0; i < most.size(); ++i) {
    // The noise of the frame and that of its mean.
    const float deviation = noise * std::sqrt(1 + 1 / (static_cast<float>(i) / kFramesOne));
    most[i] = kTimeBlockPixels * (kStillDeviation * deviation + kStillRest);
  }
  int count = 0;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < columns; ++i) {
      const bool still =
          static_cast<float>(blocks.difference.row(row)[i]) <= most[frames.row(row)[i]];
      blocks.trust.row(row)[i] =
          static_cast<std::uint8_t>(still ? trust_of(blocks.change.row(row)[i], limit) : 0);
      count += still;
    }
  }
  return static_cast<double>(count) / (static_cast<double>(columns) * rows);
}

void count_frames(bool anew, const Image<std::uint8_t>& last, TimeBlocks& blocks,
                  Image<std::uint8_t>& frames) {
  const auto least = [&](int column, int row) {
    return anew ? 0 : least_of_column(blocks.trust, column, row);
  };
  for (int row = 0; row < frames.height(); ++row) {
    std::uint8_t* counted = frames.row(row);
    std::int16_t* weights = blocks.weights.row(row);
    int before = kTrustOne, here = least(0, row);
    for (int i = 0; i < frames.width(); ++i) {
      const int next = least(i + 1, row);
      const int kept = anew ? 0 : std::min<int>(last.row(row)[i], (kMostFrames - 1) * kFramesOne);
      const int trust = std::min({before, here, next});
      before = std::exchange(here, next);
      counted[i] = static_cast<std::uint8_t>(kFramesOne + kept * trust / kTrustOne);
      // Of whole blocks: the end of the last one belongs to the padding.
      std::fill_n(weights + i * kTimeBlock, kTimeBlock,
                  static_cast<std::int16_t>(-2 * (kWeightOne * kFramesOne / counted[i])));
    }
  }
}

void average_rows(GrayView view, int y0, int y1, const TimeBlocks& blocks, const Means& last,
                  Means& means) {
  const auto average = HWY_DYNAMIC_DISPATCH(average_two_rows);
  for (int y = y0; y < y1; y += 2) {
    average(view, y, blocks.weights.row(y / kTimeBlock), last, means);
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
