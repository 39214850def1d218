// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/view_steps.hpp"

#include <algorithm>

#include "stages/prepare/halving.hpp"
#include "stages/prepare/view_shift.hpp"

namespace mtstereo {
void Views::start(const Settings& settings, GrayView left_view, GrayView right_view) {
  left = left_view;
  borders = {};
  input_noise = noise_level = rated_noise = 0;
  input = {left_view, right_view};
  matched = input;
  if (settings.half()) matched = {halves[0].view(), halves[1].view()};
  plain = matched;
}

void Views::replace_input(int side, GrayView corrected) {
  if (matched[side].data == input[side].data) matched[side] = plain[side] = corrected;
  input[side] = corrected;
}

void Views::release() {
  left = {};
  input = plain = matched = {};
}

void Views::resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused) {
  const auto [width, height] = size.matched;
  if (settings.aligned()) aligned.resize(size.input.width, size.input.height);
  const float blurs[] = {settings.correction.left_blur, settings.correction.right_blur};
  for (int side = 0; side < 2; ++side) {
    if (blurs[side] > 0) blurred[side].resize(size.frame.width, size.frame.height);
    if (settings.min_disparity < 0) extended[side].resize(size.frame.width, size.frame.height);
    if (settings.half()) halves[side].resize(width, height);
    if (settings.noise_filter) {
      noise[side].resize(width, height);
      filtered[side].resize(width, height);
    }
  }
  reused.start_group();  // transform() and match_by_paths()
  for (CensusImage& view : census) {
    if (settings.by_paths()) view.resize(width, height, &reused);
  }
  reused.start_group();  // refine() only
  for (CensusImage& view : input_census) {
    if (settings.refined()) view.resize(size.frame.width, height, &reused);
  }
  scratch.resize(size.threads);
  for (Scratch& worker : scratch) {
    if (settings.aligned()) worker.alignment.resize(size.input.width);
    if (settings.blurred()) worker.blur.resize(size.frame.width);
    if (settings.noise_filter) worker.noise_filter.resize(width, size.matched.band_rows());
    const ImageSize& largest = settings.refined() ? size.frame : size.matched;
    worker.census.resize(largest.width, largest.band_rows());
  }
}

void build_pyramid(const Bands& bands, GrayView view, ViewPyramid& pyramid) {
  for (int i = 0; i < pyramid.count; ++i) {
    Image<std::uint8_t>& half = pyramid.levels[i];
    bands.of_height(half.height()).rows([&](int y0, int y1, int) {
      halve_rows(view, y0, y1, half);
    });
    view = half.view();
  }
}

void align(const StepContext& step, Views& views) {
  step.input_bands.rows([&](int y0, int y1, int worker) {
    align_rows(views.input[1], step.settings.correction.rows, y0, y1,
               views.scratch[worker].alignment, views.aligned);
  });
  views.replace_input(1, views.aligned.view());
}

void match_sharpness(const StepContext& step, Views& views) {
  const ViewCorrection& correction = step.settings.correction;
  const float blurs[] = {correction.left_blur, correction.right_blur};
  for (int side = 0; side < 2; ++side) {
    if (blurs[side] <= 0) continue;
    const BlurKernel kernel = gaussian_kernel(blurs[side]);
    step.input_bands.rows([&](int y0, int y1, int worker) {
      blur_rows(views.input[side], kernel, y0, y1, views.scratch[worker].blur, views.blurred[side]);
    });
    const GrayView sharp = views.plain[side];
    views.replace_input(side, views.blurred[side].view());
    if (side == 0) views.plain[side] = sharp;  // its edges are those of the map
  }
}

void shift_views(const StepContext& step, Views& views) {
  const int least = step.settings.min_disparity;
  if (least > 0) {
    views.replace_input(0, cropped_left(views.input[0], least));
    views.replace_input(1, cropped_right(views.input[1], least));
    return;
  }
  step.input_bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    extend_rows(views.input[side], side == 0 ? -least : 0, side == 0 ? 0 : -least, y0, y1,
                views.extended[side]);
  });
  for (int side = 0; side < 2; ++side) views.replace_input(side, views.extended[side].view());
}

void halve(const StepContext& step, Views& views) {
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    halve_rows(views.input[side], y0, y1, views.halves[side]);
  });
}

void measure_block_borders(const StepContext& step, Views& views) {
  const int side = step.settings.half() ? kHalvedBlockSide : kBlockSide;
  views.borders = step.bands.sum_of_rows(BlockBorders{side}, [&](int y0, int y1) {
    return measure_borders(views.plain[0], side, y0, y1);
  });
}

void measure_contrast(const StepContext& step, Views& views) {
  const GrayHistogram grays = step.bands.sum_of_rows(
      GrayHistogram(), [&](int y0, int y1) { return count_grays(views.plain[0], y0, y1); });
  views.edge = edge_for_range(grays.range());
  views.clipped_from = grays.clipped_from();
}

void filter_views(const StepContext& step, Views& views) {
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    measure_blocks(views.matched[side], y0, y1, views.noise[side]);
  });
  const float levels[] = {noise_level(views.noise[0]), noise_level(views.noise[1])};
  views.noise_level = std::max(levels[0], levels[1]);
  views.rated_noise = std::max(views.noise_level, views.input_noise);
  const float block_threshold = compression_threshold(views.borders.visibility());
  const bool lightly =
      step.settings.by_paths() && block_threshold == 0 && !paths_need_filter(views.noise_level);
  if (lightly && step.settings.infers()) return;
  const float threshold =
      std::max({noise_threshold(levels[0]), noise_threshold(levels[1]), block_threshold});
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    NoiseFilterScratch& scratch = views.scratch[worker].noise_filter;
    if (lightly) {
      smooth_lightly(views.matched[side], y0, y1, scratch, views.filtered[side]);
    } else {
      filter_noise(views.matched[side], threshold, y0, y1, scratch, views.filtered[side]);
    }
  });
  for (int side = 0; side < 2; ++side) views.matched[side] = views.filtered[side].view();
}

void transform(const StepContext& step, Views& views) {
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    census_rows(views.matched[side], step.settings.census_scales, 1, y0, y1,
                views.scratch[worker].census, views.census[side]);
  });
}

void transform_input(const StepContext& step, Views& views) {
  step.input_bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    census_rows(views.input[side], step.settings.census_scales, 2, half_of(y0), half_of(y1),
                views.scratch[worker].census, views.input_census[side]);
  });
}

}  // namespace mtstereo
