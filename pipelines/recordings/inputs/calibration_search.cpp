// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/calibration_search.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "lib/files/file_names.hpp"
#include "recordings/inputs/view_names.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

// Those of Python and MATLAB cannot be read: the remark says how to convert them.
bool may_be_calibration(const fs::path& file) {
  constexpr std::array<std::string_view, 11> kExtensions{
      ".yml", ".yaml", ".txt", ".json", ".xml", ".conf", ".toml", ".ini", ".npz", ".pkl", ".mat"};
  const std::string extension = files::extension_of(file);
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// Whether the name is that of a calibration of both cameras.
bool is_calibration_name(const fs::path& file) {
  const std::string stem = files::lower_stem(file);
  if (files::extension_of(file) == ".conf" && stem.starts_with("sn")) return true;
  if (file.filename() == "K.txt") return true;  // of FoundationStereo
  constexpr std::array<std::string_view, 3> kWords{"calib", "stereo", "camchain"};
  return std::any_of(kWords.begin(), kWords.end(), [&stem](std::string_view word) {
    return stem.find(word) != std::string::npos;
  });
}

// Whether a file of one view has poses or times, as in TartanAir.
bool has_poses_or_times(const fs::path& file) {
  const std::string stem = files::lower_stem(file);
  return files::extension_of(file) == ".txt" &&
         (stem.find("pose") != std::string::npos || stem.find("time") != std::string::npos);
}

void add_pairs(std::vector<std::string>& found, std::vector<fs::path> files) {
  const std::vector<PathPair> pairs = take_pairs(files);
  const auto find = [&files](const char* word) {
    return std::find_if(files.begin(), files.end(), [word](const fs::path& file) {
      return files::lower_stem(file).find(word) != std::string::npos;
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

// One for the cameras of images, such as camera/, has the folders of the scenes.
bool is_calibration_folder(const fs::path& folder, const fs::path& scene) {
  const std::string name = files::lower_stem(folder);
  return name.find("calib") != std::string::npos ||
         (name == "camera" && !scene.empty() && files::is_folder(folder / scene));
}

// The part of the paths below a folder that both views share, without their own folders.
fs::path scene_of(const fs::path& left, const fs::path& right, const fs::path& folder) {
  const fs::path a = left.lexically_relative(folder), b = right.lexically_relative(folder);
  fs::path scene;
  for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end(); ++x, ++y) {
    if (*x == *y && *x != ".") scene /= *x;
  }
  return scene;
}

void append_files(std::vector<fs::path>& files, const fs::path& folder, const fs::path& stem) {
  for (const fs::path& file : files::files_in(folder)) {
    if (stem.empty() || file.stem() == stem) files.push_back(file);
  }
}

// The files of a folder for calibrations that have the name of the scene.
std::vector<fs::path> files_of_scene(const fs::path& folder, const fs::path& scene) {
  std::vector<fs::path> files;
  if (scene.empty()) return files;
  append_files(files, folder / scene, {});
  if (!files.empty()) return files;
  for (const fs::path& name : scene) {
    append_files(files, folder / name, {});
    append_files(files, folder, name);
    for (const fs::path& inner : files::folders_in(folder)) append_files(files, inner, name);
  }
  return files;
}

void append_calibrations(std::vector<std::string>& found, std::vector<fs::path> files) {
  std::erase_if(files, [](const fs::path& file) { return !may_be_calibration(file); });
  for (const fs::path& file : files) found.push_back(file.string());
  std::erase_if(files, has_poses_or_times);
  add_pairs(found, files);
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

std::vector<CalibrationLevel> calibrations_above(const fs::path& left, const fs::path& right,
                                                 fs::path folder, int levels) {
  std::vector<CalibrationLevel> found;
  for (int level = 0; level <= levels; ++level, folder = folder.parent_path()) {
    CalibrationLevel of_scene{{}, true}, others{calibrations_in({folder}), level == 0};
    const fs::path scene = scene_of(left, right, folder);
    for (const fs::path& inner : files::folders_in(folder)) {
      if (!is_calibration_folder(inner, scene)) continue;
      const std::vector<fs::path> files = files_of_scene(inner, scene);
      append_calibrations(of_scene.paths, files);
      if (files.empty()) append_calibrations(others.paths, files::files_in(inner));
    }
    found.push_back(std::move(of_scene));
    found.push_back(std::move(others));
  }
  return found;
}

}  // namespace mtstereo::run
