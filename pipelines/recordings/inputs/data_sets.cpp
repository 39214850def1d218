// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/data_sets.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>

#include "lib/files/file_names.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/image_lists.hpp"
#include "recordings/inputs/name_times.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

constexpr double kKittiRate = 10;  // of all sequences [1/s]
constexpr int kEth3dRange = 64;    // the largest disparity of the data set [px]

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

// "0.000000e+00" in seconds, or "2011-09-26 13:02:25.964389445".
std::optional<Nanoseconds> parse_time(const std::string& line) {
  std::tm date{};
  double seconds = 0;
  if (std::sscanf(line.c_str(), "%d-%d-%d %d:%d:%lf", &date.tm_year, &date.tm_mon, &date.tm_mday,
                  &date.tm_hour, &date.tm_min, &seconds) == 6) {
    date.tm_year -= 1900;
    date.tm_mon -= 1;
    const std::time_t minutes = timegm(&date);
    return minutes * kSecond + std::llround(seconds * kSecond);
  }
  const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), seconds);
  if (error != std::errc() || !std::isfinite(seconds)) return std::nullopt;
  return std::llround(seconds * kSecond);
}

// The times of a file with a line per frame; none if it is missing or damaged.
std::vector<Nanoseconds> times_in(const fs::path& file) {
  std::vector<Nanoseconds> times;
  for (const std::string& line : lines_of(file)) {
    const std::optional<Nanoseconds> time = parse_time(line);
    if (!time) return {};
    times.push_back(*time);
  }
  return times;
}

// The images whose number has a line in the file of times.
Source with_times(Recording& recording, const std::vector<fs::path>& images,
                  const std::vector<Nanoseconds>& times) {
  Source source;
  for (const fs::path& image : images) {
    const std::optional<std::int64_t> number = frame_number(image);
    if (!number || *number >= static_cast<std::int64_t>(times.size())) {
      recording.remarks.push_back(image.string() +
                                  " is left out: the file of times has no line for it.");
      continue;
    }
    source.images.push_back(image);
    source.times.push_back(times[static_cast<std::size_t>(*number)] - times.front());
  }
  return source;
}

// The images of a camera of KITTI raw, with or without the folder data.
std::vector<fs::path> images_of_camera(const fs::path& folder) {
  std::vector<fs::path> images = files::images_in(folder / "data");
  return images.empty() ? files::images_in(folder) : images;
}

struct Cameras {
  const char *left, *right, *choice;
};

// The cameras of which both have images; color first.
std::optional<Cameras> cameras_in(const fs::path& folder, const std::array<Cameras, 2>& known) {
  for (const Cameras& cameras : known) {
    if (!images_of_camera(folder / cameras.left).empty() &&
        !images_of_camera(folder / cameras.right).empty()) {
      return cameras;
    }
  }
  return std::nullopt;
}

// Sets images by a file of times for both views, or by the rate of KITTI.
void set_kitti_images(Recording& recording, const fs::path& left, const fs::path& right,
                      const fs::path& left_times, const fs::path& right_times) {
  const std::vector<fs::path> left_images = images_of_camera(left);
  const std::vector<fs::path> right_images = images_of_camera(right);
  const std::vector<Nanoseconds> times = times_in(left_times);
  const std::vector<Nanoseconds> other = left_times == right_times ? times : times_in(right_times);
  if (times.empty() || other.empty()) {
    recording.remarks.push_back(left_times.string() +
                                " is missing or damaged: 10 images per second are assumed.");
    set_images(recording, left_images, right_images, kKittiRate);
    return;
  }
  const Nanoseconds shift = other.front() - times.front();
  Source right_source = with_times(recording, right_images, other);
  for (Nanoseconds& time : right_source.times) time += shift;
  const Source left_source = with_times(recording, left_images, times);
  set_timed_images(recording, left_source, right_source);
}

// The names of images by their times, from data.csv.
Source euroc_source(Recording& recording, const fs::path& camera) {
  Source source;
  std::size_t missing = 0;
  for (const std::string& line : lines_of(camera / "data.csv")) {
    if (line.starts_with('#')) continue;
    const std::size_t comma = line.find(',');
    Nanoseconds time = 0;
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), time);
    if (error != std::errc() || comma == std::string::npos) {
      throw UserError((camera / "data.csv").string() + ": the line '" + line +
                      "' is not 'TIME,NAME'");
    }
    const std::size_t begin = line.find_first_not_of(" \t", comma + 1);
    const fs::path image = camera / "data" / (begin == std::string::npos ? "" : line.substr(begin));
    if (!fs::is_regular_file(image)) {
      ++missing;
      continue;
    }
    source.images.push_back(image);
    source.times.push_back(time);
  }
  if (missing > 0) {
    recording.remarks.push_back((camera / "data.csv").string() + " names " +
                                std::to_string(missing) + " images that do not exist.");
  }
  return source;
}

void start_at_zero(Source& left, Source& right) {
  const Nanoseconds first = std::min(left.times.front(), right.times.front());
  for (Source* source : {&left, &right}) {
    for (Nanoseconds& time : source->times) time -= first;
  }
}

bool has_entry(const fs::path& file, const std::string& key) {
  const std::vector<std::string> lines = lines_of(file);
  return std::any_of(lines.begin(), lines.end(),
                     [&key](const std::string& line) { return line.starts_with(key + "="); });
}

std::optional<int> entry_of(const fs::path& file, const std::string& key) {
  for (const std::string& line : lines_of(file)) {
    if (!line.starts_with(key + "=")) continue;
    int value = 0;
    const char* begin = line.data() + key.size() + 1;
    const auto [stop, error] = std::from_chars(begin, line.data() + line.size(), value);
    if (error == std::errc() && value > 0) return value;
  }
  return std::nullopt;
}

struct PairNames {
  const char *left, *right;
};

// The names of the two views of a folder of Middlebury: since 2014, of 2005 and 2006, and of 2001
// and 2003, where more views are beside them.
std::optional<PairNames> pair_names_in(const fs::path& folder, bool calibrated) {
  constexpr PairNames kNewest = {"im0.png", "im1.png"};
  struct OlderNames {
    PairNames views;
    const char *between, *truth;
  };
  constexpr std::array<OlderNames, 3> kOlder{
      {{{"view1.png", "view5.png"}, "view2.png", "disp1.png"},
       {{"im2.png", "im6.png"}, "im3.png", "disp2.png"},
       {{"im2.ppm", "im6.ppm"}, "im3.ppm", "disp2.pgm"}}};
  for (const auto& [views, between, truth] : kOlder) {
    // A sequence has such names, too, but no ground truth.
    const bool sequence = is_there(folder / between) && !is_there(folder / truth);
    if (!sequence && is_there(folder / views.left) && is_there(folder / views.right)) return views;
  }
  const bool left = is_there(folder / kNewest.left), right = is_there(folder / kNewest.right);
  // Without the calibration, they may be two of many images.
  const bool many = is_there(folder / "im2.png");
  return (calibrated ? left || right : left && right && !many) ? std::optional(kNewest)
                                                               : std::nullopt;
}

}  // namespace

std::string folder_name(const fs::path& folder) {
  std::error_code error;
  fs::path whole = fs::absolute(folder, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  const std::string name = whole.filename().string();
  return name.empty() || name == "/" ? "recording" : name;
}

std::optional<FoundRecording> find_kitti_odometry(const fs::path& folder) {
  constexpr std::array<Cameras, 2> kKnown{
      {{"image_2", "image_3", ""}, {"image_0", "image_1", "#gray"}}};
  const fs::path calibration = folder / "calib.txt", times = folder / "times.txt";
  const std::optional<Cameras> cameras = cameras_in(folder, kKnown);
  if (!cameras || (!is_there(calibration) && !is_there(times))) return std::nullopt;
  FoundRecording found;
  Recording& recording = found.recording;
  recording.name = folder_name(folder);
  recording.kind = "KITTI odometry sequence";
  set_kitti_images(recording, folder / cameras->left, folder / cameras->right, times, times);
  if (is_there(calibration)) found.calibrations.push_back(calibration.string() + cameras->choice);
  found.used_folders = files::folders_in(folder);
  return found;
}

std::optional<FoundRecording> find_kitti_raw(const fs::path& folder) {
  constexpr std::array<Cameras, 2> kKnown{
      {{"image_02", "image_03", "#color"}, {"image_00", "image_01", "#gray"}}};
  const std::optional<Cameras> cameras = cameras_in(folder, kKnown);
  if (!cameras) return std::nullopt;
  const fs::path left = folder / cameras->left, right = folder / cameras->right;
  const fs::path own = folder / "calib_cam_to_cam.txt";
  const fs::path of_day = fs::absolute(folder).lexically_normal() / ".." / "calib_cam_to_cam.txt";
  const fs::path calibration = is_there(own) ? own : of_day.lexically_normal();
  if (!is_there(calibration) && !is_there(left / "timestamps.txt")) return std::nullopt;
  FoundRecording found;
  Recording& recording = found.recording;
  recording.name = folder_name(folder);
  recording.kind = "KITTI raw drive";
  // The frames of a synchronized drive with the same number belong together, whatever the time
  // stamps of the cameras.
  const bool synchronized = !recording.name.ends_with("_extract");
  set_kitti_images(recording, left, right, left / "timestamps.txt",
                   (synchronized ? left : right) / "timestamps.txt");
  if (is_there(calibration)) found.calibrations.push_back(calibration.string() + cameras->choice);
  found.used_folders = files::folders_in(folder);
  return found;
}

std::optional<FoundRecording> find_euroc(const fs::path& folder) {
  const fs::path base = is_there(folder / "mav0") ? folder / "mav0" : folder;
  const fs::path left = base / "cam0", right = base / "cam1";
  if (!is_there(left / "data.csv") || !is_there(right / "data.csv")) return std::nullopt;
  FoundRecording found;
  Recording& recording = found.recording;
  const bool is_inner = folder_name(folder) == "mav0";
  recording.name = folder_name(is_inner ? fs::absolute(folder).parent_path() : folder);
  recording.kind = "EuRoC (ASL) sequence";
  Source left_source = euroc_source(recording, left), right_source = euroc_source(recording, right);
  if (left_source.empty() || right_source.empty()) {
    throw UserError((left_source.empty() ? left : right).string() +
                    ": data.csv names no image that exists in data");
  }
  start_at_zero(left_source, right_source);
  set_timed_images(recording, left_source, right_source);
  const fs::path chain = base / ".." / "dso" / "camchain.yaml";  // of TUM-VI
  if (is_there(left / "sensor.yaml") && is_there(right / "sensor.yaml")) {
    found.calibrations.push_back((left / "sensor.yaml").string() + "," +
                                 (right / "sensor.yaml").string());
  } else if (is_there(chain)) {
    found.calibrations.push_back(chain.lexically_normal().string());
  }
  found.used_folders = files::folders_in(folder);
  return found;
}

std::optional<FoundRecording> find_pair_folder(const fs::path& folder) {
  const fs::path calibration = folder / "calib.txt";
  const std::optional<PairNames> names = pair_names_in(folder, is_there(calibration));
  if (!names) return std::nullopt;
  const fs::path left = folder / names->left, right = folder / names->right;
  FoundRecording found;
  Recording& recording = found.recording;
  recording.name = folder_name(folder);
  for (const fs::path& image : {left, right}) {
    if (!is_there(image)) throw UserError(image.string() + ": no such file");
    const std::string problem = image_problem(image);
    if (!problem.empty()) throw UserError(image.string() + ": the image " + problem);
  }
  recording.left.images = {left};
  recording.right.images = {right};
  recording.frame_rate = 1;
  recording.max_disparity = entry_of(calibration, "ndisp");
  const std::optional<int> width = entry_of(calibration, "width");
  const std::string& name = recording.name;
  const bool is_eth3d =
      name.size() > 3 && name[name.size() - 3] == '_' && (name.back() == 'l' || name.back() == 's');
  recording.kind = is_eth3d ? "ETH3D pair" : "Middlebury pair";
  // ETH3D states the width of the image, which limits nothing.
  if (is_eth3d && (!recording.max_disparity || !width || *recording.max_disparity >= *width)) {
    recording.max_disparity = kEth3dRange;
  }
  // Older sets have a calib.txt without cameras, for the range of disparities.
  if (has_entry(calibration, "cam0")) found.calibrations.push_back(calibration.string());
  found.used_folders = files::folders_in(folder);
  return found;
}

}  // namespace mtstereo::run
