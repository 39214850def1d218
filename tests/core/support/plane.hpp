// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo::test {

/// An image without padding, for the references and for expected results.
template <typename T>
struct Plane {
  Plane() = default;
  Plane(int plane_width, int plane_height, T value = T{})
      : width(plane_width),
        height(plane_height),
        pixels(static_cast<std::size_t>(plane_width) * plane_height, value) {}

  T& operator()(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const T& operator()(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * width + x];
  }
  /// The pixel, or for a position outside of the image the nearest pixel of the border.
  const T& clamped(int x, int y) const {
    return (*this)(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
  }
  ImageView<const T> view() const {
    return {pixels.data(), width, height, static_cast<std::ptrdiff_t>(width * sizeof(T))};
  }
  friend bool operator==(const Plane&, const Plane&) = default;

  int width = 0;
  int height = 0;
  std::vector<T> pixels;
};

using GrayPlane = Plane<std::uint8_t>;
using DisparityPlane = Plane<std::int32_t>;

/// A copy of the pixels of a view, without its padding.
template <typename T>
Plane<std::remove_const_t<T>> copy_of(ImageView<T> view) {
  Plane<std::remove_const_t<T>> copy(view.width, view.height);
  for (int y = 0; y < view.height; ++y) std::copy_n(view.row(y), view.width, &copy(0, y));
  return copy;
}

template <typename T>
Plane<T> copy_of(const Image<T>& image) {
  return copy_of(image.view());
}

/// An Image of the library with the same pixels; its padding holds 0xA5.
template <typename T>
Image<T> image_of(const Plane<T>& plane) {
  Image<T> image;
  image.resize(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y) {
    auto* bytes = reinterpret_cast<std::uint8_t*>(image.row(y));
    std::fill_n(bytes, image.stride() * sizeof(T), std::uint8_t{0xA5});
    std::copy_n(&plane(0, y), plane.width, image.row(y));
  }
  return image;
}

}  // namespace mtstereo::test

namespace mtstereo {

// All tests use them.
using test::copy_of;
using test::DisparityPlane;
using test::GrayPlane;

}  // namespace mtstereo
