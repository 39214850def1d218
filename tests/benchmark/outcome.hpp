// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

#include "frames.hpp"
#include "mtstereo/matcher.hpp"

namespace mtstereo::bench {

/// A copy of the library's result for a frame.
struct Outcome {
  cv::Mat disparity;   ///< CV_32SC1 [1 / kDisparityOne px]
  cv::Mat confidence;  ///< CV_8UC1
};

/// Copies a result.
Outcome outcome_of(const FrameResult& result);

/// The fraction of pixels with a disparity, 0 .. 1, of a map of the library (CV_32SC1) or of OpenCV
/// (CV_32FC1, NaN = none).
double density_of(const cv::Mat& disparity);

/// Throws std::runtime_error if a map has no disparity, because its time is meaningless.
void require_density(const cv::Mat& disparity);

/// Throws std::runtime_error, naming the first differing pixel, unless the two are equal byte for
/// byte. `what` starts the sentence, such as "1 and 2 threads".
void require_same(const std::string& what, const Outcome& expected, const Outcome& actual);

/// The parameters of a benchmark. Throws std::runtime_error if a value is invalid.
Parameters parameters_of(const char* preset, const char* mode, int disparities, int threads);

/// Creates a matcher. Throws std::runtime_error if that fails.
Matcher make_matcher(const Parameters& parameters);

/// Matches a pair. Throws std::runtime_error with the library's message.
FrameResult match(Matcher& matcher, const Pair& pair);

}  // namespace mtstereo::bench
