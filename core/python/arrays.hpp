// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <cstdint>

#include "mtstereo/image.hpp"

// NumPy arrays as views of the library.

namespace mtstereo::python {

/// An argument that is an array, and the view of its pixels. The view is valid while the array is
/// held: that of the caller if its pixels are contiguous within rows, otherwise a copy.
template <typename T>
struct ArrayView {
  pybind11::array array;
  ImageView<const T> view;
};

/// The gray view of an argument. Throws TypeError unless it is an array of type uint8, and
/// ValueError unless it has two dimensions and at least one pixel; the message names the argument
/// and what to do.
ArrayView<std::uint8_t> gray_view(const char* name, pybind11::handle value);

/// The same for an image with 3 or 4 interleaved values per pixel, or a gray one. The width counts
/// pixels.
ArrayView<std::uint8_t> color_view(const char* name, pybind11::handle value);

/// The view of a disparity map. Throws as gray_view() does, unless it has floating-point values;
/// those of another precision than float32 are converted.
ArrayView<float> disparity_view(const char* name, pybind11::handle value);

/// A matrix, row by row.
pybind11::array_t<double> matrix3(const std::array<double, 9>& values);

/// A new, contiguous array of this size.
template <typename T>
pybind11::array_t<T> new_image(int height, int width) {
  return pybind11::array_t<T>(std::array<pybind11::ssize_t, 2>{height, width});
}

/// The view of a new image.
template <typename T>
ImageView<T> view_of(pybind11::array_t<T>& image) {
  return {image.mutable_data(), static_cast<int>(image.shape(1)), static_cast<int>(image.shape(0)),
          image.strides(0)};
}

}  // namespace mtstereo::python
