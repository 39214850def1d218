// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/camera_motion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstdlib>

namespace mtstereo {
namespace {

/// The eight of the motion, and the gain and the offset of the gray values, which change with the
/// exposure.
constexpr int kTerms = 10;
constexpr int kGain = 8;
constexpr int kOffset = 9;
/// The gain is that of a gray value in units of this one.
constexpr double kGrayUnit = 128;

using Terms = Eigen::Matrix<double, kTerms, 1>;
using Normal = Eigen::Matrix<double, kTerms, kTerms>;

/// Rounds at each resolution.
constexpr int kRounds = 2;

/// A smaller step of the gray values at a point is noise rather than an edge.
constexpr int kLeastStep = 4;  // of both differences over two pixels

/// A gray value has half of the weight if it differs by this much: a multiple of the mean
/// difference and, at least, of the rounding.
constexpr double kMeanFactor = 1.5;
constexpr double kLeastDeviation = 0.5;
/// The mean difference before the first round.
constexpr double kFirstMean = 20;

/// Fewer points, or a smaller share of them inside the other view, decide nothing.
constexpr int kFewestPoints = 24;
constexpr double kLeastInside = 0.3;

/// The gradients of both views at the points must be this similar; 1 if they are equal. Views of
/// other scenes reach 0.25, the same scene 0.85.
constexpr double kLeastSimilarity = 0.5;
/// The level whose gradients are compared: noise hardly changes them there.
constexpr int kComparedLevel = 1;

/// Gray value and gradient between four pixels.
struct Sample {
  double gray = 0;
  double dx = 0;
  double dy = 0;
};

/// Whether the image has the pixels that a sample at this place needs.
bool is_inside(const Image<std::uint8_t>& image, double x, double y) {
  return x >= 1 && y >= 1 && x < image.width() - 2 && y < image.height() - 2;
}

Sample sample(const Image<std::uint8_t>& image, double x, double y) {
  const int column = static_cast<int>(x), line = static_cast<int>(y);
  const double right = x - column, below = y - line;
  const std::uint8_t* row[4];
  for (int i = 0; i < 4; ++i) row[i] = image.row(line + i - 1) + column;
  // Between two columns, and the difference of their neighbors.
  const auto across = [&](int i) { return row[i][0] + right * (row[i][1] - row[i][0]); };
  const auto slope = [&](int i) {
    return 0.5 * ((1 - right) * (row[i][1] - row[i][-1]) + right * (row[i][2] - row[i][0]));
  };
  const double here = across(1), next = across(2);
  return {here + below * (next - here), slope(1) + below * (slope(2) - slope(1)),
          0.5 * ((1 - below) * (next - across(0)) + below * (across(3) - here))};
}

/// Two views and the scale of their pixels. The unknowns are in units of half the width, so that
/// all have about the same size.
struct Level {
  const Image<std::uint8_t>& from;
  const Image<std::uint8_t>& to;
  double scale;  ///< pixels of the view in a pixel of the level
  double unit, center_x, center_y;

  /// A column or row of the level.
  double place(double pixel) const { return (pixel + 0.5) / scale - 0.5; }
};

struct Scaled {
  double x, y, disparity;
};

Scaled scaled(const Level& level, const ScenePoint& point) {
  return {(point.x - level.center_x) / level.unit, (point.y - level.center_y) / level.unit,
          point.disparity / level.unit};
}

/// The point in the other view [px].
Scaled moved(const Level& level, const Terms& terms, const Scaled& p) {
  const double depth = 1 - terms[5] * p.disparity - terms[6] * p.x - terms[7] * p.y;
  const double growth = level.unit / std::max(depth, double{CameraMotion::kLeastDepth});
  return {(p.x + terms[0] + terms[2] * p.y - terms[3] * p.disparity) * growth + level.center_x,
          (p.y + terms[1] - terms[2] * p.x - terms[4] * p.disparity) * growth + level.center_y,
          p.disparity * growth};
}

/// The gray value of the other view less what this one predicts.
double difference_of(const Terms& terms, const Sample& from, const Sample& to) {
  return to.gray - from.gray - terms[kGain] * from.gray / kGrayUnit - terms[kOffset];
}

/// How the difference changes with the terms, where the views have this gradient.
Terms change(const Scaled& p, double dx, double dy, double gray) {
  const double outward = p.x * dx + p.y * dy;
  Terms terms;
  terms << dx, dy, p.y * dx - p.x * dy, -p.disparity * dx, -p.disparity * dy, p.disparity * outward,
      p.x * outward, p.y * outward, -gray / kGrayUnit, -1;
  return terms;
}

/// Calls body(point, sample of this view, sample of the other one) for the points that both
/// views show, and returns their number.
template <typename Body>
int compare(const Level& level, const MotionPoints& points, const Terms& terms, Body body) {
  int compared = 0;
  const int count = points.columns * points.rows;
  for (int i = 0; i < count; ++i) {
    const ScenePoint& point = points.points[i];
    if (point.disparity < 0) continue;
    const double x = level.place(point.x), y = level.place(point.y);
    const Scaled scene = scaled(level, point);
    const Scaled there = moved(level, terms, scene);
    const double to_x = level.place(there.x), to_y = level.place(there.y);
    if (!is_inside(level.from, x, y) || !is_inside(level.to, to_x, to_y)) continue;
    body(scene, sample(level.from, x, y), sample(level.to, to_x, to_y));
    ++compared;
  }
  return compared;
}

/// One step of Gauss and Newton. Gradients are the means of both views, which converges from
/// further away than those of one. `mean` is the mean difference of the gray values.
void improve(const Level& level, const MotionPoints& points, Terms& terms, double& mean) {
  Normal normal = Normal::Zero();
  Terms right = Terms::Zero();
  double sum = 0;
  const double deviation = kMeanFactor * mean + kLeastDeviation;
  const double per_unit = level.unit / level.scale;
  const int count =
      compare(level, points, terms, [&](const Scaled& point, const Sample& from, const Sample& to) {
        const double difference = difference_of(terms, from, to);
        const double ratio = difference / deviation;
        const double weight = 1 / (1 + ratio * ratio);
        const Terms factors = change(point, 0.5 * per_unit * (from.dx + to.dx),
                                     0.5 * per_unit * (from.dy + to.dy), from.gray);
        normal.selfadjointView<Eigen::Lower>().rankUpdate(factors, weight);
        right -= weight * difference * factors;
        sum += std::abs(difference);
      });
  if (count < kFewestPoints) return;
  mean = sum / count;
  // A term that nothing depends on stays as it is.
  for (int i = 0; i < kTerms; ++i) normal(i, i) += 1e-4 * normal(i, i) + 1e-9;
  terms += normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
}

/// Whether both views show the same at the points.
bool is_same_scene(const Level& level, const MotionPoints& points, const Terms& terms) {
  double product = 0, squares = 0;
  const int compared =
      compare(level, points, terms, [&](const Scaled&, const Sample& from, const Sample& to) {
        product += from.dx * to.dx + from.dy * to.dy;
        squares += from.dx * from.dx + from.dy * from.dy + to.dx * to.dx + to.dy * to.dy;
      });
  const int blocks = points.columns * points.rows;
  const auto all = std::count_if(points.points.data(), points.points.data() + blocks,
                                 [](const ScenePoint& point) { return point.disparity >= 0; });
  return compared >= kFewestPoints && compared >= kLeastInside * static_cast<double>(all) &&
         product > kLeastSimilarity * squares / 2;
}

int step_at(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below, int x) {
  return std::abs(row[x + 1] - row[x - 1]) + std::abs(below[x] - above[x]);
}

/// The point of one block; x0 and y0 are its first column and row.
ScenePoint best_point(const Image<std::uint8_t>& halved, const Image<std::int32_t>& map,
                      const Image<std::uint8_t>& confidence, int side, int x0, int y0) {
  ScenePoint best = {0, 0, -1};
  int most = kLeastStep;
  const int right = std::min((x0 + side) / 2, halved.width() - 1);
  const int bottom = std::min((y0 + side) / 2, halved.height() - 1);
  for (int y = std::max(y0 / 2, 1); y < bottom; ++y) {
    for (int x = std::max(x0 / 2, 1); x < right; ++x) {
      const int step = step_at(halved.row(y - 1), halved.row(y), halved.row(y + 1), x);
      if (step <= most || confidence.row(2 * y)[2 * x] <= kMostInferred) continue;
      most = step;
      best = {2 * static_cast<float>(x) + 0.5F, 2 * static_cast<float>(y) + 0.5F,
              static_cast<float>(map.row(2 * y)[2 * x]) / kDisparityOne};
    }
  }
  return best;
}

}  // namespace

void ViewPyramid::resize(int width, int height, ReusedMemory* reused) {
  for (count = 0; count < kMostLevels; ++count) {
    width = half_of(width);
    height = half_of(height);
    if (std::min(width, height) < kSmallestSide) break;
    levels[count].resize(width, height, reused);
  }
}

void ViewPyramid::take(const ViewPyramid& other) {
  for (int i = 0; i < count; ++i) {
    for (int y = 0; y < levels[i].height(); ++y) {
      std::copy_n(other.levels[i].row(y), levels[i].width(), levels[i].row(y));
    }
  }
}

void MotionPoints::resize(int width, int height) {
  const double area = static_cast<double>(width) * height / kMostBlocks;
  side = std::max(2 * half_of(static_cast<int>(std::ceil(std::sqrt(area)))), kSmallestBlock);
  columns = (width + side - 1) / side;
  rows = (height + side - 1) / side;
  points.resize(static_cast<std::size_t>(columns) * rows);
}

void choose_points(const Image<std::uint8_t>& halved, const Image<std::int32_t>& map,
                   const Image<std::uint8_t>& confidence, float offset, int row0, int row1,
                   MotionPoints& points) {
  const int side = points.side;
  for (int row = row0; row < row1; ++row) {
    for (int column = 0; column < points.columns; ++column) {
      ScenePoint point = best_point(halved, map, confidence, side, column * side, row * side);
      if (point.disparity >= 0) {
        point.disparity = std::max(point.disparity + offset, 0.0F);
      }
      points.points[row * points.columns + column] = point;
    }
  }
}

std::optional<CameraMotion> find_motion(const MotionPoints& points, const ViewPyramid& from,
                                        const ViewPyramid& to, int width, int height) {
  if (from.count == 0) return std::nullopt;
  const auto level = [&](int i) {
    return Level{from.levels[i], to.levels[i], static_cast<double>(2 << i),
                 width / 2.0,    width / 2.0,  height / 2.0};
  };
  Terms terms = Terms::Zero();
  double mean = kFirstMean;
  for (int i = from.count - 1; i >= 0; --i) {
    for (int round = 0; round < kRounds; ++round) improve(level(i), points, terms, mean);
  }
  const Level compared = level(std::min(kComparedLevel, from.count - 1));
  if (!is_same_scene(compared, points, terms)) return std::nullopt;
  const auto term = [&](int i, double unit) { return static_cast<float>(terms[i] * unit); };
  const double unit = compared.unit;
  return CameraMotion{term(0, unit), term(1, unit),     term(2, 1),        term(3, 1),
                      term(4, 1),    term(5, 1 / unit), term(6, 1 / unit), term(7, 1 / unit)};
}

}  // namespace mtstereo
