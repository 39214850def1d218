// SPDX-License-Identifier: LGPL-2.1-or-later
#include "render/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "render/texture.hpp"

namespace mtstereo::render {
namespace {

// A normally distributed number with mean 0 and standard deviation 1 that depends only on the
// arguments.
float normal(std::uint32_t seed, std::uint32_t channel, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t place = hash(x, y, channel);
  const double a = 1 - hash_unit(seed, place, 1), b = hash_unit(seed, place, 2);
  return static_cast<float>(std::sqrt(-2 * std::log(a)) * std::cos(2 * std::numbers::pi * b));
}

}  // namespace

Sensor::Sensor(const Settings& settings, std::uint32_t seed, double exposure)
    : settings_(settings), seed_(seed), exposure_(static_cast<float>(exposure)) {}

std::uint8_t Sensor::gray(float light, int x, int y, int channel) const {
  float signal = 255 * exposure_ * light;
  if (settings_.vignette > 0) signal *= shading(x, y);
  signal += noise(signal, x, y, channel);
  return cv::saturate_cast<std::uint8_t>(static_cast<float>(settings_.gain) * signal);
}

// Falls with the square of the distance from the center; the corners lose all of the vignette.
float Sensor::shading(int x, int y) const {
  const double center_x = (settings_.width - 1) / 2.0, center_y = (settings_.height - 1) / 2.0;
  const double from_center = std::hypot(x - center_x, y - center_y);
  const double corner = std::max(std::hypot(center_x, center_y), 1.0);
  return static_cast<float>(1 - settings_.vignette * std::pow(from_center / corner, 2));
}

float Sensor::noise(float signal, int x, int y, int channel) const {
  double deviation = settings_.noise;
  if (settings_.shot_noise > 0) {
    deviation = std::sqrt(deviation * deviation + settings_.shot_noise * std::max(signal, 0.0f));
  }
  if (deviation == 0) return 0;
  return static_cast<float>(deviation) * normal(seed_, static_cast<std::uint32_t>(channel),
                                                static_cast<std::uint32_t>(x),
                                                static_cast<std::uint32_t>(y));
}

cv::Mat after_jpeg(const cv::Mat& image, int quality) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality})) {
    throw std::runtime_error("OpenCV's JPEG encoder failed");
  }
  return cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
}

}  // namespace mtstereo::render
