// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include "base/bands.hpp"

namespace mtstereo {

/// A width and a height [px].
struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize&) const = default;

  /// Rows of a full band, or of the image if it has fewer.
  int band_rows() const { return std::min(Bands::kRows, height); }
};

/// What determines the sizes of the memory, beside the settings.
struct FrameSize {
  ImageSize input;    ///< of the caller's views and the result
  ImageSize frame;    ///< of the input views after their shift by the smallest disparity
  ImageSize matched;  ///< of the matched views: the frame's size or half of it
  int threads = 1;
};

}  // namespace mtstereo
