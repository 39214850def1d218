// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/detection.hpp"

#include <algorithm>
#include <future>
#include <opencv2/calib3d.hpp>
#include <set>

#include "programs/calibrate/start_values.hpp"

namespace mtstereo::calibrate {
namespace {

bool in_two_directions(const Corners& corners, int columns) {
  std::set<int> x, y;
  for (const int id : corners.ids) {
    x.insert(id % columns);
    y.insert(id / columns);
  }
  return x.size() > 1 && y.size() > 1;
}

}  // namespace

bool CornerPair::usable() const {
  if (left.ids.size() < kFewestCorners || right.ids.size() < kFewestCorners) return false;
  const std::set<int> rights(right.ids.begin(), right.ids.end());
  const auto shared =
      std::count_if(left.ids.begin(), left.ids.end(), [&](int id) { return rights.count(id) > 0; });
  return static_cast<std::size_t>(shared) >= kFewestCorners;
}

BoardFinder::BoardFinder(const BoardOptions& options)
    : options_(options), points_(corner_points(options)) {
  if (options.kind == BoardKind::kCharuco) charuco_.emplace(options);
}

Corners BoardFinder::find_checkerboard(const cv::Mat& gray) const {
  Corners corners;
  const cv::Size size(options_.columns - 1, options_.rows - 1);
  if (!cv::findChessboardCornersSB(gray, size, corners.pixels,
                                   cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY)) {
    return {};
  }
  if (corners.pixels.size() != static_cast<std::size_t>(size.area())) return {};
  for (int id = 0; id < size.area(); ++id) corners.ids.push_back(id);
  return corners;
}

Corners BoardFinder::find(const cv::Mat& gray) const {
  try {
    Corners corners = charuco_ ? charuco_->find(gray) : find_checkerboard(gray);
    if (corners.ids.size() >= kFewestCorners && in_two_directions(corners, options_.columns - 1)) {
      return corners;
    }
    return {{}, {}, corners.markers};
  } catch (const cv::Exception&) {
    return {};  // such as an image smaller than the filters
  }
}

CornerPair BoardFinder::find(const cv::Mat& left, const cv::Mat& right) const {
  auto other = std::async(std::launch::async, [&] { return find(right); });
  CornerPair pair;
  pair.left = find(left);
  pair.right = other.get();
  if (!charuco_) match_numbers(pair.left, pair.right);
  return pair;
}

std::vector<Observation> BoardFinder::observations(const Corners& corners) const {
  std::vector<Observation> result;
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    const int id = corners.ids[i];
    result.push_back(
        {id, points_[static_cast<std::size_t>(id)], {corners.pixels[i].x, corners.pixels[i].y}});
  }
  return result;
}

BoardView BoardFinder::view_of(const CornerPair& pair) const {
  return {observations(pair.left), observations(pair.right), {}};
}

void match_numbers(const Corners& left, Corners& right) {
  if (left.pixels.size() < 2 || right.pixels.size() != left.pixels.size()) return;
  const cv::Point2f a = left.pixels.back() - left.pixels.front();
  const cv::Point2f b = right.pixels.back() - right.pixels.front();
  if (a.dot(b) < 0) std::reverse(right.pixels.begin(), right.pixels.end());
}

}  // namespace mtstereo::calibrate
