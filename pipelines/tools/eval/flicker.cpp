// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/flicker.hpp"

#include <cmath>
#include <functional>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/degrade.hpp"
#include "tools/eval/moving_edges.hpp"

namespace mtstereo::eval {
namespace {

// The disparities of one pixel in all maps.
struct PixelSum {
  int estimates = 0;
  double sum = 0;
  double squares = 0;
};

PixelSum sum_of(const std::vector<cv::Mat>& maps, int y, int x) {
  PixelSum pixel;
  for (const cv::Mat& map : maps) {
    const double value = map.at<float>(y, x);
    if (std::isnan(value)) continue;
    ++pixel.estimates;
    pixel.sum += value;
    pixel.squares += value * value;
  }
  return pixel;
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : kNone; }

// The mean of the figures that are known.
template <typename List, typename Figure>
double mean_of(const List& list, Figure figure) {
  double sum = 0, count = 0;
  for (const auto& each : list) {
    const double value = std::invoke(figure, each);
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return ratio(sum, count);
}

}  // namespace

Flicker measure_flicker(const std::vector<cv::Mat>& maps) {
  if (maps.size() < 2) throw UserError("flicker needs at least two disparity maps");
  for (const cv::Mat& map : maps) {
    if (map.size() != maps[0].size()) throw UserError("disparity maps have different sizes");
  }
  const auto count = static_cast<double>(maps.size());
  double estimates = 0, any = 0, all = 0, deviations = 0;
  for (int y = 0; y < maps[0].rows; ++y) {
    for (int x = 0; x < maps[0].cols; ++x) {
      const PixelSum pixel = sum_of(maps, y, x);
      estimates += pixel.estimates;
      any += pixel.estimates > 0 ? 1 : 0;
      if (pixel.estimates < static_cast<int>(maps.size())) continue;
      const double mean = pixel.sum / count;
      all += 1;
      deviations += std::sqrt(std::max(0.0, pixel.squares / count - mean * mean));
    }
  }
  return {100 * ratio(estimates / count, static_cast<double>(maps[0].total())),
          100 * ratio(any - all, any), ratio(deviations, all)};
}

void FlickerWindow::add(const cv::Mat& map, const GroundTruth& truth) {
  maps_.push_back(map);
  metrics_.push_back(evaluate(map, truth).all);
  edges_ = wrong_at_edges(map, truth.disparity, truth.scale);
  if (maps_.size() <= kFlickerFrames) return;
  maps_.pop_front();
  metrics_.pop_front();
}

std::optional<Flicker> FlickerWindow::measure() const {
  if (maps_.size() < kFlickerFrames) return std::nullopt;
  Flicker flicker = measure_flicker({maps_.begin(), maps_.end()});
  flicker.d_all = mean_of(metrics_, &Metrics::d_all);
  flicker.avgerr = mean_of(metrics_, &Metrics::avgerr);
  flicker.edges = edges_;
  return flicker;
}

Flicker mean(const std::vector<Flicker>& list) {
  Flicker result;
  for (double Flicker::*figure : {&Flicker::density, &Flicker::come_and_go, &Flicker::spread,
                                  &Flicker::d_all, &Flicker::avgerr, &Flicker::edges}) {
    result.*figure = mean_of(list, figure);
  }
  return result;
}

void add_flicker_noise(double sigma, int frame, cv::Mat& left, cv::Mat& right) {
  const auto seed = 2 * static_cast<std::uint64_t>(frame) + 1;
  add_noise(sigma, seed, left);
  add_noise(sigma, seed + 1, right);
}

}  // namespace mtstereo::eval
