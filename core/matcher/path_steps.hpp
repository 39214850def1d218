// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "matcher/map_steps.hpp"
#include "matcher/rating.hpp"
#include "matcher/view_steps.hpp"
#include "stages/pixels/gray_balance.hpp"
#include "stages/pixels/path_matching.hpp"
#include "stages/pixels/search_windows.hpp"
#include "stages/prepare/census.hpp"
#include "stages/refine/confidence.hpp"

/// The steps that match along paths, coarse to fine, and their memory.

namespace mtstereo {

/// Number of reduced resolutions: 1/2, 1/4 and 1/8.
inline constexpr int kPyramidLevels = 3;

/// The views at 1 / 2^level of the matched resolution, and their disparity map.
struct PyramidLevel {
  std::array<Image<std::uint8_t>, 2> views;
  std::array<CensusImage, 2> census;
  Image<std::int32_t> disparity;
  Image<std::uint8_t> ratio;
};

struct Pyramid {
  std::array<PyramidLevel, kPyramidLevels> levels;  ///< fine to coarse, from 1/2 on
  WindowVotes votes;                                ///< of the level of 1/2
  SearchWindows windows;                            ///< of full resolution
  Image<std::uint8_t> agreement;                    ///< a pixel for each tile of the votes
  GrayBalance balance;                              ///< of the level of 1/2
  SupportMap support;                               ///< of that level
  Image<std::uint8_t> confidence;                   ///< of that level
  Rating rating;                                    ///< of that level

  struct Scratch {
    CensusScratch census;
    PathMatchingScratch matching;
    SupportScratch support;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused);
};

/// Matches the views at the reduced resolutions, coarse to fine. Each map is the expectation of the
/// next one.
void match_reduced(const StepContext& step, const Views& views, Pyramid& pyramid);

/// Chooses the disparities at which the pixels are matched at the matched resolution.
void choose_search_windows(const StepContext& step, Pyramid& pyramid);

/// Finds how much brighter the left view is than the right one.
void balance_grays(const StepContext& step, Pyramid& pyramid);

/// Matches the views at the matched resolution.
void match_by_paths(const StepContext& step, const Views& views, Pyramid& pyramid, Maps& maps);

/// Completes the map of half the matched resolution, which has guided the matching, and finds how
/// far its pixels support each other.
void support_guide(const StepContext& step, Pyramid& pyramid);

/// What the clues of that map's reliability are about; `views` and `pyramid` must outlive it.
RatedViews rated_guide_views(const Views& views, const Pyramid& pyramid);

/// Replaces the confidence of that map by its reliability.
void rate_guide(const StepContext& step, const Views& views, Pyramid& pyramid);

}  // namespace mtstereo
