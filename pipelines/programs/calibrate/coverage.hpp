// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "programs/calibrate/detection.hpp"

namespace mtstereo::calibrate {

/// Where a board is in an image, and how it is turned. All but the turns are from 0 to 1.
struct Placement {
  double x = 0;       ///< center: 0 = as far to the left as possible
  double y = 0;       ///< center: 0 = as far up as possible
  double size = 0;    ///< square root of its part of the image
  double skew = 0;    ///< 0 = its corner is a right angle
  double turn_x = 0;  ///< logarithm of its left side divided by its right side
  double turn_y = 0;  ///< logarithm of its upper side divided by its lower side

  /// How much two placements differ: the sum over all members.
  double distance(const Placement& other) const;
};

Placement placement_of(const Corners& corners, const BoardOptions& board, cv::Size image);

/// The cells of one camera's image that corners were in.
class CoverageGrid {
 public:
  static constexpr int kColumns = 8;
  static constexpr int kRows = 6;

  explicit CoverageGrid(cv::Size image) : image_(image), corners_(std::size_t{kColumns} * kRows) {}
  void add(const Corners& corners);
  /// Number of corners in a cell.
  int corners(int column, int row) const {
    const int cell = row * kColumns + column;
    return corners_[static_cast<std::size_t>(cell)];
  }
  /// The part of the cells that have corners.
  double covered() const;
  /// The part of the cells of a ninth of the image, 0 <= column, row < 3, that have corners.
  double covered(int column, int row) const;

 private:
  cv::Size image_;
  std::vector<int> corners_;
};

/// What the views of both cameras cover.
class Coverage {
 public:
  Coverage(BoardOptions board, cv::Size left, cv::Size right);
  void add(const CornerPair& pair);
  /// Takes the left images for those of the right camera, and vice versa.
  void swap_sides() { std::swap(left_, right_); }

  /// Which parts of the wanted ranges are reached: position in x and y, size, skew, cells.
  struct Progress {
    double x = 0, y = 0, size = 0, skew = 0, cells = 0;  ///< each at most 1
    /// All ranges are covered.
    bool complete() const { return x >= 1 && y >= 1 && size >= 1 && skew >= 1 && cells >= 1; }
  };
  Progress progress() const;
  /// What is most missing, as a sentence to the person who holds the board; empty if nothing is.
  std::string missing() const;

  const CoverageGrid& left() const { return left_; }
  const CoverageGrid& right() const { return right_; }
  const std::vector<Placement>& placements() const { return placements_; }

 private:
  BoardOptions board_;
  cv::Size image_;
  CoverageGrid left_, right_;
  std::vector<Placement> placements_;
};

}  // namespace mtstereo::calibrate
