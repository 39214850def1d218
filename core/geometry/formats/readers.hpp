// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "geometry/formats/value.hpp"
#include "mtstereo/geometry/calibration.hpp"

// One reader per format of calibration files. All throw a FileError.

namespace mtstereo::formats {

/// What the caller of read_calibration() states.
struct Request {
  int width = 0;          ///< of the video [px], or 0
  int height = 0;         ///< of the video [px], or 0
  std::string selection;  ///< what follows '#' in the path, or empty
};

/// A file of OpenCV's FileStorage, or one for the cameras and one for their position.
StereoCalibration read_opencv(const std::vector<Entry>& files, const Request& request);
/// The camera_info files of ROS, left and right.
StereoCalibration read_camera_info(const Entry& left, const Entry& right, const Request& request);
/// A camchain of Kalibr.
StereoCalibration read_kalibr(const Entry& file, const Request& request);
/// The sensor.yaml files of EuRoC, left and right.
StereoCalibration read_euroc(const Entry& left, const Entry& right, const Request& request);
/// KITTI's calib_cam_to_cam.txt.
StereoCalibration read_kitti_raw(const Entry& file, const Request& request);
/// The calib.txt of KITTI's odometry and object data: a map of P0 to P3, or a list without names.
StereoCalibration read_kitti_odometry(const Entry& file, const Request& request);
/// The calib.txt of Middlebury and ETH3D.
StereoCalibration read_middlebury(const Entry& file, const Request& request);
/// The calibration of a DepthAI board as JSON.
StereoCalibration read_depthai(const Entry& file, const Request& request);
/// A ZED camera's SN....conf.
StereoCalibration read_zed(const Entry& file, const Request& request);
/// A file of ORB-SLAM2 or ORB-SLAM3.
StereoCalibration read_orbslam(const Entry& file, const Request& request);
/// A file of VINS-Fusion, and the camera files that it names.
StereoCalibration read_vins(const Entry& file, const Request& request);
/// A file of OV2SLAM.
StereoCalibration read_ov2slam(const Entry& file, const Request& request);
/// A calibration of Basalt.
StereoCalibration read_basalt(const Entry& file, const Request& request);
/// The .cameramodel files of mrcal, left and right.
StereoCalibration read_mrcal(const Entry& left, const Entry& right, const Request& request);
/// A list of cameras on a body, of OKVIS, SVO or maplab.
StereoCalibration read_camera_list(const Entry& file, const Request& request);
/// The K.txt of FoundationStereo.
StereoCalibration read_foundation_stereo(const Entry& file, const Request& request);
/// A configuration of stella_vslam or OpenVSLAM.
StereoCalibration read_stella(const Entry& file, const Request& request);
/// The intrinsics of a rectified camera, and the baseline.
StereoCalibration read_rectified_view(const Entry& file, const Request& request);
/// The camera of an image of Cityscapes.
StereoCalibration read_cityscapes(const Entry& file, const Request& request);
/// The cam_to_cam.yaml of DSEC.
StereoCalibration read_dsec(const Entry& file, const Request& request);
/// The cameras of a vehicle of Argoverse.
StereoCalibration read_argoverse(const Entry& file, const Request& request);
/// A table per camera, of Anipose, FreeMoCap, Caliscope or Pose2Sim.
StereoCalibration read_camera_tables(const Entry& file, const Request& request);
/// A file of the Calibrator of calib.io.
StereoCalibration read_calib_io(const Entry& file, const Request& request);
/// A camera file of AirSLAM.
StereoCalibration read_airslam(const Entry& file, const Request& request);

/// Whether a file is one of OpenCV's FileStorage: it has an entry with a name that read_opencv()
/// knows, or a matrix.
bool is_opencv(const Entry& file);
/// Whether a file is one of ORB-SLAM, without the matrices of OpenCV for raw views.
bool is_orbslam(const Entry& file);
/// Whether a file has a list of cameras on a body.
bool is_camera_list(const Entry& file);
/// Whether a file is one of stella_vslam.
bool is_stella(const Entry& file);
/// Whether a file is the camera of an image of Cityscapes.
bool is_cityscapes(const Entry& file);
/// Whether a file has the intrinsics of one camera and the baseline, but no R and T.
bool is_rectified_view(const Entry& file);
/// Whether a file states both cameras of a rectified pair and the baseline. No other format may
/// fit.
bool is_rectified_pair(const Entry& file);
/// Whether a file is the cam_to_cam.yaml of DSEC.
bool is_dsec(const Entry& file);
/// Whether a file has a table for each of several cameras.
bool has_camera_tables(const Entry& file);
/// Whether a file is one of calib.io.
bool is_calib_io(const Entry& file);
/// Whether a file is one of AirSLAM.
bool is_airslam(const Entry& file);
/// Whether a file is one of Basalt.
bool is_basalt(const Entry& file);
/// Whether a file is a camera_info of ROS.
bool is_camera_info(const Entry& file);

}  // namespace mtstereo::formats
