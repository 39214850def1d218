// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/noise_level.hpp"

#include <algorithm>

#define HWY_TARGET_INCLUDE "stages/prepare/noise_level.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// A block is two vectors wide. The magnitudes, up to 8 * 255, of a lane's 16 pixels add up to 16
/// bits.
using Words = hn::CappedTag<std::int16_t, 8>;

/// The detail of the block whose first pixel is `first`, or kSaturatedBlock.
std::uint32_t measure_block(const std::uint8_t* first, std::ptrdiff_t stride) {
  const Words d16;
  const hn::Rebind<std::uint8_t, Words> d8;
  const hn::RebindToUnsigned<Words> du16;
  constexpr int kSaturatedPixels = 4;
  auto sums = hn::Zero(du16);
  auto saturated = hn::Zero(d16);
  for (int y = 0; y < kNoiseBlock; y += kNoiseRowStep) {
    for (int x = 0; x < kNoiseBlock; x += static_cast<int>(hn::Lanes(d16))) {
      const std::uint8_t* at = first + y * stride + x;
      const auto row = [&](int column) {
        const auto gray = [&](int line) {
          return hn::PromoteTo(d16, hn::LoadU(d8, at + line * stride + column));
        };
        return hn::Sub(hn::Add(gray(-1), gray(1)), hn::Add(gray(0), gray(0)));
      };
      const auto middle = row(0);
      const auto value = hn::Sub(hn::Add(row(-1), row(1)), hn::Add(middle, middle));
      sums = hn::Add(sums, hn::BitCast(du16, hn::Abs(value)));
      const auto pixel = hn::PromoteTo(d16, hn::LoadU(d8, at));
      const auto extreme = hn::Or(hn::Lt(pixel, hn::Set(d16, 2)), hn::Gt(pixel, hn::Set(d16, 253)));
      saturated = hn::Sub(saturated, hn::VecFromMask(d16, extreme));
    }
  }
  std::uint16_t sum[hn::MaxLanes(du16)];
  std::int16_t count[hn::MaxLanes(d16)];
  hn::StoreU(sums, du16, sum);
  hn::StoreU(saturated, d16, count);
  std::uint32_t detail = 0;
  int extremes = 0;
  for (std::size_t i = 0; i < hn::Lanes(d16); ++i) {
    detail += sum[i];
    extremes += count[i];
  }
  return extremes > kSaturatedPixels ? kSaturatedBlock : detail;
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(measure_block);

void NoiseBlocks::resize(int width, int height) {
  columns = std::max(width - 2, 0) / kNoiseBlock;
  rows = std::max(height - 2, 0) / kNoiseBlock;
  detail.resize(static_cast<std::size_t>(columns) * rows);
  sorted.resize(static_cast<std::size_t>(columns) * rows);
}

void measure_blocks(GrayView view, int y0, int y1, NoiseBlocks& blocks) {
  const int first = (y0 + kNoiseBlock - 1) / kNoiseBlock;
  const int end = std::min((y1 + kNoiseBlock - 1) / kNoiseBlock, blocks.rows);
  for (int row = first; row < end; ++row) {
    const std::uint8_t* line = view.row(row * kNoiseBlock + 1) + 1;
    std::uint32_t* detail =
        blocks.detail.data() + static_cast<std::ptrdiff_t>(row) * blocks.columns;
    for (int i = 0; i < blocks.columns; ++i) {
      detail[i] = HWY_DYNAMIC_DISPATCH(measure_block)(line + i * kNoiseBlock, view.stride);
    }
  }
}

float noise_level(NoiseBlocks& blocks) {
  std::uint32_t* const begin = blocks.sorted.data();
  std::uint32_t* const end =
      std::copy_if(blocks.detail.data(), blocks.detail.data() + blocks.detail.size(), begin,
                   [](std::uint32_t detail) { return detail != kSaturatedBlock; });
  if (begin == end) return 0;
  std::uint32_t* const quartile = begin + (end - begin - 1) / 4;
  std::nth_element(begin, quartile, end);
  // The operator multiplies the deviation of white noise by 6. The mean magnitude of a normal
  // distribution is its deviation times the square root of 2 / pi.
  constexpr float kDeviation = 1.2533141F / 6;
  constexpr int kPixels = kNoiseBlock * kNoiseBlock / kNoiseRowStep;
  return static_cast<float>(*quartile) * (kDeviation / static_cast<float>(kPixels));
}

}  // namespace mtstereo
#endif  // HWY_ONCE
