// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/holding.hpp"

#include <algorithm>
#include <cstdlib>

#include "mtstereo/parameters.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/holding.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Floats = hn::CappedTag<float, HeldPlaces::kMost>;
using Vec = hn::Vec<Floats>;
using Ints = hn::RebindToSigned<Floats>;

/// The nearest whole numbers from `least`, which is negative, to `most`.
HWY_INLINE hn::Vec<Ints> nearest(Vec values, int least, int most) {
  const Floats d;
  const Vec limited = hn::Min(values, hn::Set(d, static_cast<float>(most)));
  const Vec from_least = hn::Sub(limited, hn::Set(d, static_cast<float>(least)));
  const Vec rounded = hn::Add(hn::Max(from_least, hn::Zero(d)), hn::Set(d, 0.5F));
  return hn::Add(hn::ConvertTo(Ints(), rounded), hn::Set(Ints(), least));
}

/// Whether the values are 0 .. end - 1.
HWY_INLINE hn::Mask<Ints> is_below(hn::Vec<Ints> values, int end) {
  const Ints di;
  return hn::And(hn::Gt(values, hn::Set(di, -1)), hn::Lt(values, hn::Set(di, end)));
}

/// CameraMotion::moved() for a vector of points.
struct Points {
  Vec x, y, disparity;
};
HWY_INLINE Points last_places(const CameraMotion& motion, const Points& now) {
  const Floats d;
  const auto times = [&](float factor, Vec values) { return hn::Mul(hn::Set(d, factor), values); };
  const Vec far = hn::Sub(hn::Set(d, 1), times(motion.approach, now.disparity));
  const Vec depth = hn::Sub(hn::Sub(far, times(motion.turn_x, now.x)), times(motion.turn_y, now.y));
  const Vec growth = hn::Div(hn::Set(d, 1), hn::Max(depth, hn::Set(d, CameraMotion::kLeastDepth)));
  const Vec x =
      hn::Sub(hn::Add(hn::Add(now.x, hn::Set(d, motion.shift_x)), times(motion.roll, now.y)),
              times(motion.parallax_x, now.disparity));
  const Vec y =
      hn::Sub(hn::Sub(hn::Add(now.y, hn::Set(d, motion.shift_y)), times(motion.roll, now.x)),
              times(motion.parallax_y, now.disparity));
  return {hn::Mul(x, growth), hn::Mul(y, growth), hn::Mul(now.disparity, growth)};
}

/// Finds the places of the disparities of a row from the column x on.
void find_places(const CameraMotion& motion, float offset, const Image<std::int32_t>& map, int x,
                 int y, std::ptrdiff_t stride, HeldPlaces& places) {
  constexpr float kOne = 1.0F / kDisparityOne;
  constexpr int kNone = -2 * kHeldTolerance;  // equals no disparity
  const Floats d;
  const Ints di;
  const int width = map.width(), height = map.height();
  const Vec center_x = hn::Set(d, static_cast<float>(width) / 2);
  const Vec center_y = hn::Set(d, static_cast<float>(height) / 2);
  const Vec zero = hn::Set(d, offset);
  const Vec row = hn::Sub(hn::Set(d, static_cast<float>(y)), center_y);
  const int count = std::min(width - x, HeldPlaces::kMost);
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const Vec column = hn::ConvertTo(d, hn::Iota(di, x + i));
    const Vec disparity = hn::ConvertTo(d, hn::LoadU(di, map.row(y) + x + i));
    const Points last = last_places(motion, {hn::Sub(column, center_x), row,
                                             hn::Add(hn::Mul(disparity, hn::Set(d, kOne)), zero)});
    const auto last_x = nearest(hn::Add(last.x, center_x), -1, width);
    const auto last_y = nearest(hn::Add(last.y, center_y), -1, height);
    const auto inside = hn::And(is_below(last_x, width), is_below(last_y, height));
    const auto line = hn::Mul(last_y, hn::Set(di, static_cast<std::int32_t>(stride)));
    hn::Store(hn::IfThenElse(inside, hn::Add(line, last_x), hn::Set(di, HeldPlaces::kOutside)), di,
              &places.index[i]);
    const Vec steps = hn::Mul(hn::Sub(last.disparity, zero), hn::Set(d, kHeldOne));
    hn::Store(nearest(steps, kNone, 65535), di, &places.disparity[i]);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {
HWY_EXPORT(find_places);
namespace {

/// Stands for a disparity that no pixel has.
constexpr int kDecidesNothing = 1 << 20;

constexpr int kSteps = kDisparityOne / kHeldOne;
static_assert(kLargestMaxDisparity * kHeldOne <= 65535);

/// In 1 / kHeldOne px. Unknown stays 0, and no known disparity becomes it.
int in_steps(std::int32_t disparity) {
  return std::max((disparity + kSteps / 2) / kSteps, std::min(disparity, 1));
}

}  // namespace

void threshold_by_last(const LeastConfidence& least, const CameraMotion& motion, float offset,
                       const Image<std::uint16_t>& last, int y0, int y1, Image<std::int32_t>& map,
                       Image<std::uint8_t>& confidence) {
  HeldPlaces places;
  const std::uint16_t* known = last.row(0);
  for (int y = y0; y < y1; ++y) {
    for (int x = 0; x < map.width(); x += HeldPlaces::kMost) {
      HWY_DYNAMIC_DISPATCH(find_places)(motion, offset, map, x, y, last.stride(), places);
      const int count = std::min(map.width() - x, HeldPlaces::kMost);
      std::int32_t* __restrict__ disparity = map.row(y) + x;
      std::uint8_t* __restrict__ rating = confidence.row(y) + x;
      for (int i = 0; i < count; ++i) {
        const bool outside = places.index[i] == HeldPlaces::kOutside;
        const int before = outside ? kDecidesNothing : known[places.index[i]];
        const bool same = std::abs(before - places.disparity[i]) <= kHeldTolerance;
        const int needed = before == 0 ? least.fresh : same ? least.known : least.usual;
        const bool kept = rating[i] >= needed;
        disparity[i] = kept ? disparity[i] : kNoDisparity;
        rating[i] = kept ? rating[i] : std::uint8_t{0};
      }
    }
  }
}

void copy_last(const Image<std::int32_t>& map, int y0, int y1, Image<std::uint16_t>& last) {
  for (int y = y0; y < y1; ++y) {
    const std::int32_t* __restrict__ from = map.row(y);
    std::uint16_t* __restrict__ to = last.row(y);
    for (int x = 0; x < map.width(); ++x) to[x] = static_cast<std::uint16_t>(in_steps(from[x]));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
