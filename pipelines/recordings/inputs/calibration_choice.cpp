// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/calibration_choice.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/outputs/user_error.hpp"
#include "mtstereo/geometry/calibration.hpp"
#include "recordings/inputs/recording_files.hpp"
#include "recordings/inputs/view_names.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

std::string lower_stem(const fs::path& file) {
  std::string stem = file.stem().string();
  for (char& each : stem) each = static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
  return stem;
}

// Those of Python and MATLAB cannot be read: the remark says how to convert them.
bool may_be_calibration(const fs::path& file) {
  constexpr std::array<std::string_view, 11> kExtensions{
      ".yml", ".yaml", ".txt", ".json", ".xml", ".conf", ".toml", ".ini", ".npz", ".pkl", ".mat"};
  const std::string extension = files::extension_of(file);
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// Whether the name is that of a calibration of both cameras.
bool is_calibration_name(const fs::path& file) {
  const std::string stem = lower_stem(file);
  if (files::extension_of(file) == ".conf" && stem.starts_with("sn")) return true;
  constexpr std::array<std::string_view, 3> kWords{"calib", "stereo", "camchain"};
  return std::any_of(kWords.begin(), kWords.end(), [&stem](std::string_view word) {
    return stem.find(word) != std::string::npos;
  });
}

// Whether a file of one view has poses or times, as in TartanAir.
bool has_poses_or_times(const fs::path& file) {
  const std::string stem = lower_stem(file);
  return files::extension_of(file) == ".txt" &&
         (stem.find("pose") != std::string::npos || stem.find("time") != std::string::npos);
}

void add_pairs(std::vector<std::string>& found, std::vector<fs::path> files) {
  const std::vector<PathPair> pairs = take_pairs(files);
  const auto find = [&files](const char* word) {
    return std::find_if(files.begin(), files.end(), [word](const fs::path& file) {
      return lower_stem(file).find(word) != std::string::npos;
    });
  };
  const auto intrinsics = find("intrinsic"), extrinsics = find("extrinsic");
  for (const PathPair& pair : pairs) {
    const std::string both = pair.left.string() + "," + pair.right.string();
    found.push_back(both);
    if (extrinsics != files.end()) found.push_back(both + "," + extrinsics->string());
  }
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

// Reading a pipe or a device may never end.
void check_regular(const std::string& calibration) {
  Recording recording;
  recording.calibration = calibration;
  for (const fs::path& file : recording_files(recording)) {
    std::error_code error;
    if (!fs::exists(file, error) || fs::is_regular_file(file, error)) continue;
    if (fs::is_directory(file, error)) continue;  // read_calibration() names the remedy
    throw UserError(file.string() + ": a calibration is a file, and no pipe or device");
  }
}

// A calibration for views of this size.
Result<StereoCalibration> fitting(const std::string& path, int width, int height) {
  const Result<StereoCalibration> read = read_calibration(path, width, height);
  return read ? scale_calibration(*read, width, height) : read;
}

void use(Recording& recording, const std::string& path, const StereoCalibration& calibration,
         const InputOptions& options) {
  recording.calibration = path;
  recording.rectified = options.rectified.value_or(is_rectified(calibration));
  recording.remarks.push_back(
      "Calibration: " + path + " (" + calibration.format + "). " +
      (recording.rectified ? "The views are taken as rectified; it gives the meters."
                           : "The views are not rectified: they are rectified by it first."));
}

bool are_equal(const StereoCalibration& a, const StereoCalibration& b) {
  return a.left == b.left && a.right == b.right && a.rotation == b.rotation &&
         a.translation == b.translation && a.rectification == b.rectification;
}

// The files that can be used of those beside the input, without those that state the same.
struct Usable {
  std::vector<std::pair<std::string, StereoCalibration>> calibrations;
  std::string first_problem;
};

Usable usable_of(const std::vector<std::string>& beside, int width, int height) {
  Usable usable;
  for (const std::string& path : beside) {
    Result<StereoCalibration> calibration = fitting(path, width, height);
    if (calibration) {
      auto& known = usable.calibrations;
      const bool is_new = std::none_of(known.begin(), known.end(), [&](const auto& each) {
        return are_equal(each.second, *calibration);
      });
      if (is_new) known.emplace_back(path, std::move(*calibration));
    } else if (usable.first_problem.empty()) {
      usable.first_problem = calibration.error().message;
    }
  }
  return usable;
}

}  // namespace

std::vector<std::string> calibrations_in(const std::vector<fs::path>& folders) {
  std::vector<std::string> found;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> files = files::files_in(folder);
    std::erase_if(files, [](const fs::path& file) { return !may_be_calibration(file); });
    for (const fs::path& file : files) {
      if (is_calibration_name(file)) found.push_back(file.string());
    }
    std::erase_if(files, has_poses_or_times);
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
    check_regular(options.calibration);
    const Result<StereoCalibration> given = fitting(options.calibration, width, height);
    if (!given) throw UserError(given.error().message);
    use(recording, options.calibration, *given, options);
    return;
  }
  const Usable usable = usable_of(beside, width, height);
  if (usable.calibrations.size() > 1) {
    throw UserError("there are several calibrations beside the input, such as " +
                    usable.calibrations[0].first + " and " + usable.calibrations[1].first +
                    ": choose one by --calibration");
  }
  if (usable.calibrations.size() == 1) {
    const auto& [path, calibration] = usable.calibrations.front();
    use(recording, path, calibration, options);
    return;
  }
  if (!usable.first_problem.empty()) {
    recording.remarks.push_back("No calibration is used: " + usable.first_problem);
  }
  if (options.rectified == false) {
    throw UserError(recording.name + ": raw views need a calibration (--calibration)");
  }
}

}  // namespace mtstereo::run
