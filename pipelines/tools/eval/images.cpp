// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/images.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>

#include "lib/images/images.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/pfm.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

const cv::Vec3b kBlack(0, 0, 0);
const cv::Vec3b kGray(96, 96, 96);

// Colors for 0 .. range; NaN gets the color of 0, which the caller overwrites.
cv::Mat color_of(const cv::Mat& values, double range) {
  cv::Mat scaled(values.size(), CV_8UC1);
  for (int y = 0; y < values.rows; ++y) {
    const auto* source = values.ptr<float>(y);
    auto* target = scaled.ptr<std::uint8_t>(y);
    for (int x = 0; x < values.cols; ++x) {
      const double share = std::isnan(source[x]) ? 0 : source[x] / range;
      target[x] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
    }
  }
  cv::Mat color;
  cv::applyColorMap(scaled, color, cv::COLORMAP_TURBO);
  return color;
}

// 255 where a value is NaN. Not `values != values`: OpenCV 4.6 gives 0 for that with AVX.
cv::Mat is_nan(const cv::Mat& values) {
  cv::Mat mask(values.size(), CV_8UC1);
  std::transform(
      values.begin<float>(), values.end<float>(), mask.begin<std::uint8_t>(),
      [](float value) { return std::isnan(value) ? std::uint8_t{255} : std::uint8_t{0}; });
  return mask;
}

}  // namespace

void write_disparity(const fs::path& file, const cv::Mat& disparity) {
  cv::Mat values = disparity.clone();
  for (float& value : cv::Mat_<float>(values)) {
    if (std::isnan(value)) value = std::numeric_limits<float>::infinity();
  }
  write_pfm(file, values);
}

cv::Mat color_disparity(const cv::Mat& disparity, int max_disparity) {
  cv::Mat color = color_of(disparity, max_disparity);
  color.setTo(kBlack, is_nan(disparity));  // NaN
  return color;
}

cv::Mat color_error(const cv::Mat& disparity, const GroundTruth& truth) {
  const cv::Mat error = cv::abs(disparity - truth.disparity);
  cv::Mat color = color_of(error, kErrorImageRange * truth.scale);
  color.setTo(kGray, is_nan(disparity));
  color.setTo(kBlack, is_nan(truth.disparity));
  return color;
}

cv::Mat overview(const LoadedPair& images, const cv::Mat& disparity, int max_disparity) {
  cv::Mat left, above, below, whole;
  cv::cvtColor(images.left, left, cv::COLOR_GRAY2BGR);
  cv::hconcat(left, color_disparity(images.truth.disparity, max_disparity), above);
  cv::hconcat(color_disparity(disparity, max_disparity), color_error(disparity, images.truth),
              below);
  cv::vconcat(above, below, whole);
  return whole;
}

void write_image(const fs::path& file, const cv::Mat& image) {
  std::string bytes;
  try {
    bytes = images::encode(".png", image);
  } catch (const cv::Exception& error) {
    throw UserError(file, "cannot be encoded: " + error.err);
  }
  if (bytes.empty()) throw UserError(file, "cannot be encoded");
  write_bytes(file, bytes);
}

}  // namespace mtstereo::eval
