// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/image_texture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mtstereo::render {

ImageTexture::ImageTexture(int width, int height, const std::vector<std::uint8_t>& pixels,
                           double scale)
    : columns_(width), rows_(height), scale_(scale) {
  const bool fits =
      width > 0 && height > 0 && scale > 0 && std::isfinite(scale) &&
      pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (!fits) throw std::invalid_argument("the image has no pixels or no scale");
  const auto stride = static_cast<std::size_t>(width) + 1;
  sums_.resize(stride * (static_cast<std::size_t>(height) + 1));
  const std::uint8_t* pixel = pixels.data();
  for (std::size_t y = 1; y <= static_cast<std::size_t>(height); ++y) {
    double row = 0;
    for (std::size_t x = 1; x < stride; ++x) {
      row += *pixel++ / 255.0;
      sums_[y * stride + x] = sums_[(y - 1) * stride + x] + row;
    }
  }
}

// The integral of the gray values from the upper left corner to a point [px].
double ImageTexture::integral(double column, double row) const {
  const double x = std::clamp(column, 0.0, static_cast<double>(columns_));
  const double y = std::clamp(row, 0.0, static_cast<double>(rows_));
  const int i = std::min(static_cast<int>(x), columns_ - 1);
  const int j = std::min(static_cast<int>(y), rows_ - 1);
  const double u = x - i, v = y - j;
  const auto stride = static_cast<std::size_t>(columns_) + 1;
  const double* sum = &sums_[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)];
  return (1 - v) * ((1 - u) * sum[0] + u * sum[1]) +
         v * ((1 - u) * sum[stride] + u * sum[stride + 1]);
}

double ImageTexture::mean(double u, double v, double edge) const {
  const double half = std::max(edge * scale_, 1e-6) / 2;
  const double x = u * scale_ + columns_ / 2.0, y = v * scale_ + rows_ / 2.0;
  const double left = x - half, right = x + half, top = y - half, bottom = y + half;
  const double inside =
      integral(right, bottom) - integral(left, bottom) - integral(right, top) + integral(left, top);
  const auto covered = [](double low, double high, double size) {
    return std::max(0.0, std::min(high, size) - std::max(low, 0.0));
  };
  const double area = 4 * half * half;
  const double white = area - covered(left, right, columns_) * covered(top, bottom, rows_);
  return (inside + white) / area;
}

ImageTexture checkerboard(int squares_x, int squares_y, double square) {
  const bool valid = squares_x >= 2 && squares_x <= 100 && squares_y >= 2 && squares_y <= 100;
  if (!valid) throw std::invalid_argument("a checkerboard has 2 to 100 squares in each direction");
  constexpr int kPixels = 16;  // per square; the edges are exact at any number
  const int width = (squares_x + 2) * kPixels, height = (squares_y + 2) * kPixels;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int i = x / kPixels - 1, j = y / kPixels - 1;
      const bool inside = i >= 0 && i < squares_x && j >= 0 && j < squares_y;
      pixels.push_back(inside && (i + j) % 2 == 0 ? 20 : 255);
    }
  }
  return {width, height, pixels, kPixels / square};
}

}  // namespace mtstereo::render
