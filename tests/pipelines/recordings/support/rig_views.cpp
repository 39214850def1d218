// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rig_views.hpp"

#include <Eigen/Geometry>

#include "tools/render/raw.hpp"

namespace mtstereo::run::testing {
namespace {

CameraCalibration random_camera(cv::RNG& random, bool fisheye) {
  CameraCalibration camera;
  camera.width = kRigWidth;
  camera.height = kRigHeight;
  camera.focal_x = kRigWidth * (fisheye ? random.uniform(0.45, 0.55) : random.uniform(0.7, 1.0));
  camera.focal_y = camera.focal_x * random.uniform(0.998, 1.002);
  camera.center_x = kRigWidth * random.uniform(0.48, 0.52);
  camera.center_y = kRigHeight * random.uniform(0.48, 0.52);
  camera.lens = fisheye ? LensModel::kFisheye : LensModel::kPlumbBob;
  const double k1 = fisheye ? random.uniform(-0.02, 0.02) : random.uniform(-0.22, 0.05);
  camera.coefficients = {k1, fisheye ? 0.002 : 0.2 * k1 * k1, 0, 0};
  if (!fisheye) camera.coefficients[2] = random.uniform(-5e-4, 5e-4);
  return camera;
}

}  // namespace

StereoCalibration random_rig(int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed) * 7919 + 1);
  const bool fisheye = seed % 4 == 3;
  StereoCalibration rig;
  rig.left = random_camera(random, fisheye);
  rig.right = rig.left;
  // Cameras of one kind differ by a percent or two.
  rig.right.focal_x *= random.uniform(0.99, 1.01);
  rig.right.focal_y = rig.right.focal_x;
  rig.right.center_x += kRigWidth * random.uniform(-0.02, 0.02);
  rig.right.center_y += kRigHeight * random.uniform(-0.02, 0.02);
  rig.right.coefficients[0] += random.uniform(-0.01, 0.01);
  const auto turn = [&] { return random.uniform(-1.5, 1.5) * CV_PI / 180; };
  const double x = turn(), y = turn(), z = turn();
  const Eigen::Matrix3d rotation = (Eigen::AngleAxisd(x, Eigen::Vector3d::UnitX()) *
                                    Eigen::AngleAxisd(y, Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(z, Eigen::Vector3d::UnitZ()))
                                       .toRotationMatrix();
  const double baseline = random.uniform(0.06, 0.15);
  const Eigen::Vector3d translation =
      rotation * Eigen::Vector3d(-baseline, baseline * random.uniform(-0.02, 0.02), 0);
  for (int i = 0; i < 9; ++i) rig.rotation[static_cast<std::size_t>(i)] = rotation(i / 3, i % 3);
  rig.translation = {translation.x(), translation.y(), translation.z()};
  return rig;
}

RawViews raw_views(const StereoCalibration& rig, const std::string& scene, double time) {
  render::Settings settings;
  settings.samples = 1;
  settings.noise = 1.5;
  const render::RawFrame frame =
      render::render_raw(render::make_scene(scene, 1), time, settings, render::RawRig(rig));
  return {frame.left, frame.right};
}

}  // namespace mtstereo::run::testing
