// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/quality.hpp"

#include <algorithm>
#include <cmath>

#include "lib/outputs/texts.hpp"

namespace mtstereo::calibrate {
namespace {

using outputs::decimal;

constexpr std::size_t kFewViews = 15;
constexpr double kLittleTilt = 0.7;      // of what Coverage wants
constexpr double kLittleCoverage = 0.7;  // of what Coverage wants
constexpr double kUncertain = 0.005;     // of focal length and baseline
constexpr double kUnstable = 0.01;       // of both, between two sets of views
constexpr double kManyRemoved = 0.2;     // of the views
// A matcher tolerates rows that agree to this; half a pixel costs density.
constexpr double kGoodRows = 0.25;   // [px]
constexpr double kUsableRows = 0.5;  // [px]
constexpr double kGoodTail = 1.0;    // [px], 95 %
// Of the reprojection, for images of 640 px; larger images have larger errors in pixels.
constexpr double kHighReprojection = 0.5;  // [px]
constexpr double kWidthOfLimits = 640;     // [px]

double limit_scale(const Calibrated& calibrated) {
  return std::max(1.0, calibrated.left_size.width / kWidthOfLimits);
}

void warn_about_views(const Calibrated& calibrated, const Coverage& coverage,
                      std::vector<Warning>& warnings) {
  const std::size_t views = calibrated.solution.views.size();
  if (views < kFewViews) {
    warnings.push_back({"few-views", "only " + std::to_string(views) +
                                         " views were used: small residuals do not prove that the "
                                         "calibration is right; 20 to 40 views give a good one"});
  }
  const Coverage::Progress progress = coverage.progress();
  const std::string advice = coverage.missing();
  const std::string next = advice.empty() ? "" : "; next time, " + advice;
  if (progress.skew < kLittleTilt || progress.size < kLittleTilt / 2) {
    warnings.push_back({"similar-views",
                        "the views are too similar, and leave focal length and "
                        "principal point uncertain" +
                            next});
  }
  if (progress.cells < kLittleCoverage) {
    warnings.push_back(
        {"uncovered-image", "corners cover " + outputs::percent(coverage.left().covered()) +
                                " of the left and " + outputs::percent(coverage.right().covered()) +
                                " of the right image, but one part of them not enough: the "
                                "distortion there is a guess" +
                                next});
  }
  const std::size_t removed = calibrated.solution.removed.size();
  if (static_cast<double>(removed) > kManyRemoved * static_cast<double>(views + removed)) {
    warnings.push_back({"contradictory-views",
                        std::to_string(removed) + " of " + std::to_string(views + removed) +
                            " views contradict the others and were removed: did the board bend, "
                            "or the cameras move?"});
  }
}

void warn_about_fit(const Calibrated& calibrated, std::vector<Warning>& warnings) {
  const double rms = calibrated.solution.result.rms;
  if (rms > kHighReprojection * limit_scale(calibrated)) {
    warnings.push_back({"high-reprojection-error",
                        "the reprojection error of " + decimal(rms, 2) +
                            " px is high: is the board flat, are the images sharp, does the lens "
                            "model fit (--model auto), is the number of squares right?"});
  }
  if (calibrated.wild) {
    warnings.push_back({"wild-distortion",
                        "the lens model that was found turns back within the image, and what is "
                        "beyond that is lost: take views with the board in all parts of the "
                        "image, or choose another --model"});
  }
  if (!calibrated.held_out) {
    warnings.push_back(
        {"nothing-held-out", "fewer than " + std::to_string(kFewestForHoldOut) +
                                 " views: none was held out, so that the row error is that of the "
                                 "views that were used, which is too small"});
    return;
  }
  const double rows = quantile(calibrated.held_out->fit.rows, 0.5);
  if (rows > kUsableRows) {
    warnings.push_back({"high-row-error", "rows of held-out views differ by " + decimal(rows, 2) +
                                              " px: the matcher finds much less than it could"});
  }
  const double change =
      std::max(calibrated.held_out->focal_length_change, calibrated.held_out->baseline_change);
  if (change > kUnstable) {
    warnings.push_back(
        {"unstable", "focal length or baseline change by " + outputs::percent(change, 1) +
                         " if a fifth of the views is left out: take more, different views"});
  }
}

void warn_about_uncertainty(const Calibrated& calibrated, const Quality& quality,
                            std::vector<Warning>& warnings) {
  if (!quality.uncertainty) {
    warnings.push_back({"undetermined",
                        "the views do not determine all parameters: take views "
                        "with the board tilted and in all parts of the image"});
    return;
  }
  const Rig& rig = calibrated.solution.rig;
  const double focal = std::max(quality.uncertainty->left_focal / rig.left.focal(),
                                quality.uncertainty->right_focal / rig.right.focal());
  const double baseline = quality.uncertainty->baseline / rig.baseline();
  if (focal > kUncertain) {
    warnings.push_back({"uncertain-focal-length", "the focal length is known to " +
                                                      outputs::percent(focal, 1) +
                                                      " only: take views with more tilt"});
  }
  if (baseline > kUncertain) {
    warnings.push_back({"uncertain-baseline",
                        "the baseline is known to " + outputs::percent(baseline, 1) +
                            " only: take more views, with the board close to the cameras too"});
  }
}

void warn_about_sources(const Calibrated& calibrated, const Quality& quality,
                        std::vector<Warning>& warnings) {
  if (quality.offset && quality.offset->significant()) {
    const double ms = 1000 * quality.offset->seconds;
    warnings.push_back({"not-synchronized",
                        "the cameras are not synchronized: the right one exposes about " +
                            decimal(std::abs(ms), 0) + " ms " + (ms > 0 ? "later" : "earlier") +
                            ". Disparities of everything that moves will be wrong"});
  }
  if (calibrated.swapped) {
    warnings.push_back({"swapped-inputs",
                        "the source that was given as the left one is the right camera. The "
                        "calibration is written for the right order: exchange the two sources "
                        "wherever you use it"});
  }
}

Grade grade_of(const Calibrated& calibrated, const Quality& quality) {
  const Fit& fit = calibrated.held_out ? calibrated.held_out->fit : calibrated.fit;
  const double median = quantile(fit.rows, 0.5);
  const double tail = quantile(fit.rows, 0.95);
  if (median > kUsableRows || !quality.uncertainty) return Grade::kPoor;
  const bool doubts =
      std::any_of(quality.warnings.begin(), quality.warnings.end(),
                  [](const Warning& each) { return each.name != "swapped-inputs"; });
  const bool good = median <= kGoodRows && tail <= kGoodTail && !doubts;
  return good ? Grade::kGood : Grade::kUsable;
}

}  // namespace

double DepthError::total() const { return std::hypot(matching, calibration.value_or(0)); }

const char* grade_name(Grade grade) {
  switch (grade) {
    case Grade::kGood:
      return "good";
    case Grade::kUsable:
      return "usable";
    case Grade::kPoor:
      break;
  }
  return "poor";
}

Quality judge(const Calibrated& calibrated, const Coverage& coverage,
              const std::optional<TimeOffset>& offset) {
  Quality quality;
  quality.uncertainty = uncertainty_of(calibrated.solution);
  quality.offset = offset;
  const Rectification& rectified = calibrated.rectification;
  for (const double depth : {1.0, 2.0, 5.0, 10.0}) {
    DepthError error;
    error.depth = depth;
    error.matching =
        depth * depth * kDisparityError / (rectified.focal_length * rectified.baseline);
    error.calibration = depth_uncertainty(calibrated.solution, depth);
    quality.depths.push_back(error);
  }
  warn_about_views(calibrated, coverage, quality.warnings);
  warn_about_fit(calibrated, quality.warnings);
  warn_about_uncertainty(calibrated, quality, quality.warnings);
  warn_about_sources(calibrated, quality, quality.warnings);
  quality.grade = grade_of(calibrated, quality);
  return quality;
}

}  // namespace mtstereo::calibrate
