// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/calib3d.hpp>

#include "mtstereo/geometry/calibration.hpp"

// OpenCV's side of the comparisons.

namespace mtstereo::test {

inline cv::Mat camera_matrix(const CameraCalibration& camera) {
  return (cv::Mat_<double>(3, 3) << camera.focal_x, 0, camera.center_x, 0, camera.focal_y,
          camera.center_y, 0, 0, 1);
}

inline cv::Mat coefficients_of(const CameraCalibration& camera) {
  return camera.coefficients.empty() ? cv::Mat() : cv::Mat(camera.coefficients, true);
}

inline cv::Mat matrix_of(const Matrix3& values) {
  return cv::Mat(3, 3, CV_64F, const_cast<double*>(values.data())).clone();
}

/// Where OpenCV projects a point in front of the camera.
inline cv::Point2d opencv_projection(const CameraCalibration& camera, const Vector3& point) {
  const std::vector<cv::Point3d> points = {{point[0], point[1], point[2]}};
  std::vector<cv::Point2d> result;
  const cv::Vec3d none(0, 0, 0);
  if (camera.lens == LensModel::kFisheye) {
    cv::fisheye::projectPoints(points, result, none, none, camera_matrix(camera),
                               coefficients_of(camera));
  } else {
    cv::projectPoints(points, none, none, camera_matrix(camera), coefficients_of(camera), result);
  }
  return result[0];
}

}  // namespace mtstereo::test
