// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

#include "frames.hpp"
#include "mtstereo/matcher.hpp"

namespace mtstereo::bench {

/// What the library made of a frame, as a copy.
struct Outcome {
  cv::Mat disparity;   ///< CV_32SC1 [1 / kDisparityOne px]
  cv::Mat confidence;  ///< CV_8UC1
};

/// Copies.
Outcome outcome_of(DisparityView disparity, GrayView confidence);

/// Share of pixels with a disparity, 0 .. 1: of the library's maps (CV_32SC1), and of OpenCV's
/// (CV_32FC1, NaN = none).
double density_of(const cv::Mat& disparity);

/// Throws std::runtime_error where nothing was found, for then nothing was worth timing.
void require_density(const cv::Mat& disparity);

/// Throws std::runtime_error, naming the first pixel, where the two are not the same byte for byte.
/// `what` begins the sentence, as in "1 and 2 threads".
void require_same(const std::string& what, const Outcome& expected, const Outcome& actual);

/// What the benchmarks set. Throws std::runtime_error where a value is refused.
Parameters parameters_of(const char* preset, const char* mode, int disparities, int threads);

/// A matcher. Throws std::runtime_error where there is none to be had.
Matcher make_matcher(const Parameters& parameters);

/// Matches a pair. Throws std::runtime_error with the library's sentence.
DisparityView match(Matcher& matcher, const Pair& pair);

}  // namespace mtstereo::bench
