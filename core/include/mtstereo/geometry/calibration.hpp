// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mtstereo/export.hpp"
#include "mtstereo/result.hpp"

// The calibration of two cameras, and the files that it is read from and written to.
//
// Axes of a camera: x to the right, y downwards, z forward. The center of the first pixel is at
// (0, 0). Lengths are in meters.

namespace mtstereo {

/// A 3 x 3 matrix, row by row.
using Matrix3 = std::array<double, 9>;
/// A vector of three components.
using Vector3 = std::array<double, 3>;

/// How a lens maps directions to the image.
enum class LensModel {
  kNone,             ///< a pinhole: no distortion
  kPlumbBob,         ///< polynomial, rational, thin prism and tilted sensor as in OpenCV's calib3d
  kFisheye,          ///< equidistant: OpenCV's fisheye, Kalibr's equidistant
  kOmnidirectional,  ///< unified projection: Mei's model, OpenCV's omnidir, Kalibr's omni-radtan
};

/// One camera and its lens.
struct CameraCalibration {
  int width = 0;                      ///< of its image [px]
  int height = 0;                     ///< of its image [px]
  double focal_x = 0;                 ///< fx of K [px]
  double focal_y = 0;                 ///< fy of K [px]
  double center_x = 0;                ///< cx of K, the column of the principal point [px]
  double center_y = 0;                ///< cy of K, the row of the principal point [px]
  LensModel lens = LensModel::kNone;  ///< the meaning of `coefficients`
  /// The distortion: none for kNone; 4, 5, 8, 12 or 14 of k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tx ty
  /// for kPlumbBob; k1 k2 k3 k4 for kFisheye; xi k1 k2 p1 p2 for kOmnidirectional, with the focal
  /// lengths of the middle of the image: gamma / (1 + xi).
  std::vector<double> coefficients;

  /// True if all values are equal.
  friend bool operator==(const CameraCalibration&, const CameraCalibration&) = default;
};

/// How both views are turned and projected to become a rectified pair. Both rectified cameras have
/// square pixels, the same focal length, and the same row of the principal point.
struct Rectification {
  int width = 0;              ///< of the rectified images [px]
  int height = 0;             ///< of the rectified images [px]
  Matrix3 left_rotation{};    ///< from the axes of the left camera to the rectified axes (R1)
  Matrix3 right_rotation{};   ///< from the axes of the right camera to the rectified axes (R2)
  double focal_length = 0;    ///< [px]
  double left_center_x = 0;   ///< column of the principal point of the rectified left view [px]
  double right_center_x = 0;  ///< column of the principal point of the rectified right view [px]
  double center_y = 0;        ///< row of the principal point of both views [px]
  double baseline = 0;        ///< distance of the cameras [m]

  /// What to add to a disparity before focal_length * baseline / disparity is the depth [px]: the
  /// column of the principal point of the right view minus the left view's. Middlebury calls
  /// it doffs.
  double principal_offset() const { return right_center_x - left_center_x; }

  /// True if all values are equal.
  friend bool operator==(const Rectification&, const Rectification&) = default;
};

/// Two cameras and how they stand to each other.
struct StereoCalibration {
  CameraCalibration left;   ///< the left camera
  CameraCalibration right;  ///< the right camera
  /// R: a point with the coordinates X in the left camera has R X + T in the right one.
  Matrix3 rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  /// T [m]. The first component is negative if the cameras are in order.
  Vector3 translation{};
  /// The rectification that the file states; files without one have none, and rectify() computes
  /// it.
  std::optional<Rectification> rectification;
  /// What the file was recognized as, such as "OpenCV" or "Kalibr camchain"; for messages.
  std::string format;
  /// The date of the calibration in ISO 8601, if the file states it; otherwise empty.
  std::string date;
  /// What the user should know about the calibration, such as that its cameras were exchanged: one
  /// sentence each.
  std::vector<std::string> remarks;

  /// The distance of the cameras [m].
  MTSTEREO_API double baseline() const noexcept;
};

/// The longest baseline that is accepted [m]. A longer one is most likely in millimeters.
inline constexpr double kLongestBaseline = 10;

/// Reads a calibration. The format is recognized from the content: OpenCV FileStorage (YAML, XML or
/// JSON, also with intrinsics and extrinsics in two files), ROS camera_info (one file per camera),
/// Kalibr camchain, EuRoC sensor.yaml (one file per camera), KITTI calib_cam_to_cam.txt and
/// odometry calib.txt, Middlebury calib.txt, DepthAI JSON, ZED .conf, ORB-SLAM, VINS-Fusion,
/// Basalt, mrcal .cameramodel (one file per camera), the others that docs/calibration.md lists, and
/// the file of write_calibration().
///
/// `path`: a file, or two files separated by a comma where the format has one file per camera
/// (left, right) or one for intrinsics and one for extrinsics, or three (OpenCV, ROS: left, right,
/// extrinsics). "FILE#CHOICE" selects: "#gray" or "#color" (KITTI), "#cam1-cam0" (Kalibr:
/// left-right), "#1-2" (DepthAI: sockets left-right), "#HD" (ZED: resolution). `width`, `height`:
/// the size of the video [px], or 0 if it is not known; a format that states several resolutions
/// (ZED) selects by it, and one that states none (KITTI odometry, OpenCV) takes it. Where nothing
/// states a size, it stays 0.
///
/// Prints nothing. Fails with kInvalidCalibration, and a message that names the file, the entry and
/// what to do: a file that cannot be read or is not recognized, a missing camera or entry, a
/// baseline that is zero or longer than kLongestBaseline, values that are not finite. Cameras in
/// the other order are exchanged; StereoCalibration::remarks states that, and what else is unusual.
MTSTEREO_API Result<StereoCalibration> read_calibration(const std::string& path, int width = 0,
                                                        int height = 0) noexcept;

/// Writes a calibration as YAML that OpenCV's FileStorage reads, and plain YAML readers too: K, D,
/// R, T [m], the rectification if there is one, the units and the date. The file is written aside
/// and renamed, so that an interrupted program leaves no half of it; it replaces only files that
/// this function wrote, and empty ones. Without a date, the calibration gets the current one. Fails
/// with kInvalidCalibration or kSystem.
MTSTEREO_API Status write_calibration(const StereoCalibration& calibration,
                                      const std::string& path) noexcept;

/// Checks what read_calibration() checks, for a calibration from elsewhere. Sizes of 0 are unknown
/// sizes, which both cameras may have.
MTSTEREO_API Status check_calibration(const StereoCalibration& calibration) noexcept;

/// The calibration for video of another size with the same aspect ratio: focal lengths and centers
/// are scaled, with the shift of half a pixel that the position of the pixel centers needs. A
/// calibration of unknown size gets this one. Fails with kInvalidCalibration if the aspect ratios
/// differ by more than a pixel.
MTSTEREO_API Result<StereoCalibration> scale_calibration(const StereoCalibration& calibration,
                                                         int width, int height) noexcept;

}  // namespace mtstereo
