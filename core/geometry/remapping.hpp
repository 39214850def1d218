// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

// Resampling by a map of positions, bilinear and in fixed point, as cv::remap() does with maps of
// the type CV_16SC2. It allocates nothing and starts no threads: cv::remap() does both in every
// call.

namespace mtstereo {

/// Steps per px of a position. An interpolated value has 2 * 5 fractional bits.
inline constexpr int kPositionSteps = 32;

/// A range of pixels of one row of the output.
struct PixelRun {
  int y = 0;      ///< [px]
  int begin = 0;  ///< first column [px]
  int end = 0;    ///< the column after the last one [px]
};

/// Where the pixels of an output image are in the input image.
class PositionMap {
 public:
  /// Sets the sizes, each at least 1x1, the input at least 2x2. No pixel has a position yet. Then
  /// append() takes the pixels that have one.
  void reset(int width, int height, int in_width, int in_height);
  /// Sets the position of pixel (x, y) of the output [px], row by row from left to right. Ignored
  /// if it is not inside of the input image, rounded to a step.
  void append(int x, int y, double u, double v);

  int width() const { return width_; }
  int height() const { return height_; }
  int in_width() const { return in_width_; }
  int in_height() const { return in_height_; }
  /// The pixels that have a position, in the order of append().
  const std::vector<PixelRun>& runs() const { return runs_; }

  /// The upper left one of the four input pixels: column and row. All four are inside.
  struct Corner {
    std::int16_t x;
    std::int16_t y;
  };
  /// The weights of the right column and of the lower row, 0 .. kPositionSteps.
  struct Weights {
    std::uint8_t x;
    std::uint8_t y;
  };
  const Corner* corners(int y) const { return corners_.data() + index(y); }
  const Weights* weights(int y) const { return weights_.data() + index(y); }

 private:
  std::size_t index(int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
  }

  int width_ = 0;
  int height_ = 0;
  int in_width_ = 0;
  int in_height_ = 0;
  Buffer<Corner> corners_;
  Buffer<Weights> weights_;
  std::vector<PixelRun> runs_;
};

/// Resamples an image of 1, 3 or 4 interleaved channels; pixels without a position get `border`.
/// The views have the sizes of the map.
void remap(const PositionMap& map, ImageView<const std::uint8_t> in, ImageView<std::uint8_t> out,
           int channels, std::uint8_t border);

}  // namespace mtstereo
