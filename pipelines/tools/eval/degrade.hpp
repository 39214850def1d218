// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "tools/eval/datasets.hpp"
#include "tools/eval/degradation.hpp"

namespace mtstereo::eval {

/// Adds Gaussian noise to an 8-bit image. The seed determines the noise.
void add_noise(double sigma, std::uint64_t seed, cv::Mat& image);

/// A degraded pair and the search range that it needs.
struct DegradedPair {
  LoadedPair images;
  int max_disparity = 0;  ///< [px]
};

/// The degraded views of a pair (CV_8UC1, same size), with its truth and search range. If the kind
/// enlarges the views, the truth, its masks, its scale and the range are enlarged too; otherwise
/// they are those of the pair. The result depends on the arguments only: seeds are fixed, and the
/// noise of the two views differs. `pair` is not changed. Throws UserError if a part that the kind
/// needs is missing, see degradation_obstacle().
DegradedPair degrade(const Degradation& degradation, const LoadedPair& pair, int max_disparity);

}  // namespace mtstereo::eval
