// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run/calibration_choice.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "mtstereo/geometry/calibration.hpp"
#include "run/file_names.hpp"
#include "run/run_error.hpp"
#include "run/view_names.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

std::string lower_stem(const fs::path& file) {
  std::string stem = file.stem().string();
  for (char& each : stem) each = static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
  return stem;
}

bool may_be_calibration(const fs::path& file) {
  constexpr std::array<std::string_view, 6> kExtensions{".yml",  ".yaml", ".txt",
                                                        ".json", ".xml",  ".conf"};
  const std::string extension = extension_of(file);
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// Lower is better; 0 if the name is not that of a calibration of both cameras.
int rank_of(const fs::path& file) {
  const std::string stem = lower_stem(file);
  if (stem == "calibration" || stem == "calib") return 1;
  if (stem == "calib_cam_to_cam") return 2;
  if (stem.find("camchain") != std::string::npos) return 3;
  if (extension_of(file) == ".conf" && stem.starts_with("sn")) return 4;
  if (stem.find("stereo") != std::string::npos) return 5;
  if (stem.find("calib") != std::string::npos) return 6;
  return 0;
}

void add_pairs(std::vector<std::string>& found, std::vector<fs::path> files) {
  for (const PathPair& pair : take_pairs(files)) {
    found.push_back(pair.left.string() + "," + pair.right.string());
  }
  const auto find = [&files](const char* word) {
    return std::find_if(files.begin(), files.end(), [word](const fs::path& file) {
      return lower_stem(file).find(word) != std::string::npos;
    });
  };
  const auto intrinsics = find("intrinsic"), extrinsics = find("extrinsic");
  if (intrinsics != files.end() && extrinsics != files.end()) {
    found.push_back(intrinsics->string() + "," + extrinsics->string());
  }
}

bool is_identity(const Matrix3& rotation) {
  constexpr Matrix3 kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (std::size_t i = 0; i < rotation.size(); ++i) {
    if (std::abs(rotation[i] - kIdentity[i]) > 1e-9) return false;
  }
  return true;
}

// Cameras without distortion that look in the same direction, side by side: their views are a
// rectified pair.
bool is_rectified(const StereoCalibration& calibration) {
  const CameraCalibration &left = calibration.left, &right = calibration.right;
  if (left.lens != LensModel::kNone || right.lens != LensModel::kNone) return false;
  const double sideways = std::abs(calibration.translation[0]) * 1e-3;
  return is_identity(calibration.rotation) && std::abs(left.focal_x - right.focal_x) < 1e-3 &&
         std::abs(left.focal_y - right.focal_y) < 1e-3 &&
         std::abs(left.center_y - right.center_y) < 1e-3 &&
         std::abs(calibration.translation[1]) < sideways &&
         std::abs(calibration.translation[2]) < sideways;
}

// Why a calibration does not fit, or "".
std::string use(Recording& recording, const std::string& path, const InputOptions& options,
                int width, int height) {
  const Result<StereoCalibration> read = read_calibration(path, width, height);
  if (!read) return read.error().message;
  const Result<StereoCalibration> scaled = scale_calibration(*read, width, height);
  if (!scaled) return scaled.error().message;
  recording.calibration = path;
  recording.rectified = options.rectified.value_or(is_rectified(*scaled));
  if (!recording.rectified && !options.rectified) {
    recording.remarks.push_back("By " + path + " (" + read->format +
                                "), the views are not rectified: they are rectified first.");
  }
  return "";
}

}  // namespace

std::vector<std::string> calibrations_in(const std::vector<fs::path>& folders) {
  std::vector<std::string> found;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> files = files_in(folder);
    std::erase_if(files, [](const fs::path& file) { return !may_be_calibration(file); });
    std::vector<fs::path> whole;
    std::copy_if(files.begin(), files.end(), std::back_inserter(whole),
                 [](const fs::path& file) { return rank_of(file) > 0; });
    std::stable_sort(whole.begin(), whole.end(),
                     [](const fs::path& a, const fs::path& b) { return rank_of(a) < rank_of(b); });
    for (const fs::path& file : whole) found.push_back(file.string());
    add_pairs(found, files);
  }
  std::vector<std::string> unique;
  for (const std::string& each : found) {
    if (std::find(unique.begin(), unique.end(), each) == unique.end()) unique.push_back(each);
  }
  return unique;
}

void choose_calibration(Recording& recording, const std::vector<std::string>& beside,
                        const InputOptions& options, int width, int height) {
  recording.rectified = options.rectified.value_or(true);
  recording.shape = options.shape;
  if (!options.calibration.empty()) {
    const std::string problem = use(recording, options.calibration, options, width, height);
    if (!problem.empty()) throw RunError(problem);
    return;
  }
  std::string first_problem;
  for (const std::string& path : beside) {
    const std::string problem = use(recording, path, options, width, height);
    if (problem.empty()) return;
    if (first_problem.empty()) first_problem = problem;
  }
  if (!first_problem.empty()) {
    recording.remarks.push_back("No calibration is used: " + first_problem);
  }
  if (options.rectified == false) {
    throw RunError(recording.name + ": raw views need a calibration (--calibration)");
  }
}

}  // namespace mtstereo::run
