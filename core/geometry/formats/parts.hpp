// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/formats/value.hpp"
#include "mtstereo/geometry/calibration.hpp"

// What several formats have in common: matrices, lenses, projections. All functions throw a
// FileError that names the entry.

namespace mtstereo::formats {

/// From the axes of one camera to those of another: X becomes rotation X + translation.
struct Motion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m]

  /// The other way round.
  Motion inverse() const;
  /// This motion after `first`.
  Motion after(const Motion& first) const;
};

Eigen::Matrix3d to_eigen(const Matrix3& matrix);
Matrix3 to_array(const Eigen::Matrix3d& matrix);
/// Sets R and T of a calibration.
void set_motion(StereoCalibration& calibration, const Motion& motion);

/// The rotation by the length of the vector [rad] around it.
Eigen::Matrix3d rotation_of_vector(double x, double y, double z);

/// The rotation of a quaternion, whose length must be 1.
Eigen::Matrix3d rotation_of_quaternion(const Entry& entry, double w, double x, double y, double z);

/// K as nine numbers: sets focal lengths and center.
void set_camera_matrix(CameraCalibration& camera, const Entry& entry);
/// K as fx, fy, cx, cy.
void set_intrinsics(CameraCalibration& camera, const Entry& entry);
/// K from a value that is read already.
void set_camera_matrix(CameraCalibration& camera, const Entry& entry, const std::vector<double>& k);

/// Makes a camera whose K has gamma1 and gamma2 one of Mei's model, with k1, k2, p1, p2.
void set_omnidirectional(CameraCalibration& camera, const Entry& xi,
                         const std::vector<double>& distortion);

/// The lens model that a word of any of the formats means.
LensModel lens_model(const Entry& entry);
/// Sets lens and coefficients, and checks their number. No coefficients mean no distortion.
void set_lens(CameraCalibration& camera, LensModel lens, const Entry& coefficients);

/// A rotation: nine numbers, or three of a rotation vector.
Eigen::Matrix3d rotation_from(const Entry& entry);
/// The upper three rows of a 4x4 matrix that moves points.
Motion motion_from(const Entry& entry);

/// The size of images: width and height.
void set_size(CameraCalibration& camera, const Entry& width, const Entry& height);
void set_size(CameraCalibration& camera, const Entry& both);

/// Largest relative difference of the focal lengths of a rectified view.
inline constexpr double kRelativeFocalDifference = 1e-3;

/// The projections of a rectified pair, and the rotations where the file states them.
struct RectifiedViews {
  Eigen::Matrix3d left_rotation = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d right_rotation = Eigen::Matrix3d::Identity();
  std::vector<double> left_projection;   ///< 3x4, P of the left camera
  std::vector<double> right_projection;  ///< 3x4, P of the right camera
};

/// Those of two cameras without distortion. `product` is the focal length times the baseline [px
/// m].
RectifiedViews views_of(const CameraCalibration& left, const CameraCalibration& right,
                        double product);

/// The rectification with these projections. Their fourth columns are in units of `unit` [m].
/// Size: 0. `left` and `right` are the entries of the projections.
Rectification rectification_from(const RectifiedViews& views, const Entry& left, const Entry& right,
                                 double unit = 1);

/// How cameras stand to each other whose views are rectified so: both rectified cameras have the
/// same axes, and the right one is at the baseline.
Motion motion_of(const Rectification& rectification);

/// The meters that a length of 1 has, by a unit such as "mm" or a number.
double length_unit(const Entry& entry);

/// Checks T as read_calibration() documents it. `hint` is what to do about a length that is in
/// another unit.
void check_translation(const Eigen::Vector3d& translation, const Entry& entry,
                       std::string_view hint);

/// Sets R and T of cameras whose poses on a body are 4x4 matrices that move points from a camera to
/// the body [m].
void set_motion_on_body(StereoCalibration& calibration, const Entry& left, const Entry& right);

/// A calibration of cameras whose views are rectified already.
StereoCalibration rectified_cameras(const Rectification& rectification);
/// A camera without distortion, and the entry of its intrinsics.
struct RectifiedCamera {
  CameraCalibration camera;
  Entry k;
};
/// The same for two cameras at this distance [m]. `length` is the entry of the baseline.
StereoCalibration rectified_pair(const RectifiedCamera& left, const RectifiedCamera& right,
                                 double baseline, const Entry& length);

/// The two names of a selection such as "cam1-cam0". An error if it has another form.
struct Selection {
  std::string left, right;
};
Selection selected_pair(const Entry& file, const std::string& selection, std::string_view example);
/// Two cameras of a list, by their indices. A selection such as "1-0" has them; the default is the
/// first and the second one. `count` is the size of the list.
struct CameraPair {
  std::size_t left = 0, right = 1;
};
CameraPair selected_cameras(const Entry& file, const std::string& selection, std::size_t count);
/// Fails if something was selected, for a format without a choice.
void no_selection(const Entry& file, const std::string& selection);

}  // namespace mtstereo::formats
