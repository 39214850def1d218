// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "tools/render/settings.hpp"

namespace mtstereo::render {

/// The sensor of one camera: lens shading, exposure, noise and amplification.
class Sensor {
 public:
  /// `seed` is that of the noise; `exposure` multiplies the light. The settings must outlive the
  /// sensor.
  Sensor(const Settings& settings, std::uint32_t seed, double exposure);

  /// The signal of a pixel for its light [gray values], not clipped; light 1 is white at the
  /// default exposure.
  float signal(float light, int x, int y, int channel) const;

  /// The standard deviation of the noise in the signal of a medium gray [gray values].
  double medium_noise() const;

 private:
  float shading(int x, int y) const;
  double deviation(float signal) const;
  float noise(float signal, int x, int y, int channel) const;

  const Settings& settings_;
  std::uint32_t seed_;
  float exposure_;
};

/// The image after compression by JPEG with a quality of 1 to 100, and decompression.
cv::Mat after_jpeg(const cv::Mat& image, int quality);

}  // namespace mtstereo::render
