// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "tools/eval/datasets.hpp"
#include "tools/eval/metrics.hpp"
#include "tools/render/settings.hpp"

namespace mtstereo::tests {

/// The folder of the real pairs with ground truth, which MTSTEREO_TEST_DATA names; empty if there
/// is none.
std::string data_folder();

/// The ten pairs in this folder on which most parameters were chosen.
std::vector<eval::StereoPair> ten_pairs(const std::string& folder);

/// The 17 further pairs in its folder `more`.
std::vector<eval::StereoPair> further_pairs(const std::string& folder);

/// The settings of the pairs of a rendered scene: 480x270 px, with disparities below 64 px.
render::Settings rendered_settings(const std::string& scene);

/// A pair of a rendered scene, which is rendered once.
const eval::LoadedPair& rendered_pair(const std::string& scene, double time);

/// The unweighted mean.
eval::Evaluation mean_of(const std::vector<eval::Evaluation>& evaluations);

/// Matches a pair by the element with these properties and evaluates its disparity. The test fails
/// if the element gives none.
eval::Evaluation evaluate_with_element(const eval::LoadedPair& pair, const std::string& properties,
                                       int max_disparity);

}  // namespace mtstereo::tests
