// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lib/images/images.hpp"
#include "tools/render/optics.hpp"
#include "tools/render/texture.hpp"

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

float Sensor::signal(float light, int x, int y, int channel) const {
  float signal = 255 * exposure_ * light;
  if (settings_.vignette > 0) signal *= shading(x, y);
  signal += noise(signal, x, y, channel);
  return static_cast<float>(settings_.gain) * signal;
}

double Sensor::medium_noise() const {
  return settings_.gain * deviation(static_cast<float>(127.5 / settings_.gain));
}

// The corners lose all of the vignette.
float Sensor::shading(int x, int y) const {
  const cv::Size size(settings_.width, settings_.height);
  return static_cast<float>(1 - settings_.vignette * rim_share(size, x, y));
}

double Sensor::deviation(float signal) const {
  const double constant = settings_.noise;
  if (settings_.shot_noise == 0) return constant;
  return std::sqrt(constant * constant + settings_.shot_noise * std::max(signal, 0.0f));
}

float Sensor::noise(float signal, int x, int y, int channel) const {
  const double size = deviation(signal);
  if (size == 0) return 0;
  return static_cast<float>(size) * normal(seed_, static_cast<std::uint32_t>(channel),
                                           static_cast<std::uint32_t>(x),
                                           static_cast<std::uint32_t>(y));
}

cv::Mat after_jpeg(const cv::Mat& image, int quality) {
  const std::string bytes = images::encode(".jpg", image, {cv::IMWRITE_JPEG_QUALITY, quality});
  if (bytes.empty()) throw std::runtime_error("OpenCV's JPEG encoder failed");
  return images::decode(bytes, cv::IMREAD_UNCHANGED);
}

}  // namespace mtstereo::render
