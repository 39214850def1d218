// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/speckle_removal.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/speckle_removal.cpp"
#include "base/simd.hpp"
#include "base/simd_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Disparities = hn::CappedTag<std::int32_t, kAlignment / 4>;

/// Bit i of both words belongs to column i.
struct ColumnBits {
  std::uint64_t known = 0;   ///< has a disparity
  std::uint64_t joined = 0;  ///< is connected to the next column
};

/// The bits of the first `columns` columns of a row, at most kWord. Reads one column more.
ColumnBits column_bits(const std::int32_t* row, int columns, std::int32_t tolerance) {
  const Disparities d32;
  const auto none = hn::Set(d32, kNoDisparity);
  const auto most = hn::Set(d32, tolerance);
  ColumnBits bits;
  for (int i = 0; i < columns; i += static_cast<int>(hn::Lanes(d32))) {
    const auto here = hn::LoadU(d32, row + i);
    const auto next = hn::LoadU(d32, row + i + 1);
    const auto apart = hn::Or(hn::Gt(hn::Abs(hn::Sub(next, here)), most), hn::Eq(next, none));
    bits.known |= bits_of(d32, hn::Not(hn::Eq(here, none))) << i;
    bits.joined |= bits_of(d32, hn::Not(apart)) << i;
  }
  bits.known &= first_bits(columns);
  bits.joined &= bits.known;
  return bits;
}

/// Writes the columns of the set bits, bit 0 being column `first`, and advances `to` past the last
/// one.
void write_columns(std::uint64_t bits, int first, std::uint16_t*& to) {
  for (; bits != 0; bits &= bits - 1) {
    *to++ = static_cast<std::uint16_t>(first + std::countr_zero(bits));
  }
}

/// Writes the first and last columns of a row's runs, and, unless it is nullptr, the bits of the
/// first ones. Returns the number of runs. Reads the row's padding.
int find_row_runs(const std::int32_t* row, int width, std::int32_t tolerance, std::uint16_t* begin,
                  std::uint16_t* last, std::uint64_t* starts) {
  const std::uint16_t* const first_run = begin;
  std::uint64_t joined_before = 0;  // whether the last column is connected to the next one
  for (int x = 0; x < width; x += kWord) {
    ColumnBits bits = column_bits(row + x, std::min(kWord, width - x), tolerance);
    if (x + kWord >= width) bits.joined &= ~(std::uint64_t{1} << (width - 1 - x));
    const std::uint64_t first = bits.known & ~(bits.joined << 1 | joined_before);
    if (starts != nullptr) *starts++ = first;
    write_columns(first, x, begin);
    write_columns(bits.known & ~bits.joined, x, last);
    joined_before = bits.joined >> (kWord - 1);
  }
  return static_cast<int>(begin - first_run);
}

/// The bits of the first `columns` columns, at most kWord, that connect two rows.
std::uint64_t connected_bits(const std::int32_t* above, const std::int32_t* row, int columns,
                             std::int32_t tolerance) {
  const Disparities d32;
  const auto none = hn::Set(d32, kNoDisparity);
  const auto most = hn::Set(d32, tolerance);
  std::uint64_t apart = 0;
  for (int i = 0; i < columns; i += static_cast<int>(hn::Lanes(d32))) {
    const auto upper = hn::LoadU(d32, above + i);
    const auto lower = hn::LoadU(d32, row + i);
    const auto unknown = hn::Or(hn::Eq(upper, none), hn::Eq(lower, none));
    const auto distant = hn::Gt(hn::Abs(hn::Sub(upper, lower)), most);
    apart |= bits_of(d32, hn::Or(unknown, distant)) << i;
  }
  return ~apart & first_bits(columns);
}

bool is_root(std::uint32_t link) { return (link & kRootRun) != 0; }

/// The root of the run's component. Halves the path to it.
std::uint32_t find_root(std::uint32_t* link, std::uint32_t run) {
  while (!is_root(link[run])) {
    const std::uint32_t above = link[run];
    if (is_root(link[above])) return above;
    link[run] = link[above];
    run = link[run];
  }
  return run;
}

/// Unites the components of the two runs. The smaller one is attached to the larger one, so that no
/// path to a root is longer than the logarithm of the component's size.
void unite(std::uint32_t* link, std::uint32_t a, std::uint32_t b) {
  a = find_root(link, a);
  b = find_root(link, b);
  if (a == b) return;
  if (link[a] < link[b]) std::swap(a, b);
  link[a] += link[b] - kRootRun;
  link[b] = a;
}

/// Connects the runs of row y - 1 to those of row y. Reads the rows' padding.
void join_rows(const Image<std::int32_t>& map, std::int32_t tolerance, int y, SpeckleRuns& runs) {
  const std::uint64_t* starts_above = runs.starts_of(y - 1);
  const std::uint64_t* starts = runs.starts_of(y);
  std::uint32_t above = runs.first[y - 1] - 1;  // the last run that begins before column x
  std::uint32_t run = runs.first[y] - 1;
  std::uint64_t before = 0;  // whether the last column connects the rows
  for (int x = 0; x < runs.width; x += kWord, ++starts_above, ++starts) {
    const int columns = std::min(kWord, runs.width - x);
    const std::uint64_t connected =
        connected_bits(map.row(y - 1) + x, map.row(y) + x, columns, tolerance);
    const std::uint64_t again = (connected << 1 | before) & ~(*starts_above | *starts);
    for (std::uint64_t bits = connected & ~again; bits != 0; bits &= bits - 1) {
      const std::uint64_t up_to = bits ^ (bits - 1);
      unite(runs.link.data(), above + std::popcount(*starts_above & up_to),
            run + std::popcount(*starts & up_to));
    }
    above += std::popcount(*starts_above);
    run += std::popcount(*starts);
    before = connected >> (kWord - 1);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(find_row_runs);
HWY_EXPORT(join_rows);

namespace {

static_assert(kLargestImageSide <= 0xFFFF, "columns are kept in 16 bits");
static_assert(1LL * kLargestImageSide * kLargestImageSide < kRootRun,
              "neither an index nor a size reaches the flag");

/// Writes the runs of row y from index `run` on and returns the index after the last one.
std::uint32_t write_row_runs(const Image<std::int32_t>& map, std::int32_t tolerance, int y,
                             std::uint32_t run, SpeckleRuns& runs) {
  std::uint16_t* begin = runs.begin.data() + run;
  std::uint16_t* end = runs.end.data() + run;
  std::uint32_t* link = runs.link.data() + run;
  const int count =
      find_runs_of_row(map.row(y), runs.width, tolerance, begin, end, runs.starts_of(y));
  for (int i = 0; i < count; ++i) {
    ++end[i];  // one past the last column
    link[i] = kRootRun + static_cast<std::uint32_t>(end[i] - begin[i]);
  }
  return run + static_cast<std::uint32_t>(count);
}

/// Entry k: the least share of a full component with the weight k, (k / 255)^10, in 1 / 2^32. The
/// products are exact enough on every processor, and no sums are involved.
constexpr std::array<std::uint64_t, 256> kLeastShares = [] {
  std::array<std::uint64_t, 256> shares{};
  for (int k = 0; k < 256; ++k) {
    double share = 4294967296.0;
    for (int i = 0; i < 10; ++i) share *= k / 255.0;
    shares[k] = static_cast<std::uint64_t>(share);
  }
  return shares;
}();

std::uint8_t area_weight(std::uint64_t pixels, std::uint64_t map_pixels) {
  const std::uint64_t share = (pixels * kFullArea << 32) / map_pixels;
  const auto next = std::upper_bound(kLeastShares.begin() + 1, kLeastShares.end(), share);
  return static_cast<std::uint8_t>(next - kLeastShares.begin() - 1);
}

}  // namespace

void SpeckleRuns::resize(int map_width, int map_height) {
  const std::size_t pixels = static_cast<std::size_t>(map_width) * map_height;
  first.resize(map_height);
  last.resize(map_height);
  begin.resize(pixels);
  end.resize(pixels);
  link.resize(pixels);
  starts.resize(static_cast<std::size_t>(row_words(map_width)) * map_height);
  width = map_width;
  height = map_height;
}

int find_runs_of_row(const std::int32_t* row, int width, std::int32_t tolerance,
                     std::uint16_t* begin, std::uint16_t* last, std::uint64_t* starts) {
  return HWY_DYNAMIC_DISPATCH(find_row_runs)(row, width, tolerance, begin, last, starts);
}

void find_runs(const Image<std::int32_t>& map, std::int32_t tolerance, int y0, int y1,
               SpeckleRuns& runs) {
  std::uint32_t run = static_cast<std::uint32_t>(y0) * static_cast<std::uint32_t>(runs.width);
  for (int y = y0; y < y1; ++y) {
    runs.first[y] = run;
    run = write_row_runs(map, tolerance, y, run, runs);
    runs.last[y] = run;
    if (y > y0) HWY_DYNAMIC_DISPATCH(join_rows)(map, tolerance, y, runs);
  }
}

void join_bands(const Image<std::int32_t>& map, std::int32_t tolerance, int band,
                SpeckleRuns& runs) {
  for (int y = band; y < runs.height; y += band) {
    HWY_DYNAMIC_DISPATCH(join_rows)(map, tolerance, y, runs);
  }
}

std::uint32_t root_of(const SpeckleRuns& runs, std::uint32_t run) {
  while ((runs.link[run] & kRootRun) == 0) run = runs.link[run];
  return run;
}

void remove_small(const SpeckleRuns& runs, int size, int y0, int y1, Image<std::int32_t>& map,
                  Image<std::uint8_t>* area) {
  const std::uint32_t* link = runs.link.data();
  const std::uint64_t map_pixels = static_cast<std::uint64_t>(runs.width) * runs.height;
  const std::uint32_t enough = kRootRun + static_cast<std::uint32_t>(size);
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::uint8_t* weights = area != nullptr ? area->row(y) : nullptr;
    if (weights != nullptr) std::fill_n(weights, runs.width, std::uint8_t{0});
    for (std::uint32_t i = runs.first[y]; i < runs.last[y]; ++i) {
      const std::uint32_t root = root_of(runs, i);
      if (link[root] < enough) {
        std::fill(row + runs.begin[i], row + runs.end[i], kNoDisparity);
      } else if (weights != nullptr) {
        const std::uint8_t weight = area_weight(link[root] - kRootRun, map_pixels);
        std::fill(weights + runs.begin[i], weights + runs.end[i], weight);
      }
    }
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
