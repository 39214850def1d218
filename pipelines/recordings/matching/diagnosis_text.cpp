// SPDX-License-Identifier: LGPL-2.1-or-later

// The sentences about a diagnosis.

#include <cmath>
#include <cstdlib>

#include "lib/outputs/texts.hpp"
#include "recordings/matching/view_checks.hpp"

namespace mtstereo::run {
namespace {

// "72 % of the points match instead of 3 %"
std::string comparison(const ViewDiagnosis& found) {
  return outputs::percent(found.better) + " of the points match instead of " +
         outputs::percent(found.matched);
}

std::string rows(const ViewDiagnosis& found) {
  return outputs::format("the rows of the same points differ by %+.1f to %+.1f px",
                         found.least_rows, found.most_rows);
}

std::string frames(int number) {
  return outputs::counted(static_cast<std::size_t>(std::abs(number)), "frame") +
         (number > 0 ? " later" : " earlier");
}

Advice turned(const ViewDiagnosis& found, const char* how) {
  return {std::string("One view is ") + how + ": after undoing this, " + comparison(found) + ".",
          "Turn that camera's frames first, for example with ffmpeg or videoflip."};
}

Advice out_of_step(const ViewDiagnosis& found, bool two) {
  return {"The two views were not taken at the same time: with the right view " +
              frames(found.frames) + ", " + comparison(found) + ".",
          two ? "--sync auto finds the offset of two recorders." : "Synchronize the cameras."};
}

Advice not_rectified(const ViewDiagnosis& found, const std::string& calibration) {
  return {"The views are not rectified: " + rows(found) + ".",
          calibration.empty() ? "Give the calibration of the cameras (--calibration FILE)."
                              : "Rectify them by " + calibration + " (--rectified no)."};
}

Advice wrong_calibration(const ViewDiagnosis& found, const std::string& calibration) {
  const std::string reason = found.matched >= found.better
                                 ? "after the rectification " + rows(found)
                                 : "without the rectification " + comparison(found);
  return {"The calibration " + calibration + " does not fit these views: " + reason + ".",
          "Give that of these cameras, lenses and video size (--calibration FILE)."};
}

Advice range(const ViewDiagnosis& found) {
  return {"The search range is too small: in a larger one, " + comparison(found) + ".",
          "--max-disparity " + std::to_string(found.max_disparity) + " suffices."};
}

Advice unknown(const ViewDiagnosis& found, bool two) {
  return {"Few points of the left view are found in the right one (" +
              outputs::percent(found.matched) +
              "). Neither the other order, nor turned views, a larger range, or frames close in "
              "time match better.",
          std::string("Check that both views show the same scene") +
              (two ? ", at the same time (--sync auto)." : ".")};
}

}  // namespace

Advice diagnosis_advice(const ViewDiagnosis& found, const std::string& calibration, bool two) {
  switch (found.problem) {
    case ViewProblem::kNone:
      return {};
    case ViewProblem::kTooLittleTexture:
      return {"The views have too little texture to check whether they belong together.", ""};
    case ViewProblem::kSwapped:
      return {"The left and the right view are exchanged: in the other order, " +
                  comparison(found) + ".",
              "--swap exchanges them; leave it out if it is set."};
    case ViewProblem::kRangeTooSmall:
      return range(found);
    case ViewProblem::kUpsideDown:
      return turned(found, "upside down");
    case ViewProblem::kMirrored:
      return turned(found, "mirrored, with left and right exchanged");
    case ViewProblem::kFlipped:
      return turned(found, "mirrored, with top and bottom exchanged");
    case ViewProblem::kOutOfStep:
      return out_of_step(found, two);
    case ViewProblem::kNotRectified:
      return not_rectified(found, calibration);
    case ViewProblem::kWrongCalibration:
      return wrong_calibration(found, calibration);
    case ViewProblem::kSameView:
      return {"Both views are the same image.", "Check the inputs."};
    case ViewProblem::kUnknown:
      break;
  }
  return unknown(found, two);
}

std::string diagnosis_text(const ViewDiagnosis& found, const std::string& calibration, bool two) {
  const Advice advice = diagnosis_advice(found, calibration, two);
  return advice.problem + (advice.remedy.empty() ? "" : " " + advice.remedy);
}

}  // namespace mtstereo::run
