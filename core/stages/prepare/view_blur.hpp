// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Blurs a view by a Gaussian, in fixed point: the same on every processor.

/// Largest radius of a kernel [px]: three times the largest sigma.
inline constexpr int kLargestBlurRadius = 9;

/// One half of a symmetric kernel of 2 * radius + 1 px: weights in 1/256, that of the middle first.
/// The weights of the whole kernel add up to 256.
struct BlurKernel {
  int radius = 0;
  std::array<std::int16_t, kLargestBlurRadius + 1> weights = {256};
};

/// The kernel of a Gaussian of this sigma [px], 0 .. kLargestBlur. A sigma below 0.3 px gives
/// radius 0, a kernel that changes nothing.
BlurKernel gaussian_kernel(float sigma);

/// Scratch memory of one thread: a row that was blurred along the columns, with a border.
struct BlurScratch {
  Buffer<std::int16_t> row;

  void resize(int width);
};

/// Writes the rows y0 .. y1 - 1 of `out`, which has the size of the view: the view blurred by the
/// kernel along the columns and along the rows. Pixels of the border are repeated. `scratch` is
/// resized if it is too small.
void blur_rows(GrayView view, const BlurKernel& kernel, int y0, int y1, BlurScratch& scratch,
               Image<std::uint8_t>& out);

}  // namespace mtstereo
