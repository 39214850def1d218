// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/drawings.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo::calibrate {
namespace {

const cv::Scalar kGreen(80, 200, 80);
const cv::Scalar kRed(60, 60, 220);
const cv::Scalar kWhite(255, 255, 255);
const cv::Scalar kGray(160, 160, 160);
const cv::Scalar kBlack(0, 0, 0);
constexpr int kGap = 8;  // between the images of both sides [px]
constexpr int kResidualSize = 400;
constexpr double kResidualRange = 2;  // from the center to the edge [px]

cv::Mat in_color(const cv::Mat& gray) {
  cv::Mat color;
  cv::cvtColor(gray, color, cv::COLOR_GRAY2BGR);
  return color;
}

cv::Mat side_by_side(const cv::Mat& left, const cv::Mat& right) {
  cv::Mat result(std::max(left.rows, right.rows), left.cols + kGap + right.cols, CV_8UC3, kWhite);
  left.copyTo(result(cv::Rect({}, left.size())));
  right.copyTo(result(cv::Rect({left.cols + kGap, 0}, right.size())));
  return result;
}

cv::Mat with_corners(const cv::Mat& gray, const Corners& corners) {
  cv::Mat image = in_color(gray);
  const int radius = std::max(3, gray.cols / 160);
  for (const cv::Point2f& pixel : corners.pixels) {
    cv::circle(image, pixel, radius, kGreen, std::max(1, radius / 3), cv::LINE_AA);
  }
  return image;
}

cv::Mat draw_grid(const CoverageGrid& grid, const std::vector<BoardView>& views, bool left,
                  cv::Size size) {
  cv::Mat image(size, CV_8UC3, kWhite);
  for (int row = 0; row < CoverageGrid::kRows; ++row) {
    for (int column = 0; column < CoverageGrid::kColumns; ++column) {
      const cv::Point from(column * size.width / CoverageGrid::kColumns,
                           row * size.height / CoverageGrid::kRows);
      const cv::Point to((column + 1) * size.width / CoverageGrid::kColumns,
                         (row + 1) * size.height / CoverageGrid::kRows);
      const int count = grid.corners(column, row);
      // Pale green for one corner, full green for 40 and more.
      const double part = count == 0 ? 0 : 0.3 + 0.7 * std::min(1.0, count / 40.0);
      const cv::Scalar color = kWhite * (1 - part) + kGreen * part;
      cv::rectangle(image, from, to, color, cv::FILLED);
      cv::rectangle(image, from, to, kGray, 1);
    }
  }
  for (const BoardView& view : views) {
    for (const Observation& each : left ? view.left : view.right) {
      cv::circle(image, cv::Point2d(each.pixel.x(), each.pixel.y()), 1, kBlack, cv::FILLED);
    }
  }
  return image;
}

cv::Mat rectify_view(const Calibrated& calibrated, Rectifier::Side side, const cv::Mat& gray) {
  Result<Rectifier> rectifier =
      Rectifier::create(calibration_of(calibrated.solution.rig), calibrated.rectification, side);
  if (!rectifier) return {};
  cv::Mat result(calibrated.rectification.height, calibrated.rectification.width, CV_8UC1);
  const ImageView<const std::uint8_t> in{gray.data, gray.cols, gray.rows,
                                         static_cast<std::ptrdiff_t>(gray.step)};
  const ImageView<std::uint8_t> out{result.data, result.cols, result.rows,
                                    static_cast<std::ptrdiff_t>(result.step)};
  if (!rectifier->apply(in, out)) return {};
  return in_color(result);
}

cv::Mat draw_scatter(const std::vector<Eigen::Vector2d>& residuals) {
  constexpr double kScale = kResidualSize / (2 * kResidualRange);
  const cv::Point2d center(kResidualSize / 2.0, kResidualSize / 2.0);
  cv::Mat image(kResidualSize, kResidualSize, CV_8UC3, kWhite);
  for (double radius = 0.5; radius <= kResidualRange; radius += 0.5) {
    cv::circle(image, center, static_cast<int>(radius * kScale), kGray, 1, cv::LINE_AA);
  }
  for (const Eigen::Vector2d& each : residuals) {
    cv::circle(image, center + kScale * cv::Point2d(each.x(), each.y()), 1, kRed, cv::FILLED);
  }
  return image;
}

}  // namespace

cv::Mat draw_views(const ImagePair& images, const CornerPair& corners) {
  return side_by_side(with_corners(images.left, corners.left),
                      with_corners(images.right, corners.right));
}

cv::Mat draw_coverage(const Coverage& coverage, const std::vector<BoardView>& views, cv::Size left,
                      cv::Size right) {
  return side_by_side(draw_grid(coverage.left(), views, true, left),
                      draw_grid(coverage.right(), views, false, right));
}

cv::Mat draw_rectified(const Calibrated& calibrated, const cv::Mat& left, const cv::Mat& right) {
  const cv::Mat first = rectify_view(calibrated, Rectifier::Side::kLeft, left);
  const cv::Mat second = rectify_view(calibrated, Rectifier::Side::kRight, right);
  if (first.empty() || second.empty()) return {};
  cv::Mat image = side_by_side(first, second);
  const int step = std::max(8, image.rows / 20);
  for (int y = step / 2; y < image.rows; y += step) {
    cv::line(image, {0, y}, {image.cols - 1, y}, kGreen, 1);
  }
  return image;
}

cv::Mat draw_residuals(const Solution& solution) {
  std::vector<Eigen::Vector2d> lefts, rights;
  for (const BoardView& view : solution.views) {
    const auto left = residuals(solution.rig.left, view.pose, view.left);
    const auto right =
        residuals(solution.rig.right, solution.rig.right_from_left * view.pose, view.right);
    lefts.insert(lefts.end(), left.begin(), left.end());
    rights.insert(rights.end(), right.begin(), right.end());
  }
  return side_by_side(draw_scatter(lefts), draw_scatter(rights));
}

}  // namespace mtstereo::calibrate
