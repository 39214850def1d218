// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/checks/rows_image.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "alignment/pair_inspection.hpp"
#include "recordings/inputs/view_rectifier.hpp"
#include "recordings/matching/recorded_views.hpp"
#include "recordings/matching/work_options.hpp"
#include "recordings/media/sample_frames.hpp"

namespace mtstereo::run {
namespace {

constexpr int kWidth = 960;   // of a view, at most [px]
constexpr int kGap = 8;       // between the views [px]
constexpr int kLines = 40;    // points that are connected, at most
constexpr double kLevel = 1;  // rows that differ by less agree [px]
const cv::Scalar kGreen(80, 200, 80), kRed(60, 60, 220), kWhite(255, 255, 255);

cv::Mat side_by_side(const cv::Mat& left, const cv::Mat& right) {
  cv::Mat image(left.rows, left.cols + kGap + right.cols, CV_8UC3, kWhite);
  cv::cvtColor(left, image(cv::Rect({}, left.size())), cv::COLOR_GRAY2BGR);
  cv::cvtColor(right, image(cv::Rect({left.cols + kGap, 0}, right.size())), cv::COLOR_GRAY2BGR);
  return image;
}

}  // namespace

cv::Mat draw_rows(const Work& work) {
  RecordedViews views(work, kWidth);
  const FramePair frames = frames_of(work, static_cast<std::int64_t>(work.pairs.pairs.size()) / 2);
  cv::Mat left = views.left(frames.left), right = views.right(frames.right);
  if (const auto calibration = rectifying_calibration(work)) {
    left = ViewRectifier(*calibration, Rectifier::Side::kLeft).apply(left);
    right = ViewRectifier(*calibration, Rectifier::Side::kRight).apply(right);
  }
  if (left.empty() || left.size() != right.size()) return {};
  const double scale = std::max(1.0, static_cast<double>(view_size(work).width) / kWidth);
  const Parameters parameters = matcher_parameters(work.options);
  const auto scaled = [scale](int length) { return static_cast<int>(std::ceil(length / scale)); };
  PairInspector inspector;
  inspector.inspect(view_of(left), view_of(right),
                    std::max(1, scaled(parameters.integer(Parameter::kMaxDisparity))));
  cv::Mat image = side_by_side(left, right);
  const auto matches = inspector.matches();
  const std::size_t step = matches.size() / kLines + 1;
  for (std::size_t i = 0; i < matches.size(); i += step) {
    const Match& match = matches[i];
    const auto row = static_cast<double>(match.y_left);
    const cv::Point from(cv::Point2d(match.x_left, row));
    const cv::Point to(cv::Point2d(left.cols + kGap + match.x_right, row + match.rows));
    const cv::Scalar color = std::abs(match.rows) * scale < kLevel ? kGreen : kRed;
    cv::line(image, from, to, color, 1, cv::LINE_AA);
    for (const cv::Point& point : {from, to}) cv::circle(image, point, 3, color, 1, cv::LINE_AA);
  }
  return image;
}

}  // namespace mtstereo::run
