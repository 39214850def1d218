// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/rig.hpp"

#include "tools/render/lens.hpp"

namespace mtstereo::render {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

Vector3d Camera::direction(double x, double y) const {
  if (lens) return lens->ray(x, y);
  return {(x - center_x) / focal, (y - center_y) / focal, 1};
}

cv::Point2d Camera::project(const Vector3d& direction) const {
  if (lens) return lens->pixel(direction);
  return {center_x + focal * direction.x() / direction.z(),
          center_y + focal * direction.y() / direction.z()};
}

cv::Point2d Camera::pixel_of(const Vector3d& point) const {
  return project(pose.linear().transpose() * (point - pose.translation()));
}

Camera left_camera(const Settings& settings) {
  Camera camera;
  camera.focal = settings.focal;
  camera.center_x = (settings.width - 1) / 2.0;
  camera.center_y = (settings.height - 1) / 2.0;
  return camera;
}

Camera ideal_right_camera(const Settings& settings) {
  Camera camera = left_camera(settings);
  camera.pose.translate(Vector3d(settings.baseline, 0, 0));
  return camera;
}

Camera right_camera(const Settings& settings) {
  const Rig& rig = settings.rig;
  Camera camera = ideal_right_camera(settings);
  if (rig.aligned()) return camera;
  camera.pose.rotate(AngleAxisd(rig.yaw * kDegree, Vector3d::UnitY()));
  camera.pose.rotate(AngleAxisd(-rig.pitch * kDegree, Vector3d::UnitX()));
  camera.pose.rotate(AngleAxisd(rig.roll * kDegree, Vector3d::UnitZ()));
  camera.focal *= rig.focal_ratio;
  camera.center_y += rig.row_offset;
  return camera;
}

cv::Point2d right_pixel(const Settings& settings, double x, double y) {
  if (settings.rig.aligned()) return {x, y};
  const Camera ideal = ideal_right_camera(settings), real = right_camera(settings);
  return real.project(real.pose.linear().transpose() * ideal.direction(x, y));
}

cv::Point2d ideal_pixel(const Settings& settings, double x, double y) {
  if (settings.rig.aligned()) return {x, y};
  const Camera ideal = ideal_right_camera(settings), real = right_camera(settings);
  return ideal.project(real.pose.linear() * real.direction(x, y));
}

Rectification rectification_of(const Settings& settings) {
  const Camera left = left_camera(settings);
  Rectification r;
  r.width = settings.width, r.height = settings.height;
  r.left_rotation = r.right_rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  r.focal_length = left.focal;
  r.left_center_x = r.right_center_x = left.center_x;
  r.center_y = left.center_y;
  r.baseline = settings.baseline;
  return r;
}

Camera rectified_left_camera(const Rectification& r) {
  Camera camera;
  camera.focal = r.focal_length;
  camera.center_x = r.left_center_x;
  camera.center_y = r.center_y;
  const Eigen::Matrix3d rectified_from_left =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.left_rotation.data());
  camera.pose.linear() = rectified_from_left.transpose();
  return camera;
}

Camera rectified_right_camera(const Rectification& r) {
  Camera camera = rectified_left_camera(r);
  camera.center_x = r.right_center_x;
  camera.pose.translate(Vector3d(r.baseline, 0, 0));
  return camera;
}

}  // namespace mtstereo::render
