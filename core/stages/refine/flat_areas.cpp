// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/flat_areas.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mtstereo {
namespace {

/// Calls body(run, row) for all runs from top to bottom.
template <typename Body>
void for_each_run(const SpeckleRuns& runs, Body&& body) {
  for (int y = 0; y < runs.height; ++y) {
    for (std::uint32_t run = runs.first[y]; run < runs.last[y]; ++run) body(run, y);
  }
}

}  // namespace

void GrayTotals::add(const GrayTotals& other) {
  count += other.count;
  sum += other.sum;
  squares += other.squares;
}

void FlatAreas::resize(int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  gray.resize(width, height);
  runs.resize(width, height);
  area.resize(pixels);
  first.resize(pixels * scale * scale / kLeastFlatArea + 1);
  spans.resize(pixels);
}

GrayTotals sum_grays(GrayView view, int y0, int y1, FlatAreas& areas) {
  const int width = areas.gray.width();
  GrayTotals totals;
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* upper = view.row(2 * y);
    const std::uint8_t* lower = view.row(2 * y + 1);
    std::int32_t* row = areas.gray.row(y);
    std::uint32_t sum = 0;
    std::uint64_t squares = 0;
    for (int x = 0; x < width; ++x) {
      const std::uint32_t gray = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
      row[x] = static_cast<std::int32_t>(gray) + 1;
      sum += gray;
      squares += gray * gray;
    }
    totals.add({static_cast<std::uint64_t>(width), sum, squares});
  }
  return totals;
}

int flat_step(const GrayTotals& totals, int scale, float noise) {
  const double count = static_cast<double>(totals.count);
  const double mean = static_cast<double>(totals.sum) / count;
  const double variance = static_cast<double>(totals.squares) / count - mean * mean;
  const double deviation = std::sqrt(std::max(variance, 0.0)) / 4;
  const int most = scale == 2 ? kHalvedFlatStep : kQuarteredFlatStep;
  const double step = std::round(most * std::min(1.0, deviation / kFullContrast));
  return std::max(static_cast<int>(step), static_cast<int>(kFlatNoise * noise));
}

void number_areas(FlatAreas& areas) {
  const SpeckleRuns& runs = areas.runs;
  std::uint32_t count = 0;
  for (int y = 0; y < runs.height; ++y) {
    std::fill(areas.area.data() + runs.first[y], areas.area.data() + runs.last[y], 0U);
  }
  for_each_run(runs, [&](std::uint32_t run, int) {
    const std::uint32_t root = root_of(runs, run);
    if ((runs.link[root] - kRootRun) * areas.scale * areas.scale < kLeastFlatArea) return;
    if (areas.area[root] == 0) {
      areas.area[root] = ++count;
      areas.first[count] = 0;
    }
    areas.area[run] = areas.area[root];
    ++areas.first[areas.area[run]];
  });
  areas.count = static_cast<int>(count);
  // first[k + 1] goes from the number of the area's runs to its begin, then to its end as they are
  // written.
  areas.first[0] = 0;
  std::uint32_t begin = 0;
  for (std::uint32_t k = 1; k <= count; ++k) begin += std::exchange(areas.first[k], begin);
  for_each_run(runs, [&](std::uint32_t run, int y) {
    if (areas.area[run] == 0) return;
    areas.spans[areas.first[areas.area[run]]++] = {static_cast<std::uint16_t>(y), runs.begin[run],
                                                   runs.end[run]};
  });
}

}  // namespace mtstereo
