// SPDX-License-Identifier: LGPL-2.1-or-later
#include "frame_stages.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "stages/nodes/disparity_drawing.hpp"
#include "stages/prepare/halving.hpp"
#include "stages/refine/enlarging.hpp"
#include "stages/refine/gap_filling.hpp"

namespace mtstereo::bench {
namespace {

// The matcher's own.
constexpr int kBand = 32;
constexpr int kColumns = 64;

template <typename T>
void clear(Image<T>& image) {
  for (int y = 0; y < image.height(); ++y) std::memset(image.row(y), 0, image.width() * sizeof(T));
}

template <typename T>
void copy_to(const cv::Mat& from, Image<T>& to) {
  for (int y = 0; y < to.height(); ++y) {
    std::memcpy(to.row(y), from.ptr(y), to.width() * sizeof(T));
  }
}

}  // namespace

FrameStages::FrameStages(const Parameters& parameters, const Pair& pair)
    : settings_(parameters),
      frame_left_(view_of(pair.left)),
      frame_right_(view_of(pair.right)),
      left_(frame_left_),
      right_(frame_right_),
      width_(settings_.half ? half_of(left_.width) : left_.width),
      height_(settings_.half ? half_of(left_.height) : left_.height),
      steps_(steps_of(settings_)) {
  Matcher matcher = make_matcher(parameters);
  const DisparityView expected = match(matcher, pair);
  size_views();
  size_maps();
  size_frame();
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    before_.push_back(outcome(maps_before(i)));
    ratio_before_.push_back(
        cv::Mat(height_, width_, CV_8UC1, ratio_.row(0), ratio_.stride()).clone());
    (this->*steps_[i].run)();
  }
  before_.push_back(outcome(steps_.back().result));
  require_same("the matcher and the stages one by one", outcome_of(expected, matcher.confidence()),
               before_.back());
}

std::vector<FrameStages::Step> FrameStages::steps_of(const Settings& settings) {
  using S = FrameStages;
  std::vector<Step> steps;
  const auto add = [&](bool on, const char* name, void (S::*run)(), Maps result = Maps::kMatched) {
    if (on) steps.push_back({name, run, result});
  };
  const bool outliers = settings.outlier_radius > 0;
  add(settings.half, "halving", &S::halve);
  add(true, "preprocessing", &S::preprocess);
  add(true, "max-trees", &S::build_trees);
  add(settings.needs_census(), "census", &S::transform);
  add(settings.needs_volume(), "cost-volume", &S::compute_costs);
  add(true, "node-levels", &S::select_levels);
  add(true, "node-matching", &S::match_levels);
  add(outliers, "node-drawing", &S::draw);
  add(outliers, "node-outliers", &S::remove_outliers);
  add(true, "node-extrapolation", &S::extrapolate);
  add(settings.census, "census-matching", &S::match_by_census);
  add(!settings.census, "gradient-matching", &S::match_by_costs);
  add(outliers && settings.pixel_outliers, "pixel-outliers", &S::remove_outliers);
  add(settings.speckle_size > 1, "speckle-removal", &S::remove_speckles);
  add(true, "confidence", &S::rate_confidence);
  add(settings.rim_trim > 0, "rim-trimming", &S::trim_rims);
  add(settings.mode == Mode::kSparse && settings.census && settings.rim_trim > 0, "node-ends",
      &S::keep_node_ends);
  add(settings.max_gap > 0, "gap-filling", &S::fill_gaps);
  add(settings.smoothing_radius > 0, "smoothing", &S::smooth);
  add(settings.half, "enlarging", &S::enlarge, Maps::kEnlarged);
  add(settings.refined, "frame-census", &S::transform_frame, Maps::kEnlarged);
  add(settings.refined, "refinement", &S::refine, Maps::kRefined);
  return steps;
}

std::vector<std::string> FrameStages::names(const Parameters& parameters) {
  std::vector<std::string> names;
  for (const Step& step : steps_of(Settings(parameters))) names.push_back(step.name);
  return names;
}

std::size_t FrameStages::index_of(const std::string& name) const {
  const auto found = std::find_if(steps_.begin(), steps_.end(),
                                  [&](const Step& step) { return step.name == name; });
  if (found == steps_.end()) throw std::runtime_error("there is no stage " + name);
  return static_cast<std::size_t>(found - steps_.begin());
}

void FrameStages::prepare(const std::string& name) {
  const std::size_t step = index_of(name);
  const bool matched = maps_before(step) == Maps::kMatched;
  copy_to(before_[step].disparity, matched ? map_ : enlarged_map_);
  copy_to(before_[step].confidence, matched ? confidence_ : enlarged_confidence_);
  copy_to(ratio_before_[step], ratio_);
}

void FrameStages::run(const std::string& name) { (this->*steps_[index_of(name)].run)(); }

void FrameStages::require_result(const std::string& name) const {
  const std::size_t step = index_of(name);
  require_same("the stage " + name + ", run again", before_[step + 1],
               outcome(steps_[step].result));
}

FrameStages::Maps FrameStages::maps_before(std::size_t step) const {
  return step == 0 ? Maps::kMatched : steps_[step - 1].result;
}

Outcome FrameStages::outcome(Maps maps) const {
  if (maps == Maps::kMatched) return outcome_of(map_.view(), confidence_.view());
  const Image<std::int32_t>& map = maps == Maps::kEnlarged ? enlarged_map_ : refined_map_;
  return outcome_of(map.view(), enlarged_confidence_.view());
}

CensusMatchingOptions FrameStages::census_options() const {
  return {settings_.search_range, settings_.census_cost, settings_.smoothness, settings_.selection};
}

/// Calls body(y0, y1) for the matcher's bands.
template <typename Body>
void FrameStages::for_rows(Body&& body) const {
  for (int y = 0; y < height_; y += kBand) body(y, std::min(y + kBand, height_));
}

void FrameStages::size_views() {
  for (int side = 0; side < 2; ++side) {
    views_[side].resize(width_, height_);
    if (settings_.needs_volume()) views_[side].resize_costs(width_, height_);
    trees_[side].resize(width_, height_);
  }
  levels_.resize(settings_.node_levels.count);
  for (Level& level : levels_) {
    level.left.resize(width_, height_);
    level.right.resize(width_, height_);
    level.intervals.resize(level.left);
    level.matches.resize(level.left);
  }
  if (settings_.needs_volume()) {
    kernel_ = smoothing_kernel(settings_.cost_kernel_size, settings_.cost_shift);
    volume_.resize(width_, height_, settings_.disparities, settings_.cost_shift);
    cost_scratch_.resize(volume_, kernel_);
  }
  sobel_scratch_.resize(width_);
  median_scratch_.resize(width_);
  marks_.resize(width_);
  intervals_scratch_.resize(2 * most_leaves(width_));
  match_scratch_.resize(width_, settings_.disparities, settings_.max_neighbors);
}

void FrameStages::size_maps() {
  if (settings_.outlier_radius > 0) votes_.resize(width_, height_, settings_.outlier_radius);
  ends_.resize(leaves().left);
  map_.resize(width_, height_);
  ratio_.resize(width_, height_);
  clear(ratio_);
  confidence_.resize(width_, height_);
  clear(map_);  // copied before the first stage writes there
  clear(confidence_);
  support_.resize(width_, height_);
  speckles_.resize(width_, height_);
  rim_marks_.resize(width_, height_);
  pixel_scratch_.resize(width_);
  support_scratch_.resize(width_);
  rim_scratch_.resize(width_, settings_.rim_trim);
  columns_.resize(kColumns);
  if (settings_.needs_census()) {
    for (CensusImage& image : census_) image.resize(width_, height_);
    census_rows_scratch_.resize(width_ + 4, std::min(kBand, height_) + 4);
  }
  if (settings_.census) census_scratch_.resize(width_, census_options());
}

void FrameStages::size_frame() {
  if (settings_.smoothing_radius > 0) {
    smoothed_.resize(width_, height_);
    smoothing_scratch_.resize(width_, settings_.smoothing_radius);
  }
  if (settings_.half) {
    for (Image<std::uint8_t>& half : halves_) half.resize(width_, height_);
    left_ = halves_[0].view();
    right_ = halves_[1].view();
    enlarged_map_.resize(frame_left_.width, frame_left_.height);
    enlarged_confidence_.resize(frame_left_.width, frame_left_.height);
  }
  if (settings_.refined) {
    for (CensusImage& image : frame_census_) image.resize(frame_left_.width, frame_left_.height);
    refined_map_.resize(frame_left_.width, frame_left_.height);
    frame_rows_scratch_.resize(frame_left_.width + 4, std::min(2 * kBand, frame_left_.height) + 4);
    refinement_scratch_.resize(frame_left_.width);
  }
}

void FrameStages::halve() {
  for_rows([&](int y0, int y1) {
    halve_rows(frame_left_, y0, y1, halves_[0]);
    halve_rows(frame_right_, y0, y1, halves_[1]);
  });
}

void FrameStages::preprocess() {
  const std::array<GrayView, 2> images = {left_, right_};
  for (int side = 0; side < 2; ++side) {
    PreprocessedView& view = views_[side];
    for_rows(
        [&](int y0, int y1) { median_rows(images[side], y0, y1, median_scratch_, view.median); });
    const GrayView costs_from = settings_.median_in_costs ? view.median.view() : images[side];
    for_rows([&](int y0, int y1) {
      level_rows(settings_.gray_levels, y0, y1, sobel_scratch_, view);
      if (settings_.needs_volume()) cost_rows(costs_from, y0, y1, sobel_scratch_, view);
    });
  }
}

void FrameStages::build_trees() {
  for (int side = 0; side < 2; ++side) {
    for_rows([&](int y0, int y1) { build_max_trees(views_[side].level, y0, y1, trees_[side]); });
  }
}

void FrameStages::compute_costs() {
  const int block = slices_per_block(volume_, kernel_);
  for (int d = 0; d < volume_.disparities; d += block) {
    compute_cost_slices(views_[0], views_[1], kernel_, d, std::min(d + block, volume_.disparities),
                        cost_scratch_, volume_);
  }
}

void FrameStages::select_levels() {
  const WidthRange widths = {1.0 * settings_.min_node_width, settings_.max_node_width * width_};
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    for (int side = 0; side < 2; ++side) {
      NodeLevel& level = side == 0 ? levels_[i].left : levels_[i].right;
      for_rows([&](int y0, int y1) {
        select_nodes(trees_[side], settings_.node_levels.level[i], widths, y0, y1, level);
      });
      for_rows([&](int y0, int y1) { link_neighbors(y0, y1, level); });
    }
  }
}

void FrameStages::match_levels() {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& level = levels_[i];
    for_rows([&](int y0, int y1) {
      if (i == 0) {
        first_intervals(level.left, settings_.disparities, y0, y1, level.intervals);
      } else {
        finer_intervals(level.left, levels_[i - 1].left, levels_[i - 1].matches,
                        settings_.max_neighbors, y0, y1, intervals_scratch_, level.intervals);
      }
    });
    const PairCostInput input = {trees_[0],
                                 trees_[1],
                                 level.left,
                                 level.right,
                                 settings_.node_census ? nullptr : &volume_,
                                 &census_,
                                 settings_.intensity_weight};
    match_nodes(input, level.intervals, settings_.max_neighbors, settings_.node_confidence, 0,
                height_, match_scratch_, level.matches);
  }
}

void FrameStages::draw() {
  for_rows([&](int y0, int y1) { draw_matches(leaves().left, leaves().matches, y0, y1, map_); });
}

void FrameStages::remove_outliers() {
  for_rows([&](int y0, int y1) { copy_votes(map_, y0, y1, votes_); });
  sum_votes(0, votes_.integral.width(), votes_);
  for_rows([&](int y0, int y1) { mtstereo::remove_outliers(votes_, y0, y1, map_); });
}

void FrameStages::extrapolate() {
  const bool whole = settings_.census || settings_.mode != Mode::kSparse;
  const int end_width = whole ? 0 : settings_.node_end_width;
  for_rows([&](int y0, int y1) {
    if (settings_.outlier_radius > 0) {
      read_leaf_ends(leaves().left, map_, y0, y1, ends_);
    } else {
      take_match_ends(leaves().left, leaves().matches, y0, y1, ends_);
    }
  });
  for_rows([&](int y0, int y1) {
    extrapolate_leaves(leaves().left, settings_.max_neighbors, end_width, y0, y1, ends_, map_);
  });
}

void FrameStages::transform() {
  for_rows([&](int y0, int y1) {
    census_rows(left_, y0, y1, census_rows_scratch_, census_[0]);
    census_rows(right_, y0, y1, census_rows_scratch_, census_[1]);
  });
}

void FrameStages::match_by_census() {
  match_pixels_by_census(left_, census_[0], census_[1], census_options(), 0, height_,
                         census_scratch_, map_, ratio_);
}

void FrameStages::match_by_costs() {
  const PixelMatchingOptions options = {settings_.search_range, settings_.selection};
  for_rows([&](int y0, int y1) {
    match_pixels(volume_, options, y0, y1, pixel_scratch_, map_, ratio_);
  });
}

void FrameStages::remove_speckles() {
  for_rows([&](int y0, int y1) { find_runs(map_, kDisparityOne, y0, y1, speckles_); });
  join_bands(map_, kDisparityOne, kBand, speckles_);
  for_rows([&](int y0, int y1) { remove_small(speckles_, settings_.speckle_size, y0, y1, map_); });
}

bool FrameStages::rates_only_ends() const {
  return settings_.mode == Mode::kSparse && settings_.census && settings_.rim_trim == 0;
}

void FrameStages::rate_confidence() {
  for_rows([&](int y0, int y1) {
    copy_support(map_, ratio_, y0, y1, support_);
    if (rates_only_ends()) {
      keep_leaf_ends(leaves().left, ends_, settings_.node_end_width, y0, y1, marks_, map_, ratio_);
    }
  });
  for_rows([&](int y0, int y1) {
    rate_support(support_, ratio_, y0, y1, support_scratch_, confidence_);
    if (settings_.min_confidence > 0) {
      remove_doubtful(settings_.min_confidence, y0, y1, map_, confidence_);
    }
  });
}

void FrameStages::trim_rims() {
  for_rows([&](int y0, int y1) {
    mark_rim(map_, settings_.rim_trim, y0, y1, rim_scratch_, rim_marks_);
  });
  for_rows([&](int y0, int y1) {
    trim_rim(rim_marks_, settings_.rim_trim, y0, y1, rim_scratch_, map_);
    clear_confidence(map_, y0, y1, confidence_);
  });
}

void FrameStages::keep_node_ends() {
  for_rows([&](int y0, int y1) {
    keep_leaf_ends(leaves().left, ends_, settings_.node_end_width, y0, y1, marks_, map_,
                   confidence_);
  });
}

void FrameStages::fill_gaps() {
  for_rows([&](int y0, int y1) {
    fill_gaps_along_rows(settings_.max_gap, kDisparityOne, y0, y1, map_, confidence_);
  });
  for (int x = 0; x < width_; x += kColumns) {
    fill_gaps_along_columns(settings_.max_gap, kDisparityOne, x, std::min(x + kColumns, width_),
                            columns_, map_, confidence_);
  }
}

void FrameStages::smooth() {
  const int radius = settings_.smoothing_radius;
  for_rows([&](int y0, int y1) {
    smooth_along_rows(map_, radius, y0, y1, smoothing_scratch_, smoothed_);
  });
  for_rows([&](int y0, int y1) {
    smooth_along_columns(smoothed_, radius, y0, y1, smoothing_scratch_, map_);
  });
}

void FrameStages::enlarge() {
  for_rows([&](int y0, int y1) {
    const int end = std::min(2 * y1, frame_left_.height);
    enlarge_rows(map_, settings_.max_disparity, 2 * y0, end, enlarged_map_);
    enlarge_confidence(confidence_, 2 * y0, end, enlarged_confidence_);
  });
}

void FrameStages::transform_frame() {
  for_rows([&](int y0, int y1) {
    const int end = std::min(2 * y1, frame_left_.height);
    census_rows(frame_left_, 2 * y0, end, frame_rows_scratch_, frame_census_[0]);
    census_rows(frame_right_, 2 * y0, end, frame_rows_scratch_, frame_census_[1]);
  });
}

void FrameStages::refine() {
  refine_disparities(frame_census_[0], frame_census_[1], enlarged_map_, settings_.max_disparity, 0,
                     frame_left_.height, refinement_scratch_, refined_map_);
}

}  // namespace mtstereo::bench
