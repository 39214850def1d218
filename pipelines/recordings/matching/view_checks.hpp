// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"

// What is wrong with the views of a recording. Every claim was tested: what it suggests matches
// clearly better than what is there.

namespace mtstereo::run {

/// A right view of another time than the left one.
struct ShiftedView {
  int frames = 0;  ///< later; negative: earlier
  cv::Mat view;
};

/// The views of one pair: gray images of kMatchedWidth, as the cameras deliver them.
struct ViewSample {
  cv::Mat left, right;
  std::vector<ShiftedView> shifted;  ///< the same ones in all samples; a view may be empty
};

/// What diagnose() needs.
struct ViewSamples {
  std::vector<ViewSample> samples;
  double scale = 1;       ///< px of the frames per px of the images
  int min_disparity = 0;  ///< of the frames [px]
  int max_disparity = 0;  ///< of the frames [px]
  /// Rectifies the views; none: they are taken as they are.
  std::optional<StereoCalibration> calibration;
  /// Rows that are out of place are corrected, so they are not a problem.
  bool rows_corrected = false;
};

/// What can be wrong.
enum class ViewProblem {
  kNone,              ///< the views match
  kUnknown,           ///< they do not match, and nothing that was tested makes them match
  kTooLittleTexture,  ///< there are too few corners for any test
  kSwapped,           ///< the left view is the right one
  kRangeTooSmall,     ///< many disparities are beyond the range
  kUpsideDown,        ///< one view is turned by 180 degrees
  kMirrored,          ///< one view has left and right exchanged
  kFlipped,           ///< one view has top and bottom exchanged
  kOutOfStep,         ///< views of other frames match better
  kNotRectified,      ///< the views match, but not along rows
  kWrongCalibration,  ///< the views match, but not along rows after they are rectified
  kSameView,          ///< both views are the same image
};

/// A problem, and the figures that belong to it.
struct ViewDiagnosis {
  ViewProblem problem = ViewProblem::kNone;
  double matched = 0;     ///< of the corners, as the views are [0 .. 1]
  double better = 0;      ///< of the corners, in the test that matched better [0 .. 1]
  int max_disparity = 0;  ///< kRangeTooSmall: what suffices [px of the frames]
  int frames = 0;         ///< kOutOfStep: the right view that fits is so many frames later
  /// The rows of nearly all points, right minus left [px of the frames].
  double least_rows = 0, most_rows = 0;

  /// The results are useless.
  bool worthless() const;
};

/// Finds what is wrong with views that match badly. Throws UserError.
ViewDiagnosis diagnose(const ViewSamples& views);

/// What is wrong, and what to do about it: sentences for the user, or empty.
struct Advice {
  std::string problem, remedy;
};

/// What to say about a diagnosis; empty for kNone. `calibration`: that of the recording, or empty.
/// `two`: the views are in two sources whose clocks were not compared.
Advice diagnosis_advice(const ViewDiagnosis& diagnosis, const std::string& calibration, bool two);
/// The same as one text.
std::string diagnosis_text(const ViewDiagnosis& diagnosis, const std::string& calibration,
                           bool two);

}  // namespace mtstereo::run
