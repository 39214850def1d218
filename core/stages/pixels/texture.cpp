// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/texture.hpp"

#include <algorithm>
#include <cstring>

#define HWY_TARGET_INCLUDE "stages/pixels/texture.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Bits = hn::CappedTag<std::uint32_t, kAlignment / 4>;

/// The bits of each column of the window, and then of the whole window.
void exclude_row(const std::uint32_t* const* lines, int width, std::uint32_t* columns,
                 std::uint16_t* low, std::uint16_t* high) {
  constexpr int kReach = kTextureWindow / 2;
  const Bits d32;
  const hn::RebindToSigned<Bits> di32;
  const hn::Rebind<std::uint16_t, Bits> d16;
  const hn::Rebind<std::int16_t, Bits> di16;
  const int step = static_cast<int>(hn::Lanes(d32));
  for (int x = 0; x < width; x += step) {
    auto bits = hn::LoadU(d32, lines[0] + x);
    for (int i = 1; i < kTextureWindow; ++i) bits = hn::Or(bits, hn::LoadU(d32, lines[i] + x));
    hn::StoreU(bits, d32, columns + kReach + x);
  }
  std::memset(columns, 0, kReach * sizeof(*columns));
  std::memset(columns + kReach + width, 0, kReach * sizeof(*columns));
  for (int x = 0; x < width; x += step) {
    auto bits = hn::LoadU(d32, columns + x);
    for (int i = 1; i < kTextureWindow; ++i) bits = hn::Or(bits, hn::LoadU(d32, columns + x + i));
    const auto none = hn::VecFromMask(d32, hn::Eq(bits, hn::Zero(d32)));
    const auto narrow = hn::DemoteTo(di16, hn::BitCast(di32, none));
    const auto flat = hn::RebindMask(d16, hn::Lt(narrow, hn::Zero(di16)));
    hn::StoreU(hn::IfThenElse(flat, hn::Set(d16, 1), hn::LoadU(d16, low + x)), d16, low + x);
    hn::StoreU(hn::IfThenZeroElse(flat, hn::LoadU(d16, high + x)), d16, high + x);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(exclude_row);

void TextureScratch::resize(int width) { columns.resize(width + kTextureWindow + kAlignment); }

void exclude_flat(const CensusImage& census, int y, TextureScratch& scratch, std::uint16_t* low,
                  std::uint16_t* high) {
  const std::uint32_t* lines[kTextureWindow];
  for (int i = 0; i < kTextureWindow; ++i) {
    lines[i] = census.bits.row(std::clamp(y + i - kTextureWindow / 2, 0, census.bits.height() - 1));
  }
  HWY_DYNAMIC_DISPATCH(exclude_row)(lines, census.bits.width(), scratch.columns.data(), low, high);
}

}  // namespace mtstereo
#endif  // HWY_ONCE
