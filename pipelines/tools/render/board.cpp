// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/board.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "tools/render/lens.hpp"

namespace mtstereo::render {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

bool sees(const Camera& camera, const Vector3d& in_left) {
  constexpr double kInside = 3;  // from the border of the view [px]
  const Vector3d point = camera.pose.linear().transpose() * (in_left - camera.pose.translation());
  return camera.lens->sees(point, kInside);
}

// The part of a grid of points of the board that both cameras see.
double visible_part(const Isometry3d& pose, double width, double height, const RawRig& rig) {
  constexpr int kPoints = 9;
  int seen = 0;
  for (int j = 0; j < kPoints; ++j) {
    for (int i = 0; i < kPoints; ++i) {
      const Vector3d point = pose * Vector3d(width * (i / (kPoints - 1.0) - 0.5),
                                             height * (j / (kPoints - 1.0) - 0.5), 0);
      const bool both = sees(rig.left, point) && sees(rig.right, point);
      if (both) ++seen;
    }
  }
  return static_cast<double>(seen) / (kPoints * kPoints);
}

// The shortest turn of the optical axis to a ray that does not point backwards. The one of Eigen,
// for any two vectors, needs a singular value decomposition, a third of the time to compile this
// library.
Eigen::Quaterniond turn_to(const Vector3d& ray) {
  const Vector3d to = ray.normalized();
  const double length = std::sqrt((1 + to.z()) * 2);
  const double scale = 1 / length;
  return {length * 0.5, -to.y() * scale, to.x() * scale, 0};
}

class PoseChooser {
 public:
  PoseChooser(const BoardPoses& options, double width, double height, const RawRig& rig)
      : options_(options), width_(width), height_(height), rig_(rig) {}

  Isometry3d choose(int index) {
    constexpr int kTries = 50;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      if (const auto pose = attempt_at(index)) return *pose;
    }
    throw std::invalid_argument(
        "the board does not fit into both views; use a smaller baseline or a smaller board");
  }

 private:
  double random(double low, double high) {
    return low + (high - low) * hash_unit(options_.seed, ++drawn_, 0xb0a2du);
  }

  // Aims at a place of the image and moves towards its center until enough of the board is visible.
  std::optional<Isometry3d> attempt_at(int index) {
    constexpr int kSteps = 20;
    // The sequence of Roberts fills the square evenly, at any length.
    const double x = std::fmod(0.5 + (index + 1) * 0.7548776662466927, 1.0);
    const double y = std::fmod(0.5 + (index + 1) * 0.5698402909980532, 1.0);
    const double covered = random(options_.smallest, options_.largest);
    const double roll = random(-options_.roll, options_.roll) * kDegree;
    const double tilt = options_.tilt * std::sqrt(random(0, 1)) * kDegree;
    const double tilt_axis = random(0, 2 * std::numbers::pi);
    for (int step = 0; step < kSteps; ++step) {
      const double keep = 1 - static_cast<double>(step) / kSteps;
      const Vector3d ray = left_ray(0.5 + keep * (x - 0.5), 0.5 + keep * (y - 0.5));
      Isometry3d pose = Isometry3d::Identity();
      pose.translate(ray * distance(covered));
      pose.rotate(turn_to(ray));
      pose.rotate(AngleAxisd(tilt, Vector3d(std::cos(tilt_axis), std::sin(tilt_axis), 0)));
      pose.rotate(AngleAxisd(roll, Vector3d::UnitZ()));
      if (visible_part(pose, width_, height_, rig_) >= options_.visible) return pose;
    }
    return std::nullopt;
  }

  Vector3d left_ray(double x, double y) const {
    const CameraCalibration& c = rig_.calibration.left;
    return rig_.left.direction(x * (c.width - 1), y * (c.height - 1)).normalized();
  }

  // Where a board that faces the camera covers this part of the image.
  double distance(double covered) const {
    const CameraCalibration& c = rig_.calibration.left;
    return c.focal_x / covered * std::max(width_ / c.width, height_ / c.height);
  }

  const BoardPoses& options_;
  double width_, height_;
  const RawRig& rig_;
  std::uint32_t drawn_ = 0;
};

Texture wall_paint() {
  Texture t;
  t.mean = 0.45, t.noise_contrast = 0.12, t.noise_size = 0.6, t.octaves = 5;
  t.color = {0.95f, 1.0f, 0.97f};
  return t;
}

}  // namespace

std::vector<Isometry3d> choose_poses(const BoardPoses& options, double width, double height,
                                     const RawRig& rig) {
  PoseChooser chooser(options, width, height, rig);
  std::vector<Isometry3d> poses;
  for (int i = 0; i < options.count; ++i) poses.push_back(chooser.choose(i));
  return poses;
}

Scene make_board(const std::shared_ptr<const ImageTexture>& image, std::vector<Isometry3d> poses,
                 const BoardTimes& times, std::uint32_t seed) {
  SceneBuilder b("board", seed);
  double farthest = 0;
  for (const Isometry3d& pose : poses) farthest = std::max(farthest, pose.translation().z());
  const double wall = 2.5 * farthest + 0.5;
  b.rectangle({0, 0, wall}, 15 * wall, 15 * wall, wall_paint());

  Texture print;
  print.image = image;
  Object& board = b.rectangle({0, 0, 0}, image->width() / 2, image->height() / 2, print);
  board.motion.path = std::make_shared<const Path>(Path{std::move(poses), times.rest, times.move});
  b.scene().to_light = {0.3, -0.5, -1};
  b.scene().ambient = 0.6;
  return b.scene();
}

}  // namespace mtstereo::render
