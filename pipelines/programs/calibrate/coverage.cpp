// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace mtstereo::calibrate {
namespace {

// The ranges of placements that determine a calibration well, by experience (as in ROS, whose
// range of x is smaller for stereo cameras too: each sees less on one side).
constexpr double kRangeX = 0.5;
constexpr double kRangeY = 0.6;
constexpr double kRangeSize = 0.3;
constexpr double kRangeSkew = 0.4;
constexpr double kCells = 0.7;  // part of the cells of each camera
constexpr double kNinth = 0.3;  // part of the cells of each ninth of an image

// The board in the image: upper left, upper right, lower right, lower left.
std::array<cv::Point2d, 4> outline_of(const Corners& corners, const BoardOptions& board) {
  std::vector<cv::Point2d> points, pixels;
  const int columns = board.columns - 1;
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    points.emplace_back(corners.ids[i] % columns + 1, corners.ids[i] / columns + 1);
    pixels.emplace_back(corners.pixels[i]);
  }
  std::array<cv::Point2d, 4> outline{};
  const cv::Mat homography = cv::findHomography(points, pixels);
  if (homography.empty()) return outline;
  const double right = board.columns;
  const double bottom = board.rows;
  const std::vector<cv::Point2d> ends{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  std::vector<cv::Point2d> seen;
  cv::perspectiveTransform(ends, seen, homography);
  std::copy(seen.begin(), seen.end(), outline.begin());
  return outline;
}

double area_of(const std::array<cv::Point2d, 4>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < 4; ++i) twice += outline[i].cross(outline[(i + 1) % 4]);
  return std::abs(twice) / 2;
}

double ratio_of(cv::Point2d a, cv::Point2d b) {
  return std::log(std::max(cv::norm(a), 1e-3) / std::max(cv::norm(b), 1e-3));
}

// 0 .. 1 of the positions that a board of this extent can take.
double position(double center, double extent, double image) {
  if (extent >= image) return 0.5;
  return std::clamp((center - extent / 2) / (image - extent), 0.0, 1.0);
}

struct Range {
  double low = 1, high = 0;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double part_of(double wanted) const { return std::clamp((high - low) / wanted, 0.0, 1.0); }
};

std::string direction(int column, int row) {
  constexpr std::array kRows{"upper", "", "lower"};
  constexpr std::array kColumns{"left", "", "right"};
  std::string text = kRows.at(static_cast<std::size_t>(row));
  const std::string side = kColumns.at(static_cast<std::size_t>(column));
  if (text.empty() && side.empty()) return "in the middle";
  if (side.empty()) return row == 0 ? "further up" : "further down";
  return "further to the " + (text.empty() ? side : text + " " + side);
}

}  // namespace

double Placement::distance(const Placement& other) const {
  return std::abs(x - other.x) + std::abs(y - other.y) + std::abs(size - other.size) +
         std::abs(skew - other.skew) + std::abs(turn_x - other.turn_x) +
         std::abs(turn_y - other.turn_y);
}

Placement placement_of(const Corners& corners, const BoardOptions& board, cv::Size image) {
  Placement result;
  if (corners.pixels.size() < 4) return result;
  const auto outline = outline_of(corners, board);
  const double extent = std::sqrt(area_of(outline));
  cv::Point2d center;
  for (const cv::Point2f& pixel : corners.pixels) center += cv::Point2d(pixel);
  center *= 1.0 / static_cast<double>(corners.pixels.size());
  result.x = position(center.x, extent, image.width);
  result.y = position(center.y, extent, image.height);
  result.size = std::min(1.0, extent / std::sqrt(static_cast<double>(image.area())));
  const cv::Point2d up = outline[0] - outline[1];
  const cv::Point2d side = outline[2] - outline[1];
  const double angle = std::atan2(std::abs(up.cross(side)), up.dot(side));
  result.skew = std::min(1.0, 2 * std::abs(M_PI / 2 - angle));
  result.turn_x = ratio_of(outline[3] - outline[0], outline[2] - outline[1]);
  result.turn_y = ratio_of(outline[1] - outline[0], outline[2] - outline[3]);
  return result;
}

void CoverageGrid::add(const Corners& corners) {
  for (const cv::Point2f& pixel : corners.pixels) {
    const int column = std::clamp(
        static_cast<int>(pixel.x * kColumns / static_cast<float>(image_.width)), 0, kColumns - 1);
    const int row = std::clamp(
        static_cast<int>(pixel.y * kRows / static_cast<float>(image_.height)), 0, kRows - 1);
    const int cell = row * kColumns + column;
    ++corners_[static_cast<std::size_t>(cell)];
  }
}

double CoverageGrid::covered() const {
  const auto count =
      std::count_if(corners_.begin(), corners_.end(), [](int corners) { return corners > 0; });
  return static_cast<double>(count) / static_cast<double>(corners_.size());
}

double CoverageGrid::covered(int column, int row) const {
  int cells = 0;
  int filled = 0;
  for (int y = row * kRows / 3; y < (row + 1) * kRows / 3; ++y) {
    for (int x = column * kColumns / 3; x < (column + 1) * kColumns / 3; ++x) {
      ++cells;
      filled += corners(x, y) > 0 ? 1 : 0;
    }
  }
  return static_cast<double>(filled) / cells;
}

Coverage::Coverage(BoardOptions board, cv::Size left, cv::Size right)
    : board_(std::move(board)), image_(left), left_(left), right_(right) {}

void Coverage::add(const CornerPair& pair) {
  left_.add(pair.left);
  right_.add(pair.right);
  placements_.push_back(placement_of(pair.left, board_, image_));
}

Coverage::Progress Coverage::progress() const {
  Range x, y, size, skew;
  for (const Placement& each : placements_) {
    x.add(each.x);
    y.add(each.y);
    size.add(each.size);
    // A skew or a turn, each about as useful as the other.
    skew.add(std::max({each.skew, std::abs(each.turn_x), std::abs(each.turn_y)}));
  }
  skew.low = 0;
  if (placements_.empty()) return {};
  double cells = std::min(left_.covered(), right_.covered()) / kCells;
  for (int ninth = 0; ninth < 9; ++ninth) {
    cells = std::min({cells, left_.covered(ninth % 3, ninth / 3) / kNinth,
                      right_.covered(ninth % 3, ninth / 3) / kNinth});
  }
  return {x.part_of(kRangeX), y.part_of(kRangeY), size.part_of(kRangeSize),
          skew.part_of(kRangeSkew), std::min(cells, 1.0)};
}

std::string Coverage::missing() const {
  const Progress now = progress();
  if (now.complete()) return {};
  const double least = std::min({now.x, now.y, now.size, now.skew, now.cells});
  if (least == now.skew && now.skew < 1) return "tilt the board more: left and right, up and down";
  if (least == now.size && now.size < 1) {
    double largest = 0;
    for (const Placement& each : placements_) largest = std::max(largest, each.size);
    return largest < 0.5 ? "hold the board closer to the cameras"
                         : "hold the board farther from the cameras";
  }
  // The emptiest ninth of an image, near corners first: they are the ones that are forgotten.
  double emptiest = kNinth;
  std::string result = "hold the board in more different places";
  for (const CoverageGrid* grid : {&left_, &right_}) {
    for (const int row : {0, 2, 1}) {
      for (const int column : {0, 2, 1}) {
        if (grid->covered(column, row) >= emptiest) continue;
        emptiest = grid->covered(column, row);
        result = "hold the board " + direction(column, row) + " in the " +
                 (grid == &left_ ? "left" : "right") + " image";
      }
    }
  }
  return result;
}

}  // namespace mtstereo::calibrate
