// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/calibration_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/outputs/user_error.hpp"
#include "mtstereo/geometry/calibration.hpp"
#include "recordings/inputs/recording_files.hpp"
#include "recordings/inputs/sources.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

bool is_identity(const Matrix3& rotation) {
  constexpr Matrix3 kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (std::size_t i = 0; i < rotation.size(); ++i) {
    if (std::abs(rotation[i] - kIdentity[i]) > 1e-9) return false;
  }
  return true;
}

// Cameras without distortion whose views are the rectified ones that the calibration describes.
bool is_rectified(const StereoCalibration& calibration) {
  const CameraCalibration &left = calibration.left, &right = calibration.right;
  if (left.lens != LensModel::kNone || right.lens != LensModel::kNone) return false;
  const std::optional<Rectification>& views = calibration.rectification;
  const auto are_equal = [](double a, double b) { return std::abs(a - b) < 1e-3; };
  return views && is_identity(views->left_rotation) && is_identity(views->right_rotation) &&
         are_equal(left.focal_x, views->focal_length) &&
         are_equal(right.focal_x, views->focal_length) &&
         are_equal(left.center_x, views->left_center_x) &&
         are_equal(right.center_x, views->right_center_x);
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
         bool rectified) {
  recording.calibration = path;
  recording.rectified = rectified;
  recording.remarks.push_back(
      "Calibration: " + path + " (" + calibration.format + "). " +
      (recording.rectified ? "The views are taken as rectified; it gives the meters."
                           : "The views are not rectified: they are rectified by it first."));
}

bool are_equal(const StereoCalibration& a, const StereoCalibration& b) {
  return a.left == b.left && a.right == b.right && a.rotation == b.rotation &&
         a.translation == b.translation && a.rectification == b.rectification;
}

// Whether the views are rectified by the names of the file or the folders around it.
std::optional<bool> rectified_by_name(fs::path view) {
  static const std::regex raw("(un|no[nt][_-]?)rectified|(^|[^n])distorted");
  static const std::regex rectified("undistorted|rectified|(^|[^a-z])rect([^a-z]|$)");
  constexpr int kLevels = 3;
  for (int i = 0; i <= kLevels && view.has_filename(); ++i, view = view.parent_path()) {
    const std::string name = files::lower_stem(view);
    if (std::regex_search(name, raw)) return false;
    if (std::regex_search(name, rectified)) return true;
  }
  return std::nullopt;
}

// Why a calibration is not the one of these views, by their names; empty if it may be.
std::string contradiction(const std::string& path, const StereoCalibration& calibration,
                          const fs::path& view) {
  const std::optional<bool> named = rectified_by_name(view);
  if (!named || *named == is_rectified(calibration)) return {};
  if (*named && calibration.rectification) return {};  // it describes these views, too
  return path + ": describes " + (*named ? "raw" : "rectified") + " views, and those of " +
         view.parent_path().string() + (*named ? " are" : " are not") +
         " rectified, by their names; --calibration uses it";
}

// Whether a file states the size of the views, and not only their shape.
bool states_size(const std::string& path, int width, int height) {
  const Result<StereoCalibration> any = read_calibration(path);
  if (any && any->left.width == 0) return false;
  const Result<StereoCalibration> fitting = read_calibration(path, width, height);
  return fitting && fitting->left.width == width && fitting->left.height == height;
}

// The files that can be used, without those that state the same.
struct Usable {
  std::vector<std::pair<std::string, StereoCalibration>> calibrations;
  std::string problem;  // of one that cannot be used
};

// What a calibration is to be read as for these views: KITTI has two pairs of cameras.
std::string with_choice(const std::string& path, const Recording& recording, int width,
                        int height) {
  for (const fs::path& part : file_of(recording.left)) {
    if (part != "image_0" && part != "image_00") continue;
    if (read_calibration(path + "#gray", width, height)) return path + "#gray";
  }
  return path;
}

Usable usable_of(const CalibrationLevel& level, const Recording& recording,
                 const InputOptions& options, int width, int height) {
  Usable usable;
  auto& known = usable.calibrations;
  for (const std::string& each : level.paths) {
    const std::string path = with_choice(each, recording, width, height);
    Result<StereoCalibration> calibration = fitting(path, width, height);
    if (!calibration) {
      if (usable.problem.empty()) usable.problem = calibration.error().message;
      continue;
    }
    std::string contrary =
        options.rectified ? "" : contradiction(path, *calibration, file_of(recording.left));
    if (!level.is_of_views && !states_size(path, width, height)) {
      contrary =
          path + ": is not beside the views and does not state their size; --calibration uses it";
    }
    const bool is_known = std::any_of(known.begin(), known.end(), [&](const auto& other) {
      return are_equal(other.second, *calibration);
    });
    if (!contrary.empty()) {
      usable.problem = contrary;
    } else if (!is_known) {
      known.emplace_back(path, std::move(*calibration));
    }
  }
  return usable;
}

std::string several(const Usable& usable) {
  return "such as " + usable.calibrations[0].first + " and " + usable.calibrations[1].first +
         ": choose one by --calibration";
}

// Uses the one that is found at a level. False if there is none.
bool use_one_of(const Usable& usable, Recording& recording, const InputOptions& options) {
  if (usable.calibrations.empty()) return false;
  if (usable.calibrations.size() > 1) {
    recording.remarks.push_back(kNoCalibration + ("there are several, " + several(usable)) + ".");
  } else {
    const auto& [path, calibration] = usable.calibrations.front();
    const bool named = rectified_by_name(file_of(recording.left)).value_or(false);
    use(recording, path, calibration,
        options.rectified.value_or(named || is_rectified(calibration)));
  }
  return true;
}

}  // namespace

void choose_calibration(FoundRecording& found, const InputOptions& options, int width, int height) {
  Recording& recording = found.recording;
  recording.rectified = options.rectified.value_or(true);
  recording.shape = options.shape;
  if (!options.calibration.empty()) {
    check_regular(options.calibration);
    const Result<StereoCalibration> given = fitting(options.calibration, width, height);
    if (!given) throw UserError(given.error().message);
    use(recording, options.calibration, *given, options.rectified.value_or(is_rectified(*given)));
    const std::optional<bool> named = rectified_by_name(file_of(recording.left));
    if (!options.rectified && named && *named != recording.rectified) {
      recording.remarks.push_back(std::string("By the names of their folders, the views are ") +
                                  (*named ? "rectified: if so, state --rectified yes."
                                          : "raw: if so, state --rectified no."));
    }
    return;
  }
  const Usable beside = usable_of({found.calibrations, true}, recording, options, width, height);
  if (beside.calibrations.size() > 1) {
    throw UserError("there are several calibrations beside the input, " + several(beside));
  }
  if (use_one_of(beside, recording, options)) return;
  std::string problem = beside.problem;
  for (const CalibrationLevel& level : found.calibrations_above) {
    const Usable above = usable_of(level, recording, options, width, height);
    if (use_one_of(above, recording, options)) return;
    if (problem.empty()) problem = above.problem;
  }
  if (!problem.empty()) recording.remarks.push_back(kNoCalibration + problem);
  if (options.rectified == false) {
    throw UserError(recording.name + ": raw views need a calibration (--calibration)");
  }
}

}  // namespace mtstereo::run
