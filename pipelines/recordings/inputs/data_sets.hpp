// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// Calibrations in a folder around the views, for read_calibration().
struct CalibrationLevel {
  std::vector<std::string> paths;
  /// They lie with the views, or have the name of the scene. Others must state the size of the
  /// views, since a folder may have those of other cameras.
  bool is_of_views = false;
};

/// A recording as it lies in a folder, before its frames are looked at.
struct FoundRecording {
  Recording recording;
  std::vector<std::string> calibrations;             ///< beside the views, for read_calibration()
  std::vector<CalibrationLevel> calibrations_above;  ///< used without one beside the views
  std::vector<std::filesystem::path> used_folders;   ///< folders in which nothing else is searched
};

/// A folder of KITTI odometry: image_0 and image_1 or image_2 and image_3, calib.txt, times.txt.
std::optional<FoundRecording> find_kitti_odometry(const std::filesystem::path& folder);
/// A folder of KITTI raw data: image_00 .. image_03 with data/ and timestamps.txt.
std::optional<FoundRecording> find_kitti_raw(const std::filesystem::path& folder);
/// A folder of EuRoC, or of another data set in the ASL format: mav0/cam0 and mav0/cam1.
std::optional<FoundRecording> find_euroc(const std::filesystem::path& folder);
/// A pair of Middlebury or ETH3D: im0.png, im1.png, calib.txt.
std::optional<FoundRecording> find_pair_folder(const std::filesystem::path& folder);

/// The name of a folder, also if its path ends with "." or "/".
std::string folder_name(const std::filesystem::path& folder);

}  // namespace mtstereo::run
