// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/check_image.hpp"

namespace mtstereo {

std::string image_size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " px";
}

Status check_image(const char* name, const void* data, int width, int height, std::ptrdiff_t stride,
                   std::ptrdiff_t row_bytes) {
  if (data != nullptr && width > 0 && height > 0 && (stride >= row_bytes || height == 1)) return {};
  return Error{ErrorCode::kInvalidImage,
               std::string("the ") + name + " is invalid: " + image_size_text(width, height) +
                   " with a stride of " + std::to_string(stride) + " bytes" +
                   (data == nullptr ? " and no data" : "") +
                   "; an image needs data, at least 1x1 px and a stride of at least one row"};
}

Status check_sizes(const char* name, int width, int height, const char* other, int other_width,
                   int other_height) {
  if (width == other_width && height == other_height) return {};
  return Error{ErrorCode::kSizeMismatch, std::string("the ") + name + " is " +
                                             image_size_text(width, height) + ", the " + other +
                                             " " + image_size_text(other_width, other_height) +
                                             ": both must have the same size"};
}

Status check_range(double near, double far) {
  if (near >= 0 && far > near) return {};
  return Error{ErrorCode::kInvalidParameter,
               "depths from near = " + std::to_string(near) + " m to far = " + std::to_string(far) +
                   " m are no range: near must be at least 0 and less than far"};
}

}  // namespace mtstereo
