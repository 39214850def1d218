// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/thin_chains.hpp"

#include <algorithm>
#include <cstdlib>

#include "stages/refine/speckle_removal.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/thin_chains.cpp"
#include "base/simd.hpp"
#include "base/simd_transpose-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Writes the columns x0 .. x1 - 1 of the map as the first rows, where their number is a multiple
/// of four.
/// May write three elements after the end of a row.
void transpose_columns(const Image<std::int32_t>& map, int x0, int x1,
                       Image<std::int32_t>& columns) {
  constexpr int kBlock = 16;  // a cache line
  const int last = map.height() - 1;
  for (int y0 = 0; y0 <= last; y0 += kBlock) {
    const std::int32_t* rows[kBlock];
    for (int i = 0; i < kBlock; ++i) rows[i] = map.row(y0 + i < last ? y0 + i : last);
    const int end = map.height() - y0 < kBlock ? map.height() - y0 : kBlock;
    for (int x = x0; x < x1; x += 4) {
      std::int32_t* out[4];
      for (int i = 0; i < 4; ++i) out[i] = columns.row(x - x0 + i) + y0;
      for (int i = 0; i < end; i += 4) transpose_four(rows + i, x, out, i);
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(transpose_columns);

namespace {

bool connected(std::int32_t a, std::int32_t b) { return std::abs(a - b) <= kDisparityOne; }

const ThinRules& rules_of(const ThinRuns& runs) {
  return runs.direction == Lines::kRows ? kThinRowRules : kThinColumnRules;
}

/// The mean of a row's pixels.
std::int32_t mean_of(const std::int32_t* row, int begin, int end) {
  std::int32_t sum = 0;
  for (int i = begin; i < end; ++i) sum += row[i];
  return sum / (end - begin);
}

/// Whether there is a thin run between the positions `before` and `after`, the nearest known ones
/// outside of begin .. end - 1 or far away; if so, sets its place and disparities.
bool is_thin(const std::int32_t* row, int before, int begin, int end, int after, ThinRun& run) {
  if (end - begin > kMostThinWidth) return false;
  run.before = begin - before <= kMostThinWidth ? row[before] : kNoDisparity;
  run.after = after - end < kMostThinWidth ? row[after] : kNoDisparity;
  const std::int32_t background = std::max(run.before, run.after);
  if (background == kNoDisparity) return false;
  run.begin = static_cast<std::uint16_t>(begin);
  run.end = static_cast<std::uint16_t>(end);
  run.disparity = mean_of(row, begin, end);
  return run.disparity - background > kThinStep;
}

/// The first run of a line with the most columns in common with `run`, or -1. `from`
/// is the first run that may overlap; it moves on with the runs.
std::int32_t best_overlap(const ThinRun* line, int count, const ThinRun& run, int& from) {
  while (from < count && line[from].end <= run.begin) ++from;
  int most = 0, best = -1;
  for (int k = from; k < count && line[k].begin < run.end; ++k) {
    const int overlap = std::min(run.end, line[k].end) - std::max(run.begin, line[k].begin);
    if (overlap <= most || !connected(run.disparity, line[k].disparity)) continue;
    most = overlap;
    best = k;
  }
  return best;
}

/// The least difference between a gray value and the right view within half a pixel of a position
/// [1/256 px]. The view continues with its border.
int difference(int gray, const std::uint8_t* right, int width, std::int32_t at) {
  const std::int32_t end = at + kDisparityOne / 2;
  const int column = end >> 8, part = end & 255;
  const auto pixel = [&](int x) { return int{right[std::clamp(x, 0, width - 1)]}; };
  const int before = pixel(column - 1), middle = pixel(column), after = pixel(column + 1);
  const int first = (before * (256 - part) + middle * part) >> 8;
  const int last = (middle * (256 - part) + after * part) >> 8;
  const int low = std::min({first, middle, last}), high = std::max({first, middle, last});
  return std::min(std::max({0, gray - high, low - gray}), kMostThinDifference);
}

void rate_run(const ThinViews& views, Lines direction, int line, ThinRun& run) {
  const int width = views.left.width;
  const int length = direction == Lines::kRows ? width : views.left.height;
  const std::int32_t before = run.before == kNoDisparity ? run.after : run.before;
  const std::int32_t after = run.after == kNoDisparity ? run.before : run.after;
  int gain = 0, misfit = 0, count = 0;
  for (int at = run.begin - 1; at <= run.end; ++at) {
    ThinPixel& pixel = run.pixels[at - run.begin + 1];
    const int inside = std::clamp(at, 0, length - 1);
    const int x = direction == Lines::kRows ? inside : line;
    const int y = direction == Lines::kRows ? line : inside;
    const int gray = views.left.row(y)[x];
    const auto from = [&](std::int32_t disparity) {
      return difference(gray, views.right.row(y), width, 256 * x - disparity);
    };
    const int own = from(run.disparity);
    const int behind = std::min(from(before), from(after));
    static_assert(kMostThinDifference <= 127);
    pixel = {static_cast<std::int8_t>(behind - own), static_cast<std::uint8_t>(own),
             static_cast<std::uint8_t>(gray)};
    if (at != inside) continue;
    gain += pixel.gain;
    misfit += own;
    ++count;
  }
  run.gain = static_cast<std::int16_t>(16 * gain / count);
  run.misfit = static_cast<std::int16_t>(16 * misfit / count);
}

/// Sums over the runs of a chain around one of them, aligned by their middles.
struct Sums {
  std::array<std::int32_t, kMostThinWidth + 2> gain{}, misfit{}, gray{}, count{};

  void add(const ThinRun& run, int shift, int pixels) {
    const int own = run.end - run.begin + 2;
    for (int i = std::max(0, -shift); i < std::min(pixels, own - shift); ++i) {
      const ThinPixel& pixel = run.pixels[i + shift];
      gain[i] += pixel.gain;
      misfit[i] += pixel.misfit;
      gray[i] += pixel.gray;
      ++count[i];
    }
  }
};

/// The sums of a run and of up to kThinReach runs before and after it.
Sums sums_around(const ThinRun* all, const ThinRun& run) {
  const int width = run.end - run.begin;
  Sums sums;
  const auto add = [&](const ThinRun& other) {
    const int wider = other.end - other.begin - width;
    sums.add(other, wider >> 1, width + 2);
  };
  add(run);
  const ThinRun* other = &run;
  for (int i = 0; i < kThinReach && other->previous >= 0; ++i) {
    other = all + other->previous;
    add(*other);
  }
  other = &run;
  for (int i = 0; i < kThinReach && other->next >= 0; ++i) {
    other = all + other->next;
    add(*other);
  }
  return sums;
}

/// Bit i is set if the i-th pixel of a run is kept.
unsigned kept_pixels(const Sums& sums, int width) {
  const auto gray = [&](int i) { return 16 * sums.gray[i] / sums.count[i]; };
  const int middle = (gray(1 + width / 2) + gray(1 + (width - 1) / 2)) / 2;
  unsigned kept = 0;
  for (int i = 1; i <= width; ++i) {
    const int outside = gray(2 * i < width + 1 ? 0 : width + 1);
    const bool alike = 5 * std::abs(gray(i) - middle) <= 4 * std::abs(gray(i) - outside);
    const bool agrees = sums.gain[i] > kLeastPixelGain * sums.count[i] &&
                        sums.misfit[i] <= kMostPixelMisfit * sums.count[i];
    if (alike && agrees) kept |= 1U << (i - 1);
  }
  return kept;
}

}  // namespace

void ThinRuns::resize(int width, int height) {
  const auto most = [](int line_count, int length) {
    return static_cast<std::size_t>(line_count) * (length / kThinSpacing + 1);
  };
  const std::size_t runs = std::max(most(width, height), most(height, width));
  first.resize(std::max(width, height));
  count.resize(std::max(width, height));
  run.resize(runs);
  chain.resize(runs);
}

void ThinRuns::start(Lines lines_direction, int width, int height) {
  direction = lines_direction;
  lines = direction == Lines::kRows ? height : width;
  capacity = (direction == Lines::kRows ? width : height) / kThinSpacing + 1;
}

void ThinScratch::resize(int width, int height) {
  begin.resize(std::max(width, height));
  last.resize(std::max(width, height));
}

void transpose(const Image<std::int32_t>& map, int x0, int x1, Image<std::int32_t>& columns) {
  const int fours = x0 + (x1 - x0) / 4 * 4;
  HWY_DYNAMIC_DISPATCH(transpose_columns)(map, x0, fours, columns);
  for (int x = fours; x < x1; ++x) {
    for (int y = 0; y < map.height(); ++y) columns.row(x - x0)[y] = map.row(y)[x];
  }
}

void find_thin_runs(const Image<std::int32_t>& map, int row, int line0, int line1,
                    ThinScratch& scratch, ThinRuns& runs) {
  constexpr int kFarAway = 1 << 20;
  const std::uint16_t* begin = scratch.begin.data();
  const std::uint16_t* last = scratch.last.data();
  std::int32_t first = line0 * runs.capacity;
  for (int line = line0; line < line1; ++line) {
    const std::int32_t* pixels = map.row(row + line - line0);
    const int all = find_runs_of_row(pixels, map.width(), kDisparityOne, scratch.begin.data(),
                                     scratch.last.data(), nullptr);
    ThinRun* out = runs.run.data() + first;
    int count = 0;
    for (int i = 0; i < all && count < runs.capacity; ++i) {
      const int before = i == 0 ? -kFarAway : last[i - 1];
      const int after = i + 1 == all ? kFarAway : begin[i + 1];
      count += is_thin(pixels, before, begin[i], last[i] + 1, after, out[count]);
    }
    runs.first[line] = first;
    runs.count[line] = count;
    first += count;
  }
}

void link_thin_runs(ThinRuns& runs) {
  ThinRun* all = runs.run.data();
  for (int line = 0; line < runs.lines; ++line) {
    int from[2] = {0, 0};
    for (int i = 0; i < runs.count[line]; ++i) {
      const std::int32_t index = runs.first[line] + i;
      ThinRun& run = all[index];
      run.previous = run.next = -1;
      for (int back = 1; back <= 2 && back <= line && run.previous < 0; ++back) {
        const std::int32_t first = runs.first[line - back];
        const int best = best_overlap(all + first, runs.count[line - back], run, from[back - 1]);
        if (best >= 0) run.previous = first + best;
      }
      run.chain = index;
      if (run.previous >= 0) {
        ThinRun& previous = all[run.previous];
        run.chain = previous.chain;
        if (previous.next < 0) previous.next = index;
      } else {
        runs.chain[index] = {};
      }
      ++runs.chain[run.chain].runs;
    }
  }
}

void rate_thin_runs(const ThinViews& views, int line0, int line1, ThinRuns& runs) {
  const int least = rules_of(runs).runs;
  for (int line = line0; line < line1; ++line) {
    for (int i = 0; i < runs.count[line]; ++i) {
      ThinRun& run = runs.run[runs.first[line] + i];
      if (runs.chain[run.chain].runs >= least) rate_run(views, runs.direction, line, run);
    }
  }
}

void accept_chains(ThinRuns& runs) {
  const ThinRules& rules = rules_of(runs);
  for (int line = 0; line < runs.lines; ++line) {
    for (int i = 0; i < runs.count[line]; ++i) {
      const ThinRun& run = runs.run[runs.first[line] + i];
      ThinChain& chain = runs.chain[run.chain];
      if (chain.runs < rules.runs) continue;
      chain.gain += run.gain;
      chain.misfit += run.misfit;
      chain.convincing += run.gain > kThinConvincing;
      chain.enclosed += run.before != kNoDisparity && run.after != kNoDisparity;
      // Complete with the last run of the chain; the earlier values have no effect.
      chain.accepted = chain.gain >= rules.gain * chain.runs &&
                       100 * chain.convincing >= rules.convincing * chain.runs &&
                       chain.misfit <= kMostThinMisfit * chain.runs &&
                       2 * chain.gain > chain.misfit &&
                       100 * chain.enclosed >= kThinEnclosed * chain.runs;
    }
  }
}

void mark_thin_pixels(const ThinRuns& runs, int line0, int line1, Image<std::int32_t>& copy) {
  for (int line = line0; line < line1; ++line) {
    for (int i = 0; i < runs.count[line]; ++i) {
      const ThinRun& run = runs.run[runs.first[line] + i];
      if (runs.chain[run.chain].accepted == 0) continue;
      unsigned kept = kept_pixels(sums_around(runs.run.data(), run), run.end - run.begin);
      for (int at = run.begin; kept != 0; ++at, kept >>= 1) {
        if ((kept & 1) == 0) continue;
        const bool rows = runs.direction == Lines::kRows;
        std::int32_t& disparity = copy.row(rows ? line : at)[rows ? at : line];
        disparity = -std::abs(disparity);
      }
    }
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
