// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "render/render.hpp"

namespace mtstereo::render {

/// The sensor of one camera: lens shading, exposure, noise, amplification and clipping.
class Sensor {
 public:
  /// `seed` is that of the noise; `exposure` multiplies the light. The settings must outlive the
  /// sensor.
  Sensor(const Settings& settings, std::uint32_t seed, double exposure);

  /// The gray value of a pixel for its light; light 1 is white at the default exposure.
  std::uint8_t gray(float light, int x, int y, int channel) const;

 private:
  float shading(int x, int y) const;
  float noise(float signal, int x, int y, int channel) const;

  const Settings& settings_;
  std::uint32_t seed_;
  float exposure_;
};

/// The image after compression by JPEG with a quality of 1 to 100, and decompression.
cv::Mat after_jpeg(const cv::Mat& image, int quality);

}  // namespace mtstereo::render
