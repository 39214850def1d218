// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mtstereo/image.hpp"
#include "mtstereo/result.hpp"

namespace mtstereo {

/// Checks that both views of a pair are readable and have the same size. Fails with kInvalidImage
/// or kSizeMismatch.
Status check_pair(GrayView left, GrayView right);

}  // namespace mtstereo
