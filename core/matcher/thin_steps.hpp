// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/steps.hpp"

/// Internal to the list of steps: the steps that keep thin objects.

namespace mtstereo {

/// Finds thin objects in the map of the matching and keeps a copy of that map.
void find_thin_objects(const StepContext& step, const Views& views, Maps& maps);

/// Gives the pixels of thin objects that the filters have removed their disparities back.
void restore_thin_objects(const StepContext& step, Maps& maps);

/// Removes filled pixels where the matching had seen something nearer.
void guard_gaps(const StepContext& step, Maps& maps);

/// Draws the thin objects into the complete result.
void draw_thin(const StepContext& step, Maps& maps, EnlargedMaps& enlarged, OutputMaps& output);

}  // namespace mtstereo
