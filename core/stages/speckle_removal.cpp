// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/speckle_removal.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

static_assert(kLargestImageSide <= 0xFFFF, "columns are kept in 16 bits");
static_assert(1LL * kLargestImageSide * kLargestImageSide < kRootRun,
              "neither an index nor a size reaches the flag");

bool is_root(std::uint32_t link) { return (link & kRootRun) != 0; }

/// The root of the run's component; halves the way there for the next time.
std::uint32_t find_root(std::uint32_t* link, std::uint32_t run) {
  while (!is_root(link[run])) {
    const std::uint32_t above = link[run];
    if (is_root(link[above])) return above;
    link[run] = link[above];
    run = link[run];
  }
  return run;
}

/// Makes one component of the two runs' components. The smaller one is put below the larger one, so
/// that no way to a root has more steps than the logarithm of the component's size.
void unite(std::uint32_t* link, std::uint32_t a, std::uint32_t b) {
  a = find_root(link, a);
  b = find_root(link, b);
  if (a == b) return;
  if (link[a] < link[b]) std::swap(a, b);
  link[a] += link[b] - kRootRun;
  link[b] = a;
}

/// Writes the runs of one row from index `run` on and returns the index after the last one.
std::uint32_t find_row_runs(const std::int32_t* row, std::int32_t tolerance, std::uint32_t run,
                            SpeckleRuns& runs) {
  const int width = runs.width;
  for (int x = 0; x < width;) {
    if (row[x] == kNoDisparity) {
      ++x;
      continue;
    }
    const int begin = x++;
    while (x < width && row[x] != kNoDisparity && std::abs(row[x] - row[x - 1]) <= tolerance) ++x;
    runs.begin[run] = static_cast<std::uint16_t>(begin);
    runs.end[run] = static_cast<std::uint16_t>(x);
    runs.link[run] = kRootRun + static_cast<std::uint32_t>(x - begin);
    ++run;
  }
  return run;
}

/// True where a column of begin .. end - 1, all known in both rows, connects them.
bool columns_connect(const std::int32_t* above, const std::int32_t* row, std::int32_t tolerance,
                     int begin, int end) {
  for (int x = begin; x < end; ++x) {
    if (std::abs(above[x] - row[x]) <= tolerance) return true;
  }
  return false;
}

/// Connects the runs of row y - 1 to those of row y.
void join_rows(const Image<std::int32_t>& map, std::int32_t tolerance, int y, SpeckleRuns& runs) {
  const std::uint32_t last_above = runs.last[y - 1];
  const std::uint32_t last = runs.last[y];
  std::uint32_t above = runs.first[y - 1];
  std::uint32_t run = runs.first[y];
  while (above < last_above && run < last) {
    const int begin = std::max(runs.begin[above], runs.begin[run]);
    const int end = std::min(runs.end[above], runs.end[run]);
    if (columns_connect(map.row(y - 1), map.row(y), tolerance, begin, end)) {
      unite(runs.link.data(), above, run);
    }
    // Whichever ends first cannot overlap anything that follows the other one.
    if (runs.end[above] == end) {
      ++above;
    } else {
      ++run;
    }
  }
}

}  // namespace

void SpeckleRuns::resize(int map_width, int map_height) {
  const std::size_t pixels = static_cast<std::size_t>(map_width) * map_height;
  first.resize(map_height);
  last.resize(map_height);
  begin.resize(pixels);
  end.resize(pixels);
  link.resize(pixels);
  width = map_width;
  height = map_height;
}

void find_runs(const Image<std::int32_t>& map, std::int32_t tolerance, int y0, int y1,
               SpeckleRuns& runs) {
  std::uint32_t run = static_cast<std::uint32_t>(y0) * static_cast<std::uint32_t>(runs.width);
  for (int y = y0; y < y1; ++y) {
    runs.first[y] = run;
    run = find_row_runs(map.row(y), tolerance, run, runs);
    runs.last[y] = run;
    if (y > y0) join_rows(map, tolerance, y, runs);
  }
}

void join_bands(const Image<std::int32_t>& map, std::int32_t tolerance, int band,
                SpeckleRuns& runs) {
  for (int y = band; y < runs.height; y += band) join_rows(map, tolerance, y, runs);
}

void remove_small(const SpeckleRuns& runs, int size, int y0, int y1, Image<std::int32_t>& map) {
  if (size <= 1) return;
  const std::uint32_t* link = runs.link.data();
  const std::uint32_t enough = kRootRun + static_cast<std::uint32_t>(size);
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    for (std::uint32_t i = runs.first[y]; i < runs.last[y]; ++i) {
      std::uint32_t root = i;  // without shorter ways for the next time: other bands read them
      while (!is_root(link[root])) root = link[root];
      if (link[root] < enough) std::fill(row + runs.begin[i], row + runs.end[i], kNoDisparity);
    }
  }
}

}  // namespace mtstereo
