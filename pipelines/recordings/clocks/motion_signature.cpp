// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/clocks/motion_signature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace mtstereo::run {
namespace {

constexpr double kLongTime = 0.5;     // of a slow change [s]
constexpr double kLeastRatio = 1.25;  // slow to fast changes of a scene that moves
constexpr double kLeastChange = 0.5;  // of a scene that moves [gray values]
const cv::Size kBlocks(16, 9);

// The logarithms of the mean brightness of bands of rows, without their mean.
std::vector<double> band_brightness(const cv::Mat& frame) {
  constexpr double kAdded = 8;  // to the brightness, before its logarithm [gray values]
  cv::Mat rows, bands;
  cv::reduce(frame, rows, 1, cv::REDUCE_AVG, CV_32F);
  cv::resize(rows, bands, cv::Size(1, MotionSignature::kBands), 0, 0, cv::INTER_AREA);
  std::vector<double> result;
  double sum = 0;
  for (int i = 0; i < bands.rows; ++i) {
    result.push_back(std::log(bands.at<float>(i) + kAdded));
    sum += result.back();
  }
  for (double& each : result) each -= sum / bands.rows;
  return result;
}

// The sums of least squares for the flow of a band.
struct FlowSums {
  double xx = 0, xy = 0, yy = 0, xt = 0, yt = 0;

  // The flow [px]; small without texture.
  std::array<double, 2> solve() const {
    constexpr double kWeak = 1e-3;
    const double regular = kWeak * (xx + yy) * (xx + yy) + 1;
    const double determinant = xx * yy - xy * xy + regular;
    return {(xy * yt - yy * xt) / determinant, (xy * xt - xx * yt) / determinant};
  }
};

void add_row(const cv::Mat& before, const cv::Mat& after, float change, int y, FlowSums& sums) {
  const float* a[3] = {before.ptr<float>(y - 1), before.ptr<float>(y), before.ptr<float>(y + 1)};
  const float* b[3] = {after.ptr<float>(y - 1), after.ptr<float>(y), after.ptr<float>(y + 1)};
  for (int x = 1; x + 1 < before.cols; ++x) {
    const double gx = (a[1][x + 1] - a[1][x - 1] + b[1][x + 1] - b[1][x - 1]) / 4;
    const double gy = (a[2][x] - a[0][x] + b[2][x] - b[0][x]) / 4;
    const double gt = b[1][x] - a[1][x] - change;
    sums.xx += gx * gx, sums.xy += gx * gy, sums.yy += gy * gy;
    sums.xt += gx * gt, sums.yt += gy * gt;
  }
}

double mean_square(const cv::Mat& a, const cv::Mat& b) {
  const cv::Mat difference = b - a;
  const cv::Mat centered = difference - cv::mean(difference);
  return centered.dot(centered) / static_cast<double>(centered.total());
}

}  // namespace

bool MotionSignature::is_static() const {
  return slow_change < std::max(kLeastChange, kLeastRatio * fast_change);
}

void SignatureMaker::add_changes(const cv::Mat& blocks, double time) {
  if (!blocks_.empty()) {
    fast_sum_ += mean_square(blocks_.back().second, blocks);
    ++fast_count_;
  }
  if (!blocks_.empty() && time - blocks_.front().first >= kLongTime) {
    slow_sum_ += mean_square(blocks_.front().second, blocks);
    ++slow_count_;
    blocks_.erase(blocks_.begin());
  }
  blocks_.emplace_back(time, blocks);
}

void SignatureMaker::add(const cv::Mat& frame, double time) {
  cv::Mat smooth, blocks;
  cv::blur(frame, smooth, cv::Size(2, 2));
  smooth.convertTo(smooth, CV_32F);
  cv::resize(smooth, blocks, kBlocks, 0, 0, cv::INTER_AREA);
  add_changes(blocks, time);
  const std::vector<double> bands = band_brightness(frame);
  if (!smooth_.empty()) {
    const double step = time - time_;
    cv::Mat row(1, MotionSignature::kFeatures, CV_32F);
    for (int i = 0; i < MotionSignature::kBands; ++i) {
      row.at<float>(i) = static_cast<float>((bands[i] - bands_[i]) / step);
    }
    const auto change = static_cast<float>(cv::mean(smooth)[0] - cv::mean(smooth_)[0]);
    for (int i = 0; i < MotionSignature::kFlowBands; ++i) {
      const int inner = smooth.rows - 2;
      FlowSums sums;
      for (int y = 1 + i * inner / MotionSignature::kFlowBands;
           y < 1 + (i + 1) * inner / MotionSignature::kFlowBands; ++y) {
        add_row(smooth_, smooth, change, y, sums);
      }
      const auto [u, v] = sums.solve();
      row.at<float>(MotionSignature::kBands + i) = static_cast<float>(u / step);
      row.at<float>(MotionSignature::kBands + MotionSignature::kFlowBands + i) =
          static_cast<float>(v / step);
    }
    signature_.times.push_back((time + time_) / 2);
    signature_.features.push_back(row);
  }
  smooth_ = smooth;
  bands_ = bands;
  time_ = time;
}

MotionSignature SignatureMaker::take() {
  signature_.slow_change = slow_count_ > 0 ? std::sqrt(slow_sum_ / slow_count_) : 0;
  signature_.fast_change = fast_count_ > 0 ? std::sqrt(fast_sum_ / fast_count_) : 0;
  return std::exchange(signature_, {});
}

}  // namespace mtstereo::run
