// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/rectification.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <string>

#include "base/guard.hpp"
#include "geometry/calibration_problem.hpp"
#include "geometry/lens.hpp"
#include "geometry/rectified_frame.hpp"
#include "geometry/view_coverage.hpp"
#include "mtstereo/parameters.hpp"

// If both lenses are polynomials that OpenCV inverts correctly, the result is that of
// cv::stereoRectify(), so that other programs get the same pair from the same calibration. For all
// others (fisheye lenses, views of different sizes, wide lenses for which the five iterations of
// cv::undistortPoints() do not suffice) the rotations are computed in the same way, and
// frame_views() chooses the focal length and the principal points: OpenCV's function for fisheye
// lenses looks at four points only.

namespace mtstereo {
namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Vector = Eigen::Vector3d;

/// The smallest rotation from one direction to another one that is not opposite. The one of Eigen,
/// for any two vectors, has a singular value decomposition, which takes longer to compile than this
/// file.
Eigen::Quaterniond turn(const Vector& from, const Vector& to) {
  const double length = std::sqrt((1 + to.dot(from)) * 2);
  const Vector axis = from.cross(to) * (1 / length);
  return {length * 0.5, axis.x(), axis.y(), axis.z()};
}

Matrix3 from_eigen(const Matrix& m) {
  Matrix3 result{};
  Eigen::Map<Matrix>(result.data()) = m;
  return result;
}

/// The rotations of both views.
struct Rotations {
  Matrix left;
  Matrix right;
  double baseline = 0;  ///< [m]
};

Error unusable(const std::string& text) { return {ErrorCode::kInvalidCalibration, text}; }

/// Each view is turned by half of the rotation between the cameras, and then both so that the
/// baseline is the x axis.
Result<Rotations> rotations_of(const StereoCalibration& calibration) {
  const Eigen::AngleAxisd whole(Eigen::Map<const Matrix>(calibration.rotation.data()));
  const Matrix half = Eigen::AngleAxisd(-whole.angle() / 2, whole.axis()).toRotationMatrix();
  const Vector translation(calibration.translation.data());
  const Vector baseline = half * translation;
  const Vector size = baseline.cwiseAbs();
  if (size[2] >= size[0] && size[2] >= size[1]) {
    return unusable(
        "The calibration cannot be rectified: one camera is in front of the other one. The "
        "cameras must be side by side.");
  }
  if (size[1] > size[0]) {
    return unusable(
        "The calibration cannot be rectified: one camera is above the other one. The cameras must "
        "be side by side; for a vertical pair, rotate both videos by 90 degrees and calibrate "
        "them again.");
  }
  if (baseline[0] > 0) {
    return unusable(
        "The calibration cannot be rectified: the views are swapped, the right camera is to the "
        "left of the left one. Exchange the two cameras.");
  }
  // The smallest rotation that does it, as OpenCV does.
  const Matrix axes = turn(baseline.normalized(), -Vector::UnitX()).toRotationMatrix();
  return Rotations{axes * half.transpose(), axes * half, translation.norm()};
}

cv::Mat matrix_of(const CameraCalibration& camera) {
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
  matrix.at<double>(0, 0) = camera.focal_x;
  matrix.at<double>(0, 2) = camera.center_x;
  matrix.at<double>(1, 1) = camera.focal_y;
  matrix.at<double>(1, 2) = camera.center_y;
  return matrix;
}

cv::Mat distortion_of(const CameraCalibration& camera) {
  if (camera.lens == LensModel::kNone || camera.coefficients.empty()) return {};
  return cv::Mat(camera.coefficients, true);
}

/// True if OpenCV finds the directions of the border of the image correctly. The limit is far above
/// what its iterations leave for a lens that they suit.
bool opencv_inverts(const CameraCalibration& camera) {
  if (camera.lens != LensModel::kNone && camera.lens != LensModel::kPlumbBob) return false;
  constexpr int kSteps = 8;
  constexpr double kLargestError = 2;  // [px]
  std::vector<cv::Point2d> positions;
  for (int y = 0; y <= kSteps; ++y) {
    for (int x = 0; x <= kSteps; ++x) {
      positions.emplace_back((camera.width - 1.0) * x / kSteps, (camera.height - 1.0) * y / kSteps);
    }
  }
  std::vector<cv::Point2d> directions;
  cv::undistortPoints(positions, directions, matrix_of(camera), distortion_of(camera));
  const Lens lens(camera);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto back = lens.project({directions[i].x, directions[i].y, 1});
    const double error = std::hypot(back[0] - positions[i].x, back[1] - positions[i].y);
    if (!(error < kLargestError)) return false;
  }
  return true;
}

bool suits_opencv(const StereoCalibration& calibration) {
  const CameraCalibration& left = calibration.left;
  const CameraCalibration& right = calibration.right;
  return left.width == right.width && left.height == right.height && opencv_inverts(left) &&
         opencv_inverts(right);
}

Matrix3 from_opencv(const cv::Mat& m) {
  Matrix3 result{};
  std::copy_n(m.ptr<double>(), result.size(), result.begin());
  return result;
}

/// The views as cv::stereoRectify() turns and frames them; std::nullopt if it cannot. Replaces the
/// rotations in `result`.
std::optional<RectifiedFrame> opencv_frame(const StereoCalibration& calibration,
                                           const RectificationOptions& options,
                                           Rectification& result) {
  const cv::Mat rotation(3, 3, CV_64F, const_cast<double*>(calibration.rotation.data()));
  const cv::Mat translation(3, 1, CV_64F, const_cast<double*>(calibration.translation.data()));
  cv::Mat left_turn;
  cv::Mat right_turn;
  cv::Mat left;
  cv::Mat right;
  cv::Mat to_depth;
  const CameraCalibration& camera = calibration.left;
  cv::stereoRectify(matrix_of(camera), distortion_of(camera), matrix_of(calibration.right),
                    distortion_of(calibration.right), cv::Size(camera.width, camera.height),
                    rotation, translation, left_turn, right_turn, left, right, to_depth,
                    options.zero_disparity ? cv::CALIB_ZERO_DISPARITY : 0, options.alpha,
                    cv::Size(result.width, result.height));
  const RectifiedFrame frame{left.at<double>(0, 0), left.at<double>(0, 2), right.at<double>(0, 2),
                             left.at<double>(1, 2)};
  if (!frame.is_usable()) return std::nullopt;
  result.left_rotation = from_opencv(left_turn);
  result.right_rotation = from_opencv(right_turn);
  return frame;
}

Status check_options(const RectificationOptions& options) {
  if (options.alpha != kKeepScale && !(options.alpha >= 0 && options.alpha <= 1)) {
    return Error{ErrorCode::kInvalidParameter,
                 "alpha must be 0 to 1, or -1 for the focal length "
                 "of the cameras, but it is " +
                     std::to_string(options.alpha) + "."};
  }
  for (const int side : {options.width, options.height}) {
    if (side >= 0 && side <= kLargestImageSide) continue;
    return Error{ErrorCode::kInvalidParameter,
                 "The size of the rectified images must be 0 to " +
                     std::to_string(kLargestImageSide) + " px, but it is " +
                     std::to_string(options.width) + "x" + std::to_string(options.height) + "."};
  }
  return {};
}

Result<Rectification> compute(const StereoCalibration& calibration,
                              const RectificationOptions& options) {
  const Result<Rotations> rotations = rotations_of(calibration);
  if (!rotations) return rotations.error();
  Rectification result;
  result.width = options.width != 0 ? options.width : calibration.left.width;
  result.height = options.height != 0 ? options.height : calibration.left.height;
  result.left_rotation = from_eigen(rotations->left);
  result.right_rotation = from_eigen(rotations->right);
  result.baseline = rotations->baseline;
  std::optional<RectifiedFrame> frame;
  if (suits_opencv(calibration)) {
    frame = opencv_frame(calibration, options, result);
  }
  if (!frame) {
    const Result<RectifiedFrame> framed = frame_views(calibration, result, options);
    if (!framed) return framed.error();
    frame = *framed;
  }
  result.focal_length = frame->focal_length;
  result.left_center_x = frame->left_center_x;
  result.right_center_x = frame->right_center_x;
  result.center_y = frame->center_y;
  if (!shows_anything(calibration, result, Rectifier::Side::kLeft) ||
      !shows_anything(calibration, result, Rectifier::Side::kRight)) {
    return unusable(std::string("The calibration cannot be rectified: ") + kNoCommonPart + ".");
  }
  return result;
}

}  // namespace

Result<Rectification> rectify(const StereoCalibration& calibration,
                              const RectificationOptions& options) noexcept {
  return guarded([&]() -> Result<Rectification> {
    if (const Status status = check_options(options); !status) return status.error();
    for (const CameraCalibration* camera : {&calibration.left, &calibration.right}) {
      const std::string problem = camera_problem(*camera);
      if (!problem.empty()) {
        const char* name = camera == &calibration.left ? "left" : "right";
        return unusable(std::string("The calibration of the ") + name + " camera " + problem);
      }
    }
    if (const std::string problem = pose_problem(calibration); !problem.empty()) {
      return unusable(problem);
    }
    if (calibration.rectification && options == RectificationOptions{}) {
      return *calibration.rectification;
    }
    try {
      return compute(calibration, options);
    } catch (const cv::Exception& exception) {
      return unusable("The calibration cannot be rectified: " + exception.err + ".");
    }
  });
}

}  // namespace mtstereo
