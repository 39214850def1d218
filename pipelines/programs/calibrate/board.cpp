// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/board.hpp"

#include <cmath>

#include "lib/outputs/texts.hpp"
#include "programs/calibrate/charuco.hpp"

namespace mtstereo::calibrate {
namespace {

constexpr int kMostSquares = 100;
constexpr double kSmallestSquare = 0.001;  // [m]
constexpr double kLargestSquare = 1;       // [m]
constexpr double kLargestMarker = 0.95;    // of a square

std::string millimeters(double meters) {
  std::string text = outputs::decimal(1000 * meters, 3);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text + " mm";
}

std::string check_markers(const BoardOptions& options) {
  const int size = dictionary_size(options.dictionary);
  if (size == 0) {
    std::string names;
    for (const std::string& name : dictionary_names()) names += (names.empty() ? "" : ", ") + name;
    return "no dictionary '" + options.dictionary + "'; there are " + names;
  }
  const int markers = options.columns * options.rows / 2;
  if (markers > size) {
    return "the board has " + std::to_string(markers) + " markers, but the dictionary " +
           options.dictionary + " only " + std::to_string(size);
  }
  if (options.marker_side() > kLargestMarker * options.square) {
    return "markers of " + millimeters(options.marker_side()) + " do not fit into squares of " +
           millimeters(options.square);
  }
  return {};
}

}  // namespace

std::string check(const BoardOptions& options) {
  if (options.columns < 3 || options.rows < 3 || options.columns > kMostSquares ||
      options.rows > kMostSquares) {
    return "a board of " + std::to_string(options.columns) + "x" + std::to_string(options.rows) +
           " squares; it needs 3 to " + std::to_string(kMostSquares) + " in each direction";
  }
  if (!(options.square >= kSmallestSquare && options.square <= kLargestSquare)) {
    return "squares of " + millimeters(options.square) +
           "; the unit is mm, and a square has 1 to 1000 mm";
  }
  if (options.kind == BoardKind::kCharuco) return check_markers(options);
  if (options.columns == options.rows) {
    return "a checkerboard needs different numbers of columns and rows, or its orientation is "
           "ambiguous";
  }
  return {};
}

std::string describe(const BoardOptions& options) {
  std::string text = options.kind == BoardKind::kCharuco ? "ChArUco board" : "checkerboard";
  text += " of " + std::to_string(options.columns) + "x" + std::to_string(options.rows) +
          " squares of " + millimeters(options.square);
  if (options.kind == BoardKind::kCharuco) {
    text +=
        ", markers of " + millimeters(options.marker_side()) + ", dictionary " + options.dictionary;
  }
  return text;
}

std::vector<Eigen::Vector3d> corner_points(const BoardOptions& options) {
  std::vector<Eigen::Vector3d> points;
  for (int row = 1; row < options.rows; ++row) {
    for (int column = 1; column < options.columns; ++column) {
      points.emplace_back(column * options.square, row * options.square, 0);
    }
  }
  return points;
}

std::vector<cv::Rect2d> black_rectangles(const BoardOptions& options) {
  std::vector<cv::Rect2d> result;
  // The upper left square is black.
  for (int row = 0; row < options.rows; ++row) {
    for (int column = row % 2; column < options.columns; column += 2) {
      result.emplace_back(column * options.square, row * options.square, options.square,
                          options.square);
    }
  }
  if (options.kind == BoardKind::kCharuco) {
    const std::vector<cv::Rect2d> markers = marker_rectangles(options);
    result.insert(result.end(), markers.begin(), markers.end());
  }
  return result;
}

cv::Mat board_image(const BoardOptions& options, int scale, double border) {
  const double pixels = scale / options.square;  // per meter
  const int margin = static_cast<int>(std::lround(border * scale));
  cv::Mat image(options.rows * scale + 2 * margin, options.columns * scale + 2 * margin, CV_8UC1,
                cv::Scalar(255));
  for (const cv::Rect2d& black : black_rectangles(options)) {
    const cv::Point from(static_cast<int>(std::lround(black.x * pixels)),
                         static_cast<int>(std::lround(black.y * pixels)));
    const cv::Point to(static_cast<int>(std::lround((black.x + black.width) * pixels)),
                       static_cast<int>(std::lround((black.y + black.height) * pixels)));
    const cv::Point shift(margin, margin);
    image(cv::Rect(from + shift, to + shift)).setTo(0);
  }
  return image;
}

}  // namespace mtstereo::calibrate
