// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace mtstereo::render {

/// A gray image on a surface. The center of the image is at the origin of the surface; rows go
/// along v. Outside of the image, the surface is white.
class ImageTexture {
 public:
  /// `pixels`: width * height gray values, row by row; `scale` [px/m]. Throws std::invalid_argument
  /// if the numbers do not fit.
  ImageTexture(int width, int height, const std::vector<std::uint8_t>& pixels, double scale);

  /// Its size [m].
  double width() const { return columns_ / scale_; }
  double height() const { return rows_ / scale_; }

  /// The exact mean of a square of the surface with this center and edge length [m]; 0 .. 1.
  double mean(double u, double v, double edge) const;

 private:
  double integral(double column, double row) const;

  int columns_, rows_;
  double scale_;
  std::vector<double> sums_;  // of the pixels above and to the left of each pixel corner
};

/// The image of a checkerboard whose first square is black, on white paper with a margin of one
/// square. `square` is the edge of a square [m]. Throws
/// std::invalid_argument for less than 2 or more than 100 squares in a direction.
ImageTexture checkerboard(int squares_x, int squares_y, double square);

}  // namespace mtstereo::render
