// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/view_checks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "alignment/pair_inspection.hpp"
#include "recordings/inputs/view_match.hpp"
#include "recordings/inputs/view_rectifier.hpp"

namespace mtstereo::run {
namespace {

constexpr int kFewestCorners = 40;
constexpr double kFactor = 2;                         // between shares that differ clearly
constexpr double kStepFactor = 1.3, kStepGain = 0.1;  // the same, for views of other frames
constexpr double kRowsGain = 0.03;                    // the same, if only those match along rows
constexpr double kRangeFactor = 1.08;                 // the same, for a larger range
constexpr double kBeyond = 0.05;                      // of the points: disparities beyond the range
constexpr double kWideShare = 0.4;  // of the width, for the test of a larger range
constexpr double kReserve = 1.1;    // of the range that suffices
constexpr int kRangeStep = 16;      // the range that suffices is a multiple of it [px]
constexpr double kSameGray = 0.75;  // mean difference of images that are the same [gray values]
constexpr double kSameShare = 0.5;  // the same, of the difference from the image one pixel away

cv::Mat flipped(const cv::Mat& view, int code) {
  cv::Mat result;
  cv::flip(view, result, code);
  return result;
}

cv::Mat halved(const cv::Mat& view) {
  cv::Mat result;
  cv::resize(view, result, {}, 0.5, 0.5, cv::INTER_AREA);
  return result;
}

bool clearly_better(const ViewMatch& match, const ViewMatch& than) {
  return match.confirmed() && match.share() >= kFactor * than.share();
}

// A view with the brightness and the contrast of another one.
cv::Mat as_bright_as(const cv::Mat& other, const cv::Mat& view) {
  cv::Scalar mean, deviation, wanted_mean, wanted_deviation;
  cv::meanStdDev(view, mean, deviation);
  cv::meanStdDev(other, wanted_mean, wanted_deviation);
  const double gain = deviation[0] > 0 ? wanted_deviation[0] / deviation[0] : 1;
  cv::Mat result;
  view.convertTo(result, CV_8U, gain, wanted_mean[0] - gain * mean[0]);
  return result;
}

// Whether both views of a pair are one image, also if it was encoded twice or with another range.
bool is_same(const ViewSample& pair) {
  const cv::Mat& left = pair.left;
  if (left.size() != pair.right.size()) return false;
  const int columns = left.cols;
  const double shifted =
      cv::norm(left.colRange(1, columns), left.colRange(0, columns - 1), cv::NORM_L1);
  const double most = std::max(kSameGray * static_cast<double>(left.total()), kSameShare * shifted);
  return cv::norm(left, as_bright_as(left, pair.right), cv::NORM_L1) <= most;
}

struct ViewPair {
  cv::Mat left, right;
};

class Checks {
 public:
  explicit Checks(const ViewSamples& input) : input_(input) {
    if (!input.calibration) return;
    left_.emplace(*input.calibration, Rectifier::Side::kLeft);
    right_.emplace(*input.calibration, Rectifier::Side::kRight);
  }

  ViewDiagnosis run() {
    const int width = input_.samples.empty() ? 1 : input_.samples.front().left.cols;
    const auto small = [&](double length) {
      return static_cast<int>(std::ceil(length / input_.scale));
    };
    range_ = {small(input_.min_disparity), std::max(1, small(input_.max_disparity))};
    wide_ = {range_.least, std::max(2 * range_.most, static_cast<int>(kWideShare * width))};
    now_ = rectified(range_);
    result_.matched = now_.share();
    set_rows(now_, input_.scale);
    if (now_.corners < kFewestCorners) return is(ViewProblem::kTooLittleTexture);
    if (same_view()) return is(ViewProblem::kSameView);
    wider_ = rectified(wide_);
    for (const auto find : {&Checks::find_order, &Checks::find_turn, &Checks::find_step,
                            &Checks::find_range, &Checks::find_rows}) {
      if ((this->*find)()) return result_;
    }
    return is(now_.confirmed() ? ViewProblem::kNone : ViewProblem::kUnknown);
  }

 private:
  ViewMatch match(SearchRange range, const std::function<ViewPair(const ViewSample&)>& views) {
    ViewMatch found;
    for (const ViewSample& sample : input_.samples) {
      const ViewPair pair = views(sample);
      matcher_.add(pair.left, pair.right, range, found);
    }
    return found;
  }
  ViewPair rectified(const cv::Mat& left, const cv::Mat& right) {
    return {left_ ? left_->apply(left) : left, right_ ? right_->apply(right) : right};
  }
  ViewMatch rectified(SearchRange range) {
    return match(range, [&](const ViewSample& s) { return rectified(s.left, s.right); });
  }

  ViewDiagnosis is(ViewProblem problem) {
    result_.problem = problem;
    return result_;
  }
  bool claim(ViewProblem problem, const ViewMatch& better) {
    result_.problem = problem;
    result_.better = better.share();
    return true;
  }
  void set_rows(const ViewMatch& match, double scale) {
    result_.least_rows = scale * match.row_at(kRowOutliers);
    result_.most_rows = scale * match.row_at(1 - kRowOutliers);
  }

  // All rows differ alike, by more than is searched.
  bool far_rows() const {
    return std::min(std::abs(result_.least_rows), std::abs(result_.most_rows)) >
           kSearchedRows * input_.scale;
  }

  bool same_view() const {
    return std::all_of(input_.samples.begin(), input_.samples.end(), is_same);
  }

  // The other order must match along rows: views that are not rectified can have disparities of
  // both signs in either order.
  bool find_order() {
    const ViewMatch other =
        match(wide_, [&](const ViewSample& s) { return rectified(s.right, s.left); });
    return is_better_order(other, wider_) && claim(ViewProblem::kSwapped, other);
  }

  bool find_turn() {
    constexpr std::pair<ViewProblem, int> kTurns[] = {
        {ViewProblem::kUpsideDown, -1}, {ViewProblem::kMirrored, 1}, {ViewProblem::kFlipped, 0}};
    for (const auto& [problem, code] : kTurns) {
      const int how = code;
      const ViewMatch turned = match(
          wide_, [&](const ViewSample& s) { return rectified(s.left, flipped(s.right, how)); });
      if (clearly_better(turned, wider_)) return claim(problem, turned);
    }
    return false;
  }

  bool find_step() {
    if (input_.samples.empty()) return false;
    ViewMatch best;
    for (std::size_t i = 0; i < input_.samples.front().shifted.size(); ++i) {
      const ViewMatch shifted = match(range_, [&](const ViewSample& s) {
        return i < s.shifted.size() ? rectified(s.left, s.shifted[i].view) : ViewPair{};
      });
      if (shifted.share() <= best.share()) continue;
      best = shifted;
      result_.frames = input_.samples.front().shifted[i].frames;
    }
    const bool clearly =
        best.share() >= kStepFactor * now_.share() && best.share() >= now_.share() + kStepGain;
    // Only views of the same time match along rows.
    const bool by_rows = best.aligned() && wider_.confirmed() && !wider_.aligned() &&
                         best.share() >= now_.share() + kRowsGain;
    return best.confirmed() && (clearly || by_rows) && claim(ViewProblem::kOutOfStep, best);
  }

  bool find_range() {
    const auto beyond = std::count_if(
        wider_.disparities.begin(), wider_.disparities.end(),
        [&](float disparity) { return disparity > static_cast<float>(range_.most + 1); });
    const auto points = static_cast<double>(std::max<std::size_t>(wider_.disparities.size(), 1));
    if (!wider_.aligned() || wider_.agreeing < kRangeFactor * now_.agreeing ||
        static_cast<double>(beyond) < kBeyond * points) {
      return false;
    }
    constexpr double kNearly = 0.98;
    const double wanted = kReserve * input_.scale * wider_.disparity_at(kNearly);
    result_.max_disparity = kRangeStep * static_cast<int>(std::ceil(wanted / kRangeStep));
    return result_.max_disparity > input_.max_disparity &&
           claim(ViewProblem::kRangeTooSmall, wider_);
  }

  bool find_rows() {
    if (input_.rows_corrected) return false;
    if (wider_.confirmed()) {
      set_rows(wider_, input_.scale);
      return !wider_.aligned() &&
             claim(input_.calibration ? ViewProblem::kWrongCalibration : ViewProblem::kNotRectified,
                   wider_);
    }
    // Points of views that are not rectified have disparities of both signs, and rows farther away
    // than the search in the images reaches.
    for (const int factor : {1, 2}) {
      const ViewMatch raw = match({-wide_.most / factor, wide_.most / factor}, [&](const auto& s) {
        return factor == 1 ? ViewPair{s.left, s.right} : ViewPair{halved(s.left), halved(s.right)};
      });
      if (!clearly_better(raw, wider_)) continue;
      set_rows(raw, input_.scale * factor);
      if (input_.calibration) return claim(ViewProblem::kWrongCalibration, raw);
      if (!raw.aligned() || far_rows()) return claim(ViewProblem::kNotRectified, raw);
    }
    return false;
  }

  const ViewSamples& input_;
  std::optional<ViewRectifier> left_, right_;
  ViewMatcher matcher_;
  SearchRange range_, wide_;
  ViewMatch now_, wider_;
  ViewDiagnosis result_;
};

}  // namespace

bool ViewDiagnosis::worthless() const {
  switch (problem) {
    case ViewProblem::kNone:
    case ViewProblem::kUnknown:
    case ViewProblem::kTooLittleTexture:
    case ViewProblem::kRangeTooSmall:
      return false;
    default:
      return true;
  }
}

ViewDiagnosis diagnose(const ViewSamples& views) { return Checks(views).run(); }

}  // namespace mtstereo::run
