// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/processing.hpp"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace mtstereo::render {
namespace {

constexpr float kScale = 256;  // of the mosaic: 16 bits for 0 .. 255
constexpr float kWhite = 255;
constexpr int kMargin = 4;  // more than demosaicing reaches, and even: the mosaic keeps its order

// The noise reduction of the luma: neighbors count less by their distance and by their difference.
constexpr int kWindow = 5;             // [px]
constexpr double kDistance = 1.2;      // [px]
constexpr double kDifference = 2;      // [standard deviations of the noise]
constexpr double kColorSmoothing = 2;  // [px]

// Sharpening adds a part of what a blur removes.
constexpr double kSharpeningRadius = 1;  // [px]
constexpr double kSharpening = 0.7;

cv::Mat demosaiced(const cv::Mat& mosaic) {
  cv::Mat color, result;
  cv::cvtColor(mosaic, color, cv::COLOR_BayerRGGB2BGR_EA);
  color.convertTo(result, CV_32F, 1 / kScale);
  return result;
}

void reduce_noise(cv::Mat& luma, double noise) {
  if (noise == 0) return;
  cv::Mat smooth;
  cv::bilateralFilter(luma, smooth, kWindow, kDifference * noise, kDistance, cv::BORDER_REPLICATE);
  luma = smooth;
}

void smooth_color(cv::Mat& color) {
  cv::GaussianBlur(color, color, cv::Size(), kColorSmoothing, kColorSmoothing,
                   cv::BORDER_REPLICATE);
}

void sharpen(cv::Mat& luma) {
  cv::Mat soft;
  cv::GaussianBlur(luma, soft, cv::Size(), kSharpeningRadius, kSharpeningRadius,
                   cv::BORDER_REPLICATE);
  cv::addWeighted(luma, 1 + kSharpening, soft, -kSharpening, 0, luma);
}

}  // namespace

cv::Mat mosaic_of(const cv::Mat& signal, int margin) {
  constexpr int kBlue = 0, kGreen = 1, kRed = 2;
  constexpr int kChannels[2][2] = {{kRed, kGreen}, {kGreen, kBlue}};
  cv::Mat mosaic(signal.rows + 2 * margin, signal.cols + 2 * margin, CV_16UC1);
  for (int y = 0; y < mosaic.rows; ++y) {
    const auto* in = signal.ptr<cv::Vec3f>(std::clamp(y - margin, 0, signal.rows - 1));
    auto* out = mosaic.ptr<std::uint16_t>(y);
    for (int x = 0; x < mosaic.cols; ++x) {
      const float value = in[std::clamp(x - margin, 0, signal.cols - 1)][kChannels[y & 1][x & 1]];
      out[x] = cv::saturate_cast<std::uint16_t>(kScale * std::clamp(value, 0.0f, kWhite));
    }
  }
  return mosaic;
}

cv::Mat through_mosaic(const cv::Mat& signal, double noise) {
  const cv::Rect inside(kMargin, kMargin, signal.cols, signal.rows);
  cv::Mat image = demosaiced(mosaic_of(signal, kMargin))(inside).clone();
  cv::cvtColor(image, image, cv::COLOR_BGR2YCrCb);
  std::vector<cv::Mat> planes;
  cv::split(image, planes);
  reduce_noise(planes[0], noise);
  for (const int color : {1, 2}) smooth_color(planes[static_cast<std::size_t>(color)]);
  sharpen(planes[0]);
  cv::merge(planes, image);
  cv::cvtColor(image, image, cv::COLOR_YCrCb2BGR);
  return image;
}

}  // namespace mtstereo::render
