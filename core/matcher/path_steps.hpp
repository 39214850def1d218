// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/frame_memory.hpp"
#include "matcher/steps.hpp"

/// Internal to the list of steps: those with guide=pyramid, which match along paths without nodes.

namespace mtstereo {

/// Matches the views at the reduced resolutions, coarse to fine. Each map is the expectation of the
/// next one.
void match_reduced(const StepContext& step, Views& views, Pyramid& pyramid);

/// Chooses the disparities at which the pixels are matched at the matched resolution.
void choose_search_windows(const StepContext& step, Pyramid& pyramid);

/// Matches the views at the matched resolution.
void match_by_paths(const StepContext& step, const Views& views, Pyramid& pyramid, Maps& maps);

/// Completes the map of half the matched resolution, which has guided the matching, and finds how
/// far its pixels support each other.
void support_guide(const StepContext& step, Pyramid& pyramid, Maps& maps);

/// What the clues of that map's reliability are about; `views` and `pyramid` must exist as long.
RatedViews rated_guide_views(const Views& views, const Pyramid& pyramid);

/// Replaces the confidence of that map by its reliability.
void rate_guide(const StepContext& step, const Views& views, Pyramid& pyramid,
                Completion& completion);

/// Gives the remaining pixels of the result a disparity.
void complete_map(const StepContext& step, Maps& maps, EnlargedMaps& enlarged, OutputMaps& output);

/// Moves jumps of the complete result to the edges of the left view.
void align_map_edges(const StepContext& step, const Views& views, Maps& maps,
                     EnlargedMaps& enlarged, OutputMaps& output, Completion& completion);

/// What the clues of the reliability are about; `views` and `pyramid` must exist as long.
RatedViews rated_views(const Settings& settings, const Views& views, const Pyramid& pyramid);

/// Replaces the confidence of the complete result by its reliability.
void rate_map(const StepContext& step, const Views& views, const Pyramid& pyramid, Maps& maps,
              EnlargedMaps& enlarged, OutputMaps& output, Completion& completion);

/// Corrects what the right camera may not see at the left of the complete, rated result.
void correct_strip(const StepContext& step, Maps& maps, EnlargedMaps& enlarged, OutputMaps& output);

/// Removes what is less reliable than asked for from the result, and small islands that are left.
void reject_unlikely(const StepContext& step, Maps& maps, EnlargedMaps& enlarged,
                     OutputMaps& output, Completion& completion);

/// Fills small gaps that the rejection has left in a surface.
void close_gaps(const StepContext& step, Maps& maps, EnlargedMaps& enlarged, OutputMaps& output);

}  // namespace mtstereo
