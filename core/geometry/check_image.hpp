// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>

#include "mtstereo/image.hpp"
#include "mtstereo/result.hpp"

// Checks of the arguments of the geometry library. They may throw std::bad_alloc.

namespace mtstereo {

/// A size as it can be printed: "640x480 px".
std::string image_size_text(int width, int height);

/// The same for a row of `row_bytes`, whatever the type of the pixels.
Status check_image(const char* name, const void* data, int width, int height, std::ptrdiff_t stride,
                   std::ptrdiff_t row_bytes);

/// Fails with kInvalidImage unless the image has data, at least 1x1 px and a stride of at least one
/// row. `name`: "disparity map". `channels`: interleaved values per pixel.
template <typename T>
Status check_image(const char* name, ImageView<const T> image, int channels = 1) {
  return check_image(name, image.data, image.width, image.height, image.stride,
                     static_cast<std::ptrdiff_t>(sizeof(T)) * channels * image.width);
}

/// Fails with kSizeMismatch unless both images have the same size.
Status check_sizes(const char* name, int width, int height, const char* other, int other_width,
                   int other_height);

/// Fails with kInvalidParameter unless 0 <= near < far; far may be infinite [m].
Status check_range(double near, double far);

}  // namespace mtstereo
