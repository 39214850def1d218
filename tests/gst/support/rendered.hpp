// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "support/images.hpp"
#include "support/stereo_harness.hpp"
#include "tools/render/render.hpp"

namespace mtstereo::test {

/// Size of the rendered pairs [px].
inline constexpr int kRenderedWidth = 480;
inline constexpr int kRenderedHeight = 270;

/// Settings of the renderer for this size, with `rig` as error of the right camera.
render::Settings rendered_settings(const render::Rig& rig = {});

/// Pairs of a built-in scene, one every `step` seconds from time 0.
std::vector<Pair> rendered_pairs(const std::string& scene, int count, double step = 0.1,
                                 const render::Settings& settings = rendered_settings());

/// Gray images of both views.
Pair pair_of(const cv::Mat& left, const cv::Mat& right);

/// The pair with the left view as right view.
Pair swapped(const Pair& pair);

/// The image blurred by a Gaussian [px].
GrayImage blurred(const GrayImage& image, double sigma);

/// Pushes the pairs from `first` on and returns their disparity maps, row by row.
std::vector<std::vector<std::uint16_t>> match_all(StereoHarness& harness,
                                                  const std::vector<Pair>& pairs,
                                                  GstClockTime first = 0);

/// The value of a field of a structure; 0 and a failure if there is none.
double number_of(const GstStructure* structure, const char* field);

/// The property `stats`.
StructurePointer stats_structure(GstElement* element);

/// The property `alignment-field`.
std::string field_text(GstElement* element);

/// Share of pixels with a disparity.
double density_of(const std::vector<std::uint16_t>& map);

}  // namespace mtstereo::test
