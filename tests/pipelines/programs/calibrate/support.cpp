// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support.hpp"

namespace mtstereo::calibrate::testing {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

Pose turned(double x, double y, double z) {
  Eigen::Matrix<double, 6, 1> step;
  step << x, y, z, 0, 0, 0;
  return Pose().moved(step);
}

Rig rig_of(const Camera& left, const Camera& right) {
  Rig rig{left, right, turned(0.01, -0.02, 0.008)};
  rig.right_from_left.translation = {-0.12, 0.002, -0.003};
  return rig;
}

Camera camera_of(Model model, double focal, std::vector<double> coefficients) {
  Camera camera = ideal_camera(model, kWidth, kHeight, focal);
  camera.values[1] *= 1.001;
  camera.values[2] += 6;
  camera.values[3] -= 4;
  std::copy(coefficients.begin(), coefficients.end(), camera.values.begin() + kPinholeParameters);
  return camera;
}

Corners corners_of(const std::vector<Observation>& seen) {
  Corners corners;
  for (const Observation& each : seen) {
    corners.ids.push_back(each.id);
    corners.pixels.emplace_back(static_cast<float>(each.pixel.x()),
                                static_cast<float>(each.pixel.y()));
  }
  return corners;
}

}  // namespace

Rig plumb_bob_rig() {
  return rig_of(camera_of(Model::kPlumbBob, 520, {-0.28, 0.09, 0.0006, -0.0004, -0.01}),
                camera_of(Model::kPlumbBob, 524, {-0.27, 0.08, -0.0005, 0.0003, -0.008}));
}

Rig fisheye_rig() {
  return rig_of(camera_of(Model::kFisheye, 300, {0.03, -0.012, 0.004, -0.001}),
                camera_of(Model::kFisheye, 302, {0.028, -0.01, 0.003, -0.0008}));
}

std::vector<Pose> board_poses(const Rig& rig, const BoardOptions& board, int count,
                              std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const Eigen::Vector3d middle(board.columns * board.square / 2, board.rows * board.square / 2, 0);
  std::vector<Pose> poses;
  while (static_cast<int>(poses.size()) < count) {
    const Eigen::Vector2d pixel(uniform(0.15, 0.9) * kWidth, uniform(0.15, 0.85) * kHeight);
    const auto ray = rig.left.ray(pixel);
    if (!ray) continue;
    Pose pose = turned(uniform(-0.6, 0.6), uniform(-0.6, 0.6), uniform(-0.3, 0.3));
    // The board faces the camera, but for these angles.
    const Pose facing{
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), *ray).toRotationMatrix(),
        Eigen::Vector3d::Zero()};
    pose = facing * pose;
    pose.translation = uniform(0.3, 0.8) * *ray - pose.rotation * middle;
    poses.push_back(pose);
  }
  return poses;
}

std::vector<Observation> observe(const Camera& camera, const Pose& camera_from_board,
                                 const BoardOptions& board, double noise, std::mt19937& random) {
  std::normal_distribution<double> error(0, noise > 0 ? noise : 1);
  std::vector<Observation> seen;
  const std::vector<Eigen::Vector3d> points = corner_points(board);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = camera.project(camera_from_board * points[i]);
    if (!pixel || pixel->x() < 2 || pixel->y() < 2 || pixel->x() > kWidth - 3 ||
        pixel->y() > kHeight - 3) {
      continue;
    }
    const Eigen::Vector2d shift =
        noise > 0 ? Eigen::Vector2d(error(random), error(random)) : Eigen::Vector2d::Zero();
    seen.push_back({static_cast<int>(i), points[i], *pixel + shift});
  }
  return seen;
}

std::vector<BoardView> observe(const Rig& rig, const std::vector<Pose>& poses,
                               const BoardOptions& board, double noise, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<BoardView> views;
  for (const Pose& pose : poses) {
    BoardView view;
    view.left = observe(rig.left, pose, board, noise, random);
    view.right = observe(rig.right, rig.right_from_left * pose, board, noise, random);
    if (corners_of(view).usable()) views.push_back(view);
  }
  return views;
}

std::vector<BoardView> views_of(const Rig& rig, int count, double noise) {
  const BoardOptions board;
  return observe(rig, board_poses(rig, board, count), board, noise);
}

CornerPair corners_of(const BoardView& view) {
  return {corners_of(view.left), corners_of(view.right)};
}

}  // namespace mtstereo::calibrate::testing
