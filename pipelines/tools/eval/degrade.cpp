// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/degrade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lib/images/images.hpp"
#include "tools/eval/h264.hpp"

namespace mtstereo::eval {
namespace {

constexpr double kSensorNoise = 2;     // of dark and soft views [gray values]
constexpr double kCameraBlur = 1.2;    // sigma [px]
constexpr double kCameraQuality = 70;  // of JPEG

void compress(double quality, cv::Mat& image) {
  const std::string bytes =
      images::encode(".jpg", image, {cv::IMWRITE_JPEG_QUALITY, static_cast<int>(quality)});
  image = images::decode(bytes, cv::IMREAD_GRAYSCALE);
}

void multiply(double factor, cv::Mat& image) {
  cv::Mat scaled;
  image.convertTo(scaled, -1, factor);
  image = scaled;
}

cv::Mat blurred(const cv::Mat& image, double sigma, int border = cv::BORDER_DEFAULT) {
  if (sigma <= 0) return image;
  cv::Mat result;
  cv::GaussianBlur(image, result, {0, 0}, sigma, sigma, border);
  return result;
}

void warp(const cv::Matx23d& to_source, cv::Mat& image) {
  cv::Mat warped;
  cv::warpAffine(image, warped, to_source, image.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  image = warped;
}

void roll(double degrees, cv::Mat& image) {
  const cv::Point2f center((image.cols - 1) / 2.0F, (image.rows - 1) / 2.0F);
  // getRotationMatrix2D() turns counterclockwise; as a map to the source it turns clockwise.
  const cv::Mat to_source = cv::getRotationMatrix2D(center, degrees, 1);
  warp(cv::Matx23d(to_source), image);
}

void apply_gamma(double exponent, cv::Mat& image) {
  cv::Mat table(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i) {
    table.at<std::uint8_t>(i) =
        cv::saturate_cast<std::uint8_t>(255 * std::pow(i / 255.0, exponent));
  }
  cv::Mat mapped;
  cv::LUT(image, table, mapped);
  image = mapped;
}

// Blurs by a sigma that grows from 0, up to 30 % of the way from the center to a corner, to 2 px,
// from 80 % on. Between the images of the sigmas 0, 0.5, 1, 1.5 and 2 px it is linear.
void blur_rim(cv::Mat& image) {
  constexpr double kSharp = 0.3, kSoft = 0.8, kStep = 0.5;
  constexpr int kSteps = 4;
  std::array<cv::Mat, kSteps + 1> images;
  image.convertTo(images[0], CV_32F);
  for (int i = 1; i <= kSteps; ++i) images[i] = blurred(images[0], i * kStep);
  cv::Mat result(image.size(), CV_8UC1);
  const double half_width = image.cols / 2.0, half_height = image.rows / 2.0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double radius =
          std::hypot((x - half_width) / half_width, (y - half_height) / half_height) /
          std::sqrt(2.0);
      const double level = kSteps * std::clamp((radius - kSharp) / (kSoft - kSharp), 0.0, 1.0);
      const int lower = std::min(static_cast<int>(level), kSteps - 1);
      const double share = level - lower;
      result.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(
          images[lower].at<float>(y, x) * (1 - share) + images[lower + 1].at<float>(y, x) * share);
    }
  }
  image = result;
}

// A soft lens and the noise of the sensor.
void soften(std::uint64_t seed, cv::Mat& view) {
  view = blurred(view, kCameraBlur);
  add_noise(kSensorNoise, seed, view);
}

void change_both(const Degradation& degradation, std::uint64_t seed, cv::Mat& view) {
  const double amount = degradation.amount;
  switch (degradation.kind) {
    case DegradationKind::kNoise:
      return add_noise(amount, seed, view);
    case DegradationKind::kJpeg:
      return compress(amount, view);
    case DegradationKind::kH264:
      view = through_h264(view, static_cast<int>(amount));
      return;
    case DegradationKind::kDark:
      multiply(amount, view);
      return add_noise(kSensorNoise, seed, view);
    case DegradationKind::kBright:
      return multiply(amount, view);
    case DegradationKind::kBlur:
      view = blurred(view, amount);
      return;
    case DegradationKind::kRim:
      return blur_rim(view);
    case DegradationKind::kRimCam:
      blur_rim(view);
      add_noise(kSensorNoise, seed, view);
      return compress(kCameraQuality, view);
    case DegradationKind::kCam:
    case DegradationKind::kCam2x:
    case DegradationKind::kCam1_5x:
      soften(seed, view);
      return compress(kCameraQuality, view);
    case DegradationKind::kCamH264:
      soften(seed, view);
      view = through_h264(view, static_cast<int>(amount));
      return;
    default:
      return;
  }
}

void change_right(const Degradation& degradation, cv::Mat& right) {
  const double amount = degradation.amount;
  switch (degradation.kind) {
    case DegradationKind::kBlurRight:
      right = blurred(right, amount, cv::BORDER_REPLICATE);
      return;
    case DegradationKind::kLowerRight:
      return warp({1, 0, 0, 0, 1, -amount}, right);
    case DegradationKind::kRollRight:
      return roll(amount, right);
    case DegradationKind::kGainRight:
      return multiply(amount, right);
    case DegradationKind::kGammaRight:
      return apply_gamma(amount, right);
    default:
      return;
  }
}

double enlargement_of(DegradationKind kind) {
  switch (kind) {
    case DegradationKind::kSoft2x:
    case DegradationKind::kCam2x:
      return 2;
    case DegradationKind::kSoft1_5x:
    case DegradationKind::kCam1_5x:
      return 1.5;
    default:
      return 1;
  }
}

// Views by cubic interpolation, the truth by its nearest pixel.
DegradedPair enlarged(const LoadedPair& pair, int max_disparity, double scale) {
  if (scale == 1) return {pair, max_disparity};
  DegradedPair result;
  cv::resize(pair.left, result.images.left, {}, scale, scale, cv::INTER_CUBIC);
  cv::resize(pair.right, result.images.right, {}, scale, scale, cv::INTER_CUBIC);
  const auto nearest = [&](const cv::Mat& map) {
    cv::Mat larger;
    if (!map.empty()) cv::resize(map, larger, {}, scale, scale, cv::INTER_NEAREST);
    return larger;
  };
  GroundTruth& truth = result.images.truth;
  truth = {nearest(pair.truth.disparity), nearest(pair.truth.visible), pair.truth.scale * scale};
  truth.disparity *= scale;
  result.max_disparity = static_cast<int>(std::ceil(max_disparity * scale));
  return result;
}

}  // namespace

void add_noise(double sigma, std::uint64_t seed, cv::Mat& image) {
  cv::Mat noise(image.size(), CV_32F);
  cv::RNG random(seed);
  random.fill(noise, cv::RNG::NORMAL, 0, sigma);
  cv::Mat noisy;
  cv::add(image, noise, noisy, cv::noArray(), CV_8U);
  image = noisy;
}

DegradedPair degrade(const Degradation& degradation, const LoadedPair& pair, int max_disparity) {
  // Every change below replaces a view by a new image: those of `pair` remain as they are.
  DegradedPair result = enlarged(pair, max_disparity, enlargement_of(degradation.kind));
  change_both(degradation, 1, result.images.left);
  change_both(degradation, 2, result.images.right);
  change_right(degradation, result.images.right);
  return result;
}

}  // namespace mtstereo::eval
