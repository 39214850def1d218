// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/official.hpp"

#include <cmath>
#include <string>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/background_fill.hpp"
#include "tools/eval/weighted_mean.hpp"

namespace mtstereo::eval {
namespace {

void require_size_of(const cv::Mat& estimate, const cv::Mat& map, const char* name) {
  if (map.empty() || map.size() == estimate.size()) return;
  throw UserError(std::string("the ") + name + " is " + std::to_string(map.cols) + "x" +
                  std::to_string(map.rows) + ", the disparity map " +
                  std::to_string(estimate.cols) + "x" + std::to_string(estimate.rows));
}

// The maps that are counted, all of one size.
struct Maps {
  Benchmark benchmark;
  const cv::Mat& estimate;
  const cv::Mat& judged;  // the estimate, or for KITTI the filled one
  const cv::Mat& truth;
  const cv::Mat& objects;  // may be empty
  double scale;            // of the truth
};

void count_pixel(const Maps& maps, int y, int x, RegionCounts& region) {
  const double truth = maps.truth.at<float>(y, x);
  const double judged = maps.judged.at<float>(y, x);
  const double error = std::abs(judged - truth) / maps.scale;
  PixelCounts pixel;
  pixel.pixels = 1;
  pixel.wrong = std::isnan(judged) || is_wrong(maps.benchmark, error, truth / maps.scale);
  if (!std::isnan(maps.estimate.at<float>(y, x))) {
    pixel.answered = 1;
    pixel.answered_wrong = pixel.wrong;
    region.error_sum += error;
  }
  region.all += pixel;
  if (maps.objects.empty()) return;
  (maps.objects.at<std::uint8_t>(y, x) == 0 ? region.background : region.foreground) += pixel;
}

// The pixels where `visible` is not 0, or all if it is empty.
RegionCounts count_region(const Maps& maps, const cv::Mat& visible) {
  RegionCounts region;
  for (int y = 0; y < maps.truth.rows; ++y) {
    for (int x = 0; x < maps.truth.cols; ++x) {
      if (std::isnan(maps.truth.at<float>(y, x))) continue;
      if (!visible.empty() && visible.at<std::uint8_t>(y, x) == 0) continue;
      count_pixel(maps, y, x, region);
    }
  }
  return region;
}

OfficialFigures pooled(const std::vector<WeightedCounts>& pairs) {
  RegionCounts sum;
  for (const WeightedCounts& pair : pairs) {
    sum.all += pair.counts->all;
    sum.background += pair.counts->background;
    sum.foreground += pair.counts->foreground;
    sum.error_sum += pair.counts->error_sum;
  }
  return figures_of(sum);
}

}  // namespace

std::optional<Benchmark> benchmark_of(Layout layout) {
  switch (layout) {
    case Layout::kKitti2015:
      return Benchmark::kKitti2015;
    case Layout::kMiddlebury:
      return Benchmark::kMiddlebury;
    case Layout::kEth3d:
      return Benchmark::kEth3d;
    default:
      return std::nullopt;
  }
}

std::string_view benchmark_name(Benchmark benchmark) {
  switch (benchmark) {
    case Benchmark::kMiddlebury:
      return layout_name(Layout::kMiddlebury);
    case Benchmark::kEth3d:
      return layout_name(Layout::kEth3d);
    default:
      return layout_name(Layout::kKitti2015);
  }
}

double wrong_threshold(Benchmark benchmark) {
  switch (benchmark) {
    case Benchmark::kMiddlebury:
      return 2;
    case Benchmark::kEth3d:
      return 1;
    default:
      return 3;
  }
}

bool is_wrong(Benchmark benchmark, double error, double truth) {
  if (!(error > wrong_threshold(benchmark))) return false;
  // 5 % as 20 e > truth: exact at the border, unlike 0.05 * truth.
  return benchmark != Benchmark::kKitti2015 || 20 * error > truth;
}

PixelCounts& PixelCounts::operator+=(const PixelCounts& other) {
  pixels += other.pixels;
  wrong += other.wrong;
  answered += other.answered;
  answered_wrong += other.answered_wrong;
  return *this;
}

std::optional<OfficialCounts> count_official(const cv::Mat& estimate, const StereoPair& pair,
                                             const GroundTruth& truth) {
  const std::optional<Benchmark> benchmark = benchmark_of(pair.layout);
  if (!benchmark) return std::nullopt;
  require_size_of(estimate, truth.disparity, "ground truth");
  require_size_of(estimate, truth.visible, "mask");
  require_size_of(estimate, truth.objects, "object map");
  const bool fill = *benchmark == Benchmark::kKitti2015;
  const cv::Mat judged = fill ? fill_background(estimate) : estimate;
  const Maps maps{*benchmark, estimate, judged, truth.disparity, truth.objects, truth.scale};
  OfficialCounts counts;
  counts.benchmark = *benchmark;
  RegionCounts all = count_region(maps, {});
  if (pair.truth_is_visible) {
    counts.noc = all;
    return counts;
  }
  counts.all = all;
  if (!truth.visible.empty()) counts.noc = count_region(maps, truth.visible);
  return counts;
}

OfficialFigures figures_of(const RegionCounts& counts) {
  const PixelCounts& all = counts.all;
  OfficialFigures figures;
  figures.wrong = percent(all.wrong, all.pixels);
  figures.answered_wrong = percent(all.answered_wrong, all.answered);
  figures.background = percent(counts.background.wrong, counts.background.pixels);
  figures.foreground = percent(counts.foreground.wrong, counts.foreground.pixels);
  if (all.answered > 0) figures.avgerr = counts.error_sum / static_cast<double>(all.answered);
  figures.density = percent(all.answered, all.pixels);
  figures.pixels = all.pixels;
  figures.answered = all.answered;
  return figures;
}

OfficialFigures official_mean(Benchmark benchmark, const std::vector<WeightedCounts>& pairs) {
  if (benchmark == Benchmark::kKitti2015) return pooled(pairs);
  OfficialFigures result;
  WeightedMean wrong, answered_wrong, avgerr, density;
  for (const WeightedCounts& pair : pairs) {
    const OfficialFigures figures = figures_of(*pair.counts);
    wrong.add(figures.wrong, pair.weight);
    answered_wrong.add(figures.answered_wrong, pair.weight);
    avgerr.add(figures.avgerr, pair.weight);
    density.add(figures.density, 1);
    result.pixels += figures.pixels;
    result.answered += figures.answered;
  }
  result.wrong = wrong.value();
  result.answered_wrong = answered_wrong.value();
  result.avgerr = avgerr.value();
  result.density = density.value();
  return result;
}

}  // namespace mtstereo::eval
