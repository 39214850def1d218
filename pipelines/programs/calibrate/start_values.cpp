// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/start_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <utility>

#include "lib/median.hpp"
#include "lib/outputs/user_error.hpp"

namespace mtstereo::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Focal lengths that are tried, relative to the width of the image.
constexpr double kShortestFocal = 0.2;
constexpr double kLongestFocal = 9;
constexpr double kFocalStep = 1.25;
constexpr std::size_t kViewsOfSearch = 12;
constexpr std::size_t kStarts = 4;  // focal lengths that an adjustment starts from
// Rays farther from the axis than this are useless for a pose by a plane's image.
constexpr double kSmallestCosine = 0.25;
constexpr double kLooseScale = 3;  // of the first robust adjustments [px]

// The median; infinity without any value.
double typical(std::vector<double> values) {
  return values.empty() ? std::numeric_limits<double>::infinity() : median(std::move(values));
}

double median_distance(const Camera& camera, const Pose& pose,
                       const std::vector<Observation>& seen) {
  std::vector<double> distances;
  for (const Vector2d& rest : residuals(camera, pose, seen)) distances.push_back(rest.norm());
  return typical(std::move(distances));
}

Pose pose_of(const cv::Mat& turn, const cv::Mat& shift) {
  cv::Mat rotation;
  cv::Rodrigues(turn, rotation);
  Pose pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      pose.rotation(row, column) = rotation.at<double>(row, column);
    }
    pose.translation(row) = shift.at<double>(row);
  }
  return pose;
}

// Both poses that the image of a plane allows.
std::vector<Pose> plane_poses(const Camera& camera, const std::vector<Observation>& seen) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const Observation& each : seen) {
    const auto ray = camera.ray(each.pixel);
    if (!ray || ray->z() < kSmallestCosine) continue;
    points.emplace_back(each.point.x(), each.point.y(), 0);
    pixels.emplace_back(ray->x() / ray->z(), ray->y() / ray->z());
  }
  if (points.size() < kFewestCorners) return {};
  std::vector<Pose> poses;
  try {
    std::vector<cv::Mat> turns, shifts;
    cv::solvePnPGeneric(points, pixels, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), turns, shifts,
                        false, cv::SOLVEPNP_IPPE);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const Pose pose = pose_of(turns[i], shifts[i]);
      if (pose.rotation.allFinite() && pose.translation.allFinite()) poses.push_back(pose);
    }
  } catch (const cv::Exception&) {
    return {};  // corners on one line
  }
  return poses;
}

// Some of the views, evenly spread.
std::vector<BoardView> sample(const std::vector<BoardView>& views, std::size_t count) {
  std::vector<BoardView> result;
  const std::size_t step = std::max<std::size_t>(1, (views.size() + count - 1) / count);
  for (std::size_t i = 0; i < views.size(); i += step) result.push_back(views[i]);
  return result;
}

std::array<bool, kMostParameters> first_parameters(int count) {
  std::array<bool, kMostParameters> result{};
  std::fill_n(result.begin(), count, true);
  return result;
}

// Finds the poses of all views. Views without one keep a pose far away: they are outliers.
double place_boards(const Camera& camera, std::vector<BoardView>& views) {
  std::vector<double> distances;
  for (BoardView& view : views) {
    const auto pose = board_pose(camera, view.left);
    if (pose) view.pose = *pose;
    distances.push_back(pose ? median_distance(camera, *pose, view.left) : camera.width);
  }
  return typical(std::move(distances));
}

// The adjustment of one camera: focal length and first coefficient, then all parameters.
BundleResult adjust_camera(Camera& camera, std::vector<BoardView>& views, bool all) {
  Rig rig{camera, camera, {}};
  BundleOptions options;
  options.free_rig = false;
  options.robust_scale = kLooseScale;
  options.free = first_parameters(kPinholeParameters + 1);
  options.free[2] = options.free[3] = false;
  options.iterations = 15;
  BundleResult result = adjust(rig, views, options);
  if (all) {
    options.free = first_parameters(kPinholeParameters + 2);
    result = adjust(rig, views, options);
    options.free = all_parameters();
    options.iterations = 40;
    result = adjust(rig, views, options);
  }
  camera = rig.left;
  return result;
}

double fit_of(const Camera& camera, const std::vector<BoardView>& views) {
  std::vector<double> distances;
  for (const BoardView& view : views) {
    distances.push_back(median_distance(camera, view.pose, view.left));
  }
  return typical(std::move(distances));
}

// The focal lengths whose poses fit best, without distortion.
std::vector<double> good_focals(Model model, cv::Size size, std::vector<BoardView> views) {
  std::vector<std::pair<double, double>> tried;  // distance, focal length
  for (double ratio = kShortestFocal; ratio < kLongestFocal; ratio *= kFocalStep) {
    const double focal = ratio * size.width;
    const Camera camera = ideal_camera(model, size.width, size.height, focal);
    tried.emplace_back(place_boards(camera, views), focal);
  }
  std::sort(tried.begin(), tried.end());
  std::vector<double> result;
  for (std::size_t i = 0; i < std::min(kStarts, tried.size()); ++i) {
    result.push_back(tried[i].second);
  }
  return result;
}

std::vector<BoardView> seen_by_right(const std::vector<BoardView>& views) {
  std::vector<BoardView> result;
  for (const BoardView& view : views) result.push_back({view.right, {}, {}});
  return result;
}

// The relative pose of one view that most other views agree with.
Pose agreed_pose(const Rig& rig, const std::vector<BoardView>& left,
                 const std::vector<BoardView>& right) {
  Pose best;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Pose pose = right[i].pose * left[i].pose.inverse();
    std::vector<double> distances;
    for (std::size_t k = 0; k < left.size(); ++k) {
      distances.push_back(median_distance(rig.right, pose * left[k].pose, right[k].left));
    }
    const double distance = typical(std::move(distances));
    if (distance < smallest) {
      smallest = distance;
      best = pose;
    }
  }
  return best;
}

}  // namespace

std::optional<Pose> board_pose(const Camera& camera, const std::vector<Observation>& seen) {
  std::optional<Pose> best;
  double smallest = std::numeric_limits<double>::infinity();
  BundleOptions options;
  options.free = no_parameters();
  options.free_rig = false;
  options.robust_scale = kLooseScale;
  options.iterations = 20;
  for (const Pose& start : plane_poses(camera, seen)) {
    std::vector<BoardView> view{{seen, {}, start}};
    Rig rig{camera, camera, {}};
    adjust(rig, view, options);
    const double distance = median_distance(camera, view.front().pose, seen);
    if (distance < smallest) {
      smallest = distance;
      best = view.front().pose;
    }
  }
  return best;
}

Camera fit_camera(Model model, int width, int height, std::vector<BoardView>& views) {
  const std::vector<BoardView> few = sample(views, kViewsOfSearch);
  Camera best;
  double smallest = std::numeric_limits<double>::infinity();
  for (const double focal : good_focals(model, {width, height}, few)) {
    Camera camera = ideal_camera(model, width, height, focal);
    std::vector<BoardView> trial = few;
    place_boards(camera, trial);
    adjust_camera(camera, trial, true);
    const double fit = fit_of(camera, trial);
    if (fit < smallest) {
      smallest = fit;
      best = camera;
    }
  }
  if (!(smallest < width)) {
    throw UserError(
        "no camera fits the corners that were found: is the number of squares "
        "right, and is the board flat?");
  }
  // All views: poses from the good camera, then everything again.
  for (int i = 0; i < 2; ++i) {
    place_boards(best, views);
    adjust_camera(best, views, true);
  }
  return best;
}

double robust_scale(const Rig& rig, const std::vector<BoardView>& views, double least) {
  std::vector<double> sizes;
  const auto add = [&](const Camera& camera, const Pose& pose, const auto& seen) {
    for (const Vector2d& rest : residuals(camera, pose, seen)) {
      sizes.push_back(std::abs(rest.x()));
      sizes.push_back(std::abs(rest.y()));
    }
  };
  for (const BoardView& view : views) {
    add(rig.left, view.pose, view.left);
    add(rig.right, rig.right_from_left * view.pose, view.right);
  }
  return std::max(least, 1.4826 * typical(std::move(sizes)));
}

Rig fit_start(Model model, cv::Size left, cv::Size right, std::vector<BoardView>& views) {
  std::vector<BoardView> lefts = views;
  for (BoardView& view : lefts) view.right.clear();
  std::vector<BoardView> rights = seen_by_right(views);
  Rig rig;
  rig.left = fit_camera(model, left.width, left.height, lefts);
  rig.right = fit_camera(model, right.width, right.height, rights);
  rig.right_from_left = agreed_pose(rig, lefts, rights);
  for (std::size_t i = 0; i < views.size(); ++i) views[i].pose = lefts[i].pose;
  return rig;
}

}  // namespace mtstereo::calibrate
