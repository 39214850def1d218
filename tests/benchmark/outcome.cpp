// SPDX-License-Identifier: LGPL-2.1-or-later
#include "outcome.hpp"

#include <stdexcept>
#include <utility>

namespace mtstereo::bench {
namespace {

template <typename T>
cv::Mat copy_of(ImageView<const T> view, int type) {
  return cv::Mat(view.height, view.width, type, const_cast<T*>(view.data),
                 static_cast<std::size_t>(view.stride))
      .clone();
}

template <typename T>
void require_same_image(const std::string& what, const cv::Mat& expected, const cv::Mat& actual) {
  if (expected.size() != actual.size() || expected.type() != actual.type()) {
    throw std::runtime_error(what + " differ in size or type");
  }
  for (int y = 0; y < expected.rows; ++y) {
    for (int x = 0; x < expected.cols; ++x) {
      const T one = expected.at<T>(y, x);
      const T other = actual.at<T>(y, x);
      if (one == other) continue;
      throw std::runtime_error(what + " differ, first at (" + std::to_string(x) + ", " +
                               std::to_string(y) + "): " + std::to_string(one) + " and " +
                               std::to_string(other));
    }
  }
}

void require(const Status& status) {
  if (!status) throw std::runtime_error(status.error().message);
}

}  // namespace

Outcome outcome_of(const FrameResult& result) {
  return {copy_of(result.disparity, CV_32SC1), copy_of(result.confidence, CV_8UC1)};
}

double density_of(const cv::Mat& disparity) {
  if (disparity.empty()) return 0;
  // NaN does not equal itself.
  const cv::Mat known =
      disparity.type() == CV_32FC1 ? disparity == disparity : disparity != kNoDisparity;
  return static_cast<double>(cv::countNonZero(known)) / static_cast<double>(known.total());
}

void require_density(const cv::Mat& disparity) {
  if (density_of(disparity) > 0) return;
  throw std::runtime_error("the result has no disparity");
}

void require_same(const std::string& what, const Outcome& expected, const Outcome& actual) {
  require_same_image<std::int32_t>(what + ": the disparities", expected.disparity,
                                   actual.disparity);
  require_same_image<std::uint8_t>(what + ": the confidences", expected.confidence,
                                   actual.confidence);
}

Parameters parameters_of(const char* preset, const char* mode, int disparities, int threads) {
  Parameters parameters;
  require(parameters.set("preset", preset));
  require(parameters.set("mode", mode));
  require(parameters.set(Parameter::kMaxDisparity, disparities));
  require(parameters.set(Parameter::kThreads, threads));
  return parameters;
}

Matcher make_matcher(const Parameters& parameters) {
  Result<Matcher> matcher = Matcher::create(parameters);
  if (!matcher) throw std::runtime_error(matcher.error().message);
  return std::move(*matcher);
}

FrameResult match(Matcher& matcher, const Pair& pair) {
  const Result<FrameResult> result = matcher.compute(view_of(pair.left), view_of(pair.right));
  if (!result) throw std::runtime_error(result.error().message);
  return *result;
}

}  // namespace mtstereo::bench
