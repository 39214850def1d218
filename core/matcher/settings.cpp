// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/settings.hpp"

#include <algorithm>
#include <cstdint>

#include "base/ramp.hpp"
#include "stages/prepare/halving.hpp"

namespace mtstereo {
namespace {

using P = Parameter;

/// A matched pixel of mode semi-dense that the right one contradicts is kept if it agrees with the
/// map of half the resolution up to this [px].
constexpr int kGuidedTolerance = 1;

/// The paths at reduced resolutions, where the step penalties are higher, since surfaces have fewer
/// pixels.
constexpr int kHalvedTolerance = 2;     // of the left-right check [px]
constexpr int kHalvedKernel = 3;        // [px]
constexpr int kHalvedRangePenalty = 2;  // [bits]
constexpr SmoothnessOptions kHalvedSmoothness = {12, 51};

/// What a pixel that the last map knows too needs less than the usual confidence, and what pixels
/// need more that it does not know. With both, a stream has the errors and the density of single
/// frames, and half of their flicker; a lower threshold alone has those of a lower min-confidence.
constexpr int kHeldLess = 20;
int held_more(Mode mode) { return mode == Mode::kSemiDense ? 34 : 19; }

/// In semi-dense, two maps of very noisy views have too many errors in common. From the first noise
/// on the last map counts less, from the second on its points need what they usually do [gray
/// values].
constexpr float kDoubtedNoise = 6.5F;
constexpr float kDistrustedNoise = 9;
int held_less(Mode mode, float noise) {
  if (mode != Mode::kSemiDense) return kHeldLess;
  return static_cast<int>(static_cast<float>(kHeldLess) *
                          ramp(kDistrustedNoise, kDoubtedNoise, noise));
}

/// Converts a percentage to a fraction.
double share(const Parameters& p, Parameter id) { return p.get(id) / 100; }

/// The offset of the peak ratio in the sums of two paths' costs.
int ratio_offset(const Parameters& p) { return 2 * kRatioOffset * p.integer(P::kCensusKernelSize); }

/// At least one, also with parameters that check_frame() refuses.
int view_disparities(const Parameters& p) {
  return std::max(p.integer(P::kMaxDisparity) - p.integer(P::kMinDisparity), 1);
}

/// A stream whose frames choose their resolution begins at the full one.
Resolution first_resolution(const Parameters& p) {
  const Resolution resolution = choice<Resolution>(p);
  return resolution == Resolution::kAuto ? Resolution::kFull : resolution;
}

int matched_disparities(Resolution resolution, int view_disparities) {
  return resolution == Resolution::kFull ? view_disparities : half_of(view_disparities);
}

}  // namespace

Settings::Settings(const Parameters& p)
    : set_(p),
      resolution(first_resolution(p)),
      view_disparities(mtstereo::view_disparities(p)),
      disparities(matched_disparities(resolution, view_disparities)),
      node_confidence(static_cast<float>(share(p, P::kNodeConfidence))),
      search_range{share(p, P::kPixelSearchRange), disparities},
      census_cost{disparities, p.integer(P::kCensusKernelSize), p.integer(P::kRangePenalty)},
      smoothness{p.integer(P::kSmallStepPenalty), p.integer(P::kLargeStepPenalty)},
      selection{disparities,
                share(p, P::kPixelConfidence),
                choice<RunnerUp>(p) == RunnerUp::kExpected,
                p.integer(P::kLeftRightTolerance),
                p.get(P::kSubpixel) != 0,
                ratio_offset(p)} {}

void Settings::match_at(Resolution chosen) {
  resolution = chosen;
  disparities = matched_disparities(chosen, view_disparities);
  search_range.disparities = disparities;
  census_cost.disparities = disparities;
  selection.disparities = disparities;
}

LeastConfidence Settings::least_confidence(float noise) const {
  const int usual = least_reliability();
  const int lowest = keeps_inferred() ? 1 : kMostInferred + 1;
  return {static_cast<std::uint8_t>(usual),
          static_cast<std::uint8_t>(std::max(usual - held_less(mode, noise), lowest)),
          static_cast<std::uint8_t>(std::min(usual + held_more(mode), 255))};
}

PathMatchingOptions Settings::path_matching(int level) const {
  PathMatchingOptions options = {census_cost, smoothness, selection,
                                 infers() ? ColumnPaths::kBoth : ColumnPaths::kNone};
  if (level == 0) {
    if (!infers()) options.selection.guided_margin = kPathReach - kGuidedTolerance;
    return options;
  }
  for (int i = 0; i < level; ++i) {
    options.cost.disparities = half_of(options.cost.disparities);
  }
  options.selection.disparities = options.cost.disparities;
  options.selection.left_right_tolerance = kHalvedTolerance;
  options.cost.kernel_size = kHalvedKernel;
  options.cost.range_penalty = kHalvedRangePenalty;
  options.smoothness = kHalvedSmoothness;
  // Thin posts need other rows, but not those on both sides.
  options.column_paths = infers() ? ColumnPaths::kBoth : ColumnPaths::kFromAbove;
  options.most_rows = kReducedPathRows;
  return options;
}

}  // namespace mtstereo
