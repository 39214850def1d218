// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/check_views.hpp"

#include <string>

#include "parameters/parameter_text.hpp"

namespace mtstereo {
namespace {

Status check_view(const char* name, GrayView view) {
  if (view.data != nullptr && view.width > 0 && view.height > 0 &&
      (view.stride >= view.width || view.height == 1)) {
    return {};
  }
  return Error{ErrorCode::kInvalidImage,
               std::string("the ") + name + " image is invalid: " + std::to_string(view.width) +
                   "x" + std::to_string(view.height) + " px with a stride of " +
                   std::to_string(view.stride) + " bytes" +
                   (view.data == nullptr ? " and no data" : "") +
                   "; an image needs data, at least 1x1 px and a stride of at least its width"};
}

}  // namespace

Status check_pair(GrayView left, GrayView right) {
  if (Status status = check_view("left", left); !status) return status;
  if (Status status = check_view("right", right); !status) return status;
  if (left.width == right.width && left.height == right.height) return {};
  return Error{ErrorCode::kSizeMismatch,
               "the left image is " + size_text(left.width, left.height) + " px, the right image " +
                   size_text(right.width, right.height) +
                   " px: both views of a rectified pair must have the same size"};
}

}  // namespace mtstereo
