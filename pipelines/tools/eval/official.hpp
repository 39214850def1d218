// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/eval/datasets.hpp"
#include "tools/eval/metrics.hpp"

namespace mtstereo::eval {

/// The benchmarks whose own measures --official computes.
enum class Benchmark { kKitti2015, kMiddlebury, kEth3d };

inline constexpr std::array<Benchmark, 3> kBenchmarks{Benchmark::kKitti2015, Benchmark::kMiddlebury,
                                                      Benchmark::kEth3d};

/// The benchmark of a data set; none if it has no official measures here.
std::optional<Benchmark> benchmark_of(Layout layout);

/// Its name, that of its layout.
std::string_view benchmark_name(Benchmark benchmark);

/// An estimate is wrong if its error is larger than this [px].
double wrong_threshold(Benchmark benchmark);

/// Whether the benchmark counts this error [px] at this true disparity [px] as wrong. KITTI also
/// wants it to be larger than 5 % of the truth.
bool is_wrong(Benchmark benchmark, double error, double truth);

/// Pixels with ground truth.
struct PixelCounts {
  std::int64_t pixels = 0;          ///< all of them
  std::int64_t wrong = 0;           ///< the wrong ones, see RegionCounts
  std::int64_t answered = 0;        ///< those with an estimate
  std::int64_t answered_wrong = 0;  ///< the wrong ones of those

  PixelCounts& operator+=(const PixelCounts& other);
};

/// The counts of a region. Where the map has no estimate, KITTI judges what fill_background() puts
/// there; Middlebury and ETH3D count such a pixel as wrong here.
struct RegionCounts {
  PixelCounts all;
  PixelCounts background, foreground;  ///< KITTI with an object map, else without pixels
  double error_sum = 0;                ///< of the pixels with an estimate [px]
};

/// The counts of one map.
struct OfficialCounts {
  Benchmark benchmark = Benchmark::kKitti2015;
  std::optional<RegionCounts> all;  ///< none if the truth has only pixels visible in both views
  std::optional<RegionCounts> noc;  ///< those visible in both views; none if they are unknown
};

/// Counts as the benchmark of the pair does; none if it has no official measures here. Throws
/// UserError if the sizes differ.
std::optional<OfficialCounts> count_official(const cv::Mat& estimate, const StereoPair& pair,
                                             const GroundTruth& truth);

/// The figures of a region; NaN without such pixels.
struct OfficialFigures {
  double wrong = kNone;           ///< D1-all or bad t [%]
  double answered_wrong = kNone;  ///< the same of the pixels with an estimate [%]
  double background = kNone;      ///< D1-bg [%]
  double foreground = kNone;      ///< D1-fg [%]
  double avgerr = kNone;          ///< mean error of the pixels with an estimate [px]
  double density = kNone;         ///< pixels with an estimate / pixels with ground truth [%]
  std::int64_t pixels = 0;        ///< with ground truth
  std::int64_t answered = 0;      ///< with an estimate too
};

OfficialFigures figures_of(const RegionCounts& counts);

/// The counts of a pair and its weight in the mean.
struct WeightedCounts {
  const RegionCounts* counts = nullptr;
  double weight = 1;
};

/// The figures of several pairs: KITTI's are those of all pixels together, the others are means
/// over the pairs, weighted except for the density.
OfficialFigures official_mean(Benchmark benchmark, const std::vector<WeightedCounts>& pairs);

}  // namespace mtstereo::eval
