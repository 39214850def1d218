// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/flicker.hpp"

#include <cmath>
#include <functional>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/degrade.hpp"

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

void measure_tepe(const std::vector<cv::Mat>& errors, Flicker& flicker) {
  double count = 0, sum = 0, above1 = 0, above3 = 0;
  for (std::size_t i = 1; i < errors.size(); ++i) {
    for (int y = 0; y < errors[i].rows; ++y) {
      for (int x = 0; x < errors[i].cols; ++x) {
        const double error = std::abs(errors[i].at<float>(y, x) - errors[i - 1].at<float>(y, x));
        if (std::isnan(error)) continue;
        count += 1;
        sum += error;
        above1 += error > 1 ? 1 : 0;
        above3 += error > 3 ? 1 : 0;
      }
    }
  }
  flicker.tepe = ratio(sum, count);
  flicker.tepe1 = 100 * ratio(above1, count);
  flicker.tepe3 = 100 * ratio(above3, count);
}

void FlickerWindow::add(const cv::Mat& map, const GroundTruth& truth) {
  maps_.push_back(map);
  metrics_.push_back(evaluate(map, truth).all);
  errors_.push_back((map - truth.disparity) / truth.scale);
  truths_.push_back(truth.disparity);
  scale_ = truth.scale;
  if (maps_.size() <= kFlickerFrames) return;
  maps_.pop_front();
  metrics_.pop_front();
  errors_.pop_front();
  truths_.pop_front();
}

std::optional<Flicker> FlickerWindow::measure() const {
  if (maps_.size() < kFlickerFrames) return std::nullopt;
  Flicker flicker = measure_flicker({maps_.begin(), maps_.end()});
  flicker.d_all = mean_of(metrics_, &Metrics::d_all);
  flicker.avgerr = mean_of(metrics_, &Metrics::avgerr);
  measure_tepe({errors_.begin(), errors_.end()}, flicker);
  flicker.edges = measure_edges(maps_.back(), {truths_.begin(), truths_.end()}, scale_);
  return flicker;
}

Flicker mean(const std::vector<Flicker>& list) {
  Flicker result;
  for (double Flicker::*figure :
       {&Flicker::density, &Flicker::come_and_go, &Flicker::spread, &Flicker::d_all,
        &Flicker::avgerr, &Flicker::tepe, &Flicker::tepe1, &Flicker::tepe3}) {
    result.*figure = mean_of(list, figure);
  }
  for (double EdgeErrors::*figure : {&EdgeErrors::wrong, &EdgeErrors::stale, &EdgeErrors::age}) {
    result.edges.*figure =
        mean_of(list, [figure](const Flicker& each) { return each.edges.*figure; });
  }
  return result;
}

void add_flicker_noise(double sigma, int frame, cv::Mat& left, cv::Mat& right) {
  const auto seed = 2 * static_cast<std::uint64_t>(frame) + 1;
  add_noise(sigma, seed, left);
  add_noise(sigma, seed + 1, right);
}

}  // namespace mtstereo::eval
