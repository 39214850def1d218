// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/view_blur.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#define HWY_TARGET_INCLUDE "stages/prepare/view_blur.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Words = hn::CappedTag<std::int16_t, kAlignment / 2>;
using Unsigned = hn::RebindToUnsigned<Words>;
using Bytes = hn::Rebind<std::uint8_t, Words>;

/// Blurs one row along the columns: `out` counts 1/64 gray values. rows[kLargestBlurRadius + i] is
/// the row i below the middle. Reads nothing past the end of the rows, which may be in the caller's
/// image.
void blur_columns(const std::uint8_t* const* rows, const BlurKernel& kernel, int width,
                  std::int16_t* out) {
  const Unsigned du16;
  const std::uint8_t* const* middle = rows + kLargestBlurRadius;
  const auto gray = [&](int i, int x) {
    return hn::PromoteTo(du16, hn::LoadU(Bytes(), middle[i] + x));
  };
  const int step = static_cast<int>(hn::Lanes(du16));
  int x = 0;
  for (; x + step <= width; x += step) {
    auto sum = hn::Add(hn::Set(du16, 2), hn::Mul(gray(0, x), hn::Set(du16, kernel.weights[0])));
    for (int i = 1; i <= kernel.radius; ++i) {
      const auto pair = hn::Add(gray(-i, x), gray(i, x));
      sum = hn::Add(sum, hn::Mul(pair, hn::Set(du16, kernel.weights[i])));
    }
    hn::StoreU(hn::BitCast(Words(), hn::ShiftRight<2>(sum)), Words(), out + x);
  }
  for (; x < width; ++x) {
    int sum = 2 + kernel.weights[0] * middle[0][x];
    for (int i = 1; i <= kernel.radius; ++i) {
      sum += kernel.weights[i] * (middle[-i][x] + middle[i][x]);
    }
    out[x] = static_cast<std::int16_t>(sum >> 2);
  }
}

/// Blurs a row of 1/64 gray values along the row. kernel.radius values before and after the row can
/// be read; one vector after them and after the end of `out` can be accessed.
void blur_row(const std::int16_t* in, const BlurKernel& kernel, int width, std::uint8_t* out) {
  const Words d16;
  const auto weight = [&](int i) {
    return hn::Set(d16, static_cast<std::int16_t>(kernel.weights[i] << 7));
  };
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    auto sum = hn::MulFixedPoint15(hn::LoadU(d16, in + x), weight(0));
    for (int i = 1; i <= kernel.radius; ++i) {
      const auto pair = hn::Add(hn::LoadU(d16, in + x - i), hn::LoadU(d16, in + x + i));
      sum = hn::Add(sum, hn::MulFixedPoint15(pair, weight(i)));
    }
    const auto rounded = hn::ShiftRight<6>(hn::Add(sum, hn::Set(d16, 32)));
    hn::StoreU(hn::DemoteTo(Bytes(), rounded), Bytes(), out + x);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(blur_columns);
HWY_EXPORT(blur_row);

BlurKernel gaussian_kernel(float sigma) {
  BlurKernel kernel;
  constexpr float kSmallest = 0.3F;
  if (!(sigma >= kSmallest)) return kernel;
  kernel.radius = std::min(static_cast<int>(std::ceil(3 * sigma)), kLargestBlurRadius);
  std::array<double, kLargestBlurRadius + 1> gauss{};
  double sum = 0;
  for (int i = 0; i <= kernel.radius; ++i) {
    gauss[i] = std::exp(-i * i / (2.0 * sigma * sigma));
    sum += i == 0 ? gauss[i] : 2 * gauss[i];
  }
  int rest = 256;
  for (int i = 1; i <= kernel.radius; ++i) {
    kernel.weights[i] = static_cast<std::int16_t>(std::lround(256 * gauss[i] / sum));
    rest -= 2 * kernel.weights[i];
  }
  kernel.weights[0] = static_cast<std::int16_t>(rest);
  while (kernel.radius > 0 && kernel.weights[kernel.radius] == 0) --kernel.radius;
  return kernel;
}

void BlurScratch::resize(int width) {
  row.resize(width + 2 * kLargestBlurRadius + kAlignment / sizeof(std::int16_t));
}

void blur_rows(GrayView view, const BlurKernel& kernel, int y0, int y1, BlurScratch& scratch,
               Image<std::uint8_t>& out) {
  if (kernel.radius == 0) {
    for (int y = y0; y < y1; ++y) std::memcpy(out.row(y), view.row(y), view.width);
    return;
  }
  scratch.resize(view.width);
  std::int16_t* row = scratch.row.data() + kLargestBlurRadius;
  std::array<const std::uint8_t*, 2 * kLargestBlurRadius + 1> rows{};
  for (int y = y0; y < y1; ++y) {
    for (int i = -kernel.radius; i <= kernel.radius; ++i) {
      rows[kLargestBlurRadius + i] = view.row(std::clamp(y + i, 0, view.height - 1));
    }
    HWY_DYNAMIC_DISPATCH(blur_columns)(rows.data(), kernel, view.width, row);
    std::fill_n(row - kernel.radius, kernel.radius, row[0]);
    std::fill_n(row + view.width, kernel.radius, row[view.width - 1]);
    HWY_DYNAMIC_DISPATCH(blur_row)(row, kernel, view.width, out.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
