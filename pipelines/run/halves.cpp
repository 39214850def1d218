// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run/halves.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "mtstereo/matcher.hpp"
#include "run/run_error.hpp"

namespace mtstereo::run {

namespace {

constexpr int kWidth = 480;     // of a view that is matched, at most [px]
constexpr int kRange = 96;      // of disparities [px]
constexpr double kLeast = 0.1;  // density of views that match
constexpr double kFactor = 2;   // between densities that differ clearly

GrayView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

template <typename T>
T value_of(Result<T> result) {
  if (!result) throw RunError("the halves cannot be matched: " + result.error().message);
  return std::move(*result);
}

double density(Matcher& matcher, const cv::Mat& left, const cv::Mat& right) {
  value_of(matcher.compute(view_of(left), view_of(right)));
  return matcher.statistics().density;
}

cv::Mat half_of(const cv::Mat& frame, Arrangement arrangement, int number) {
  const bool beside = arrangement == Arrangement::kSideBySide;
  const cv::Size size(beside ? frame.cols / 2 : frame.cols, beside ? frame.rows : frame.rows / 2);
  const cv::Mat half = frame({number * (beside ? size.width : 0),
                              number * (beside ? 0 : size.height), size.width, size.height});
  const double scale = std::min(1.0, static_cast<double>(kWidth) / size.width);
  cv::Mat small;
  cv::resize(half, small, {}, scale, scale, cv::INTER_AREA);
  return small;
}

}  // namespace

bool HalvesMatch::confirmed() const {
  const double best = std::max(forward, backward);
  return best >= kLeast && best >= kFactor * unrelated;
}

bool HalvesMatch::swapped() const { return backward >= kFactor * forward; }

std::optional<Arrangement> arrangement_by_shape(int width, int height) {
  // Halves of a side-by-side frame are at least square, views of one camera at most 16:9.
  if (10 * width >= 19 * height) return Arrangement::kSideBySide;
  if (width <= height) return Arrangement::kTopBottom;
  return std::nullopt;
}

HalvesMatch match_halves(const std::vector<cv::Mat>& frames, Arrangement arrangement) {
  Parameters parameters;
  if (!parameters.set(Parameter::kMaxDisparity, kRange)) {
    throw RunError("the halves cannot be matched: the range of disparities is refused");
  }
  Matcher matcher = value_of(Matcher::create(parameters));
  HalvesMatch match;
  for (const cv::Mat& frame : frames) {
    const cv::Mat first = half_of(frame, arrangement, 0), second = half_of(frame, arrangement, 1);
    cv::Mat upside_down;
    cv::flip(second, upside_down, 0);
    match.forward += density(matcher, first, second);
    match.backward += density(matcher, second, first);
    match.unrelated += density(matcher, first, upside_down);
  }
  const auto count = static_cast<double>(std::max<std::size_t>(frames.size(), 1));
  for (double* sum : {&match.forward, &match.backward, &match.unrelated}) *sum /= count;
  return match;
}

}  // namespace mtstereo::run
