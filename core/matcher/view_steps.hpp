// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "matcher/frame_size.hpp"
#include "matcher/step.hpp"
#include "mtstereo/image.hpp"
#include "stages/pixels/smoothness.hpp"
#include "stages/prepare/block_borders.hpp"
#include "stages/prepare/camera_motion.hpp"
#include "stages/prepare/census.hpp"
#include "stages/prepare/contrast.hpp"
#include "stages/prepare/noise_filter.hpp"
#include "stages/prepare/noise_level.hpp"
#include "stages/prepare/row_alignment.hpp"
#include "stages/prepare/view_blur.hpp"

/// The steps that prepare the views, and their memory.

namespace mtstereo {

/// The two views and what is computed from them. All arrays are indexed by Side.
struct Views {
  GrayView left;                    ///< the caller's left view, averaged or not
  std::array<GrayView, 2> input;    ///< the views of this frame: the caller's or corrected ones
  std::array<GrayView, 2> plain;    ///< the input or its halves, the left one not blurred
  std::array<GrayView, 2> matched;  ///< those to match: the same, or filtered
  Image<std::uint8_t> aligned;      ///< the right view with its rows aligned
  std::array<Image<std::uint8_t>, 2> blurred;
  std::array<Image<std::uint8_t>, 2> extended;  ///< with more columns, for negative disparities
  std::array<Image<std::uint8_t>, 2> halves;
  std::array<NoiseBlocks, 2> noise;
  BlockBorders borders;                ///< of the left view; none with nodes
  int clipped_from = kNothingClipped;  ///< the left view's gray values that its camera clipped
  int edge = kUsualEdge;  ///< what counts as an edge in the left view [1 / kEdgeParts gray value]
  float input_noise = 0;  ///< of the noisier view of the caller, if the views are averaged
  float noise_level = 0;  ///< of the noisier view, before it was filtered; 0 without the filter
  float rated_noise = 0;  ///< the same for the confidence: before the views were averaged
  std::array<Image<std::uint8_t>, 2> filtered;  ///< without noise
  std::array<CensusImage, 2> census;            ///< of the matched views
  std::array<CensusImage, 2> input_census;      ///< of the input views' rows for the refinement

  struct Scratch {
    AlignmentScratch alignment;
    BlurScratch blur;
    NoiseFilterScratch noise_filter;
    CensusScratch census;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  /// Begins a frame with the caller's views.
  void start(const Settings& settings, GrayView left_view, GrayView right_view);
  /// Makes a corrected view the input of the later steps.
  void replace_input(int side, GrayView corrected);
  /// Forgets the caller's views, which may be freed after the frame.
  void release();
  void resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused);
};

/// Halves a view repeatedly.
void build_pyramid(const Bands& bands, GrayView view, ViewPyramid& pyramid);

/// Aligns the rows of the right view.
void align(const StepContext& step, Views& views);
/// Blurs the sharper view.
void match_sharpness(const StepContext& step, Views& views);
/// Shifts the views so that the smallest disparity becomes 0 px.
void shift_views(const StepContext& step, Views& views);
/// Halves the views.
void halve(const StepContext& step, Views& views);
/// Measures how clearly the left view shows the blocks of its compression.
void measure_block_borders(const StepContext& step, Views& views);
/// Measures the contrast of the left view.
void measure_contrast(const StepContext& step, Views& views);
/// Filters both views alike, as the noisier one needs it.
void filter_views(const StepContext& step, Views& views);
/// Computes the census transform of the matched views.
void transform(const StepContext& step, Views& views);
/// The same of every other row of the input views, for the refinement.
void transform_input(const StepContext& step, Views& views);

}  // namespace mtstereo
