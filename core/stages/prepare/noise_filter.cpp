// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/noise_filter.hpp"

#include <algorithm>
#include <cstring>

#define HWY_TARGET_INCLUDE "stages/prepare/noise_filter.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

constexpr int kReach = kNoiseWindow / 2;
constexpr int kPixels = kNoiseWindow * kNoiseWindow;

using Words = hn::CappedTag<std::uint16_t, kAlignment / 2>;
using Ints = hn::CappedTag<std::int32_t, kAlignment / 4>;

/// Advances the sums over the window's columns by one row.
void move_sums(const std::uint8_t* in, const std::uint8_t* out, int width,
               NoiseFilterScratch& scratch) {
  const Ints d32;
  const hn::Rebind<std::uint16_t, Ints> d16;
  const hn::Rebind<std::uint8_t, Ints> d8;
  std::uint16_t* sums = scratch.sums.data();
  std::int32_t* squares = scratch.squares.data();
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d32))) {
    const auto enters = hn::PromoteTo(d16, hn::LoadU(d8, in + x));
    const auto leaves = hn::PromoteTo(d16, hn::LoadU(d8, out + x));
    hn::StoreU(hn::Add(hn::LoadU(d16, sums + x), hn::Sub(enters, leaves)), d16, sums + x);
    const auto more = hn::PromoteTo(d32, hn::Mul(enters, enters));
    const auto less = hn::PromoteTo(d32, hn::Mul(leaves, leaves));
    hn::StoreU(hn::Add(hn::LoadU(d32, squares + x), hn::Sub(more, less)), d32, squares + x);
  }
}

/// Filters the columns of a row. `lines` are the rows from kReach above to kReach below.
void filter_columns(const std::uint8_t* const* lines, int width, NoiseFilterScratch& scratch) {
  const Words d16;
  const hn::Rebind<std::uint8_t, Words> d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const auto gray = [&](int row) {
      return hn::PromoteTo(d16, hn::LoadU(d8, lines[kReach + row] + x));
    };
    const auto middle = gray(0);
    const auto near = hn::Add(gray(-1), gray(1));
    const auto far = hn::Add(gray(-2), gray(2));
    const auto six = hn::Add(hn::ShiftLeft<2>(middle), hn::ShiftLeft<1>(middle));
    hn::StoreU(hn::Add(near, six), d16, scratch.narrow.data() + x);
    hn::StoreU(hn::Add(hn::Add(far, hn::ShiftLeft<2>(near)), six), d16, scratch.wide.data() + x);
  }
}

/// Writes a row from the filtered columns and the sums of columns, which begin kReach columns to
/// the left of it. `noise` is the square of the threshold times kPixels^2.
void filter_row(const NoiseFilterScratch& scratch, float noise, int width, std::uint8_t* filtered) {
  const Ints d32;
  const hn::Rebind<float, Ints> df32;
  const hn::Rebind<std::uint16_t, Ints> d16;
  const hn::Rebind<std::uint8_t, Ints> d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d32))) {
    const auto column = [&](const Buffer<std::uint16_t>& row, int i) {
      return hn::LoadU(d16, row.data() + x + kReach + i);
    };
    const auto weighted = [&](const Buffer<std::uint16_t>& row) {
      const auto middle = column(row, 0);
      const auto six = hn::Add(hn::ShiftLeft<2>(middle), hn::ShiftLeft<1>(middle));
      return std::pair(six, hn::Add(column(row, -1), column(row, 1)));
    };
    const auto [narrow_six, narrow_near] = weighted(scratch.narrow);
    const auto [wide_six, wide_near] = weighted(scratch.wide);
    const auto far = hn::Add(column(scratch.wide, -2), column(scratch.wide, 2));
    const auto narrow = hn::PromoteTo(d32, hn::Add(narrow_six, narrow_near));  // in 1/64
    const auto wide =
        hn::PromoteTo(d32, hn::Add(hn::Add(far, hn::ShiftLeft<2>(wide_near)), wide_six));
    auto sum = column(scratch.sums, -kReach);
    auto squares = hn::LoadU(d32, scratch.squares.data() + x);
    for (int i = 1; i < kNoiseWindow; ++i) {
      sum = hn::Add(sum, column(scratch.sums, i - kReach));
      squares = hn::Add(squares, hn::LoadU(d32, scratch.squares.data() + x + i));
    }
    const auto total = hn::PromoteTo(d32, sum);
    const auto variance = hn::ConvertTo(
        df32, hn::Sub(hn::Mul(squares, hn::Set(d32, kPixels)), hn::Mul(total, total)));
    // No product is added to anything here, so that every processor rounds alike.
    const auto scaled = hn::Mul(variance, hn::Set(df32, 256.0F));
    const auto all = hn::Max(hn::Add(variance, hn::Set(df32, noise)), hn::Set(df32, 1.0F));
    const auto weight = hn::ConvertTo(d32, hn::Div(scaled, all));
    const auto detail = hn::Sub(hn::ShiftLeft<2>(narrow), wide);
    const auto value = hn::Add(hn::ShiftLeft<8>(wide), hn::Mul(weight, detail));
    const auto rounded = hn::ShiftRight<16>(hn::Add(value, hn::Set(d32, 1 << 15)));
    hn::StoreU(hn::DemoteTo(d8, rounded), d8, filtered + x);
  }
}

/// The columns of three rows with weights 1 6 1, with a border of one column that repeats the
/// outermost ones. Compilers vectorize both loops.
void smooth_columns(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below,
                    int width, std::uint16_t* __restrict__ columns) {
  for (int x = 0; x < width; ++x) {
    columns[x + 1] = static_cast<std::uint16_t>(above[x] + 6 * row[x] + below[x]);
  }
  columns[0] = columns[1];
  columns[width + 1] = columns[width];
}

void smooth_three_columns(const std::uint16_t* columns, int width,
                          std::uint8_t* __restrict__ filtered) {
  for (int x = 0; x < width; ++x) {
    const auto sum =
        static_cast<std::uint16_t>(columns[x] + 6 * columns[x + 1] + columns[x + 2] + 32);
    filtered[x] = static_cast<std::uint8_t>(sum >> 6);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(move_sums);
HWY_EXPORT(filter_columns);
HWY_EXPORT(filter_row);
HWY_EXPORT(smooth_columns);
HWY_EXPORT(smooth_three_columns);

namespace {

constexpr int kReach = kNoiseWindow / 2;
constexpr int kPixels = kNoiseWindow * kNoiseWindow;

void pad_row(const std::uint8_t* row, int width, std::uint8_t* padded) {
  std::memcpy(padded + kReach, row, width);
  std::memset(padded, row[0], kReach);
  std::memset(padded + kReach + width, row[width - 1], kReach);
}

}  // namespace

float noise_threshold(float level) {
  constexpr float kTimes = 3;
  constexpr float kCamera = 0.35F;  // no camera has less noise [gray values]
  constexpr float kCompressed = 40;
  return std::max(kTimes * level, kCompressed * (1 - level / kCamera));
}

float compression_threshold(double visibility) {
  constexpr double kNone = 1.15, kAll = 1.45;
  constexpr double kMost = 6;  // [gray values]
  return static_cast<float>(kMost * std::clamp((visibility - kNone) / (kAll - kNone), 0.0, 1.0));
}

void NoiseFilterScratch::resize(int width, int rows) {
  const int padded = width + 2 * kReach;
  view.resize(padded, rows + 2 * kReach);
  for (Buffer<std::uint16_t>* row : {&narrow, &wide, &sums}) row->resize(padded);
  squares.resize(padded);
  columns.resize(static_cast<std::size_t>(width) + 2);
  no_row.resize(padded);
  std::memset(no_row.data(), 0, padded);
}

void filter_noise(GrayView view, float threshold, int y0, int y1, NoiseFilterScratch& scratch,
                  Image<std::uint8_t>& filtered) {
  const int width = view.width;
  const int padded = width + 2 * kReach;
  const int rows = y1 - y0 + 2 * kReach;
  if (scratch.view.width() < padded || scratch.view.height() < rows) {
    scratch.resize(width, y1 - y0);
  }
  for (int i = 0; i < rows; ++i) {
    pad_row(view.row(std::clamp(y0 - kReach + i, 0, view.height - 1)), width, scratch.view.row(i));
  }
  std::fill_n(scratch.sums.data(), padded, std::uint16_t{0});
  std::fill_n(scratch.squares.data(), padded, 0);
  const float noise = threshold * threshold * (kPixels * kPixels);
  for (int i = 0; i < rows; ++i) {
    const std::uint8_t* out =
        i < kNoiseWindow ? scratch.no_row.data() : scratch.view.row(i - kNoiseWindow);
    HWY_DYNAMIC_DISPATCH(move_sums)(scratch.view.row(i), out, padded, scratch);
    if (i < kNoiseWindow - 1) continue;
    const std::uint8_t* lines[kNoiseWindow];
    for (int k = 0; k < kNoiseWindow; ++k) lines[k] = scratch.view.row(i - kNoiseWindow + 1 + k);
    HWY_DYNAMIC_DISPATCH(filter_columns)(lines, padded, scratch);
    HWY_DYNAMIC_DISPATCH(filter_row)
    (scratch, noise, width, filtered.row(y0 + i - kNoiseWindow + 1));
  }
}

void smooth_lightly(GrayView view, int y0, int y1, NoiseFilterScratch& scratch,
                    Image<std::uint8_t>& filtered) {
  const std::size_t columns = static_cast<std::size_t>(view.width) + 2;
  if (scratch.columns.size() < columns) scratch.columns.resize(columns);
  for (int y = y0; y < y1; ++y) {
    HWY_DYNAMIC_DISPATCH(smooth_columns)
    (view.row(std::max(y - 1, 0)), view.row(y), view.row(std::min(y + 1, view.height - 1)),
     view.width, scratch.columns.data());
    HWY_DYNAMIC_DISPATCH(smooth_three_columns)(scratch.columns.data(), view.width, filtered.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
