// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/search.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/user_error.hpp"
#include "mtstereo/geometry/calibration.hpp"
#include "recordings/inputs/calibration_choice.hpp"
#include "recordings/inputs/halves.hpp"
#include "recordings/inputs/image_lists.hpp"
#include "recordings/inputs/own_names.hpp"
#include "recordings/inputs/view_names.hpp"
#include "recordings/matching/product_files.hpp"
#include "recordings/media/sample_frames.hpp"
#include "recordings/media/video_scan.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

// The images of a folder, or of the folder data in it.
std::vector<fs::path> images_of_folder(const fs::path& folder) {
  std::vector<fs::path> images = files::images_in(folder);
  return images.empty() ? files::images_in(folder / "data") : images;
}

const fs::path& file_of(const Source& source) {
  return source.video.empty() ? source.images.front() : source.video;
}

// The folder in which the calibration of a source is.
fs::path folder_of(const Source& source) {
  const fs::path folder = file_of(source).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

// Removes the results of earlier runs from what is in a folder.
void erase_results(std::vector<fs::path>& paths, const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kRunFile, error)) return;
  const std::vector<std::string> results = product_paths();
  std::erase_if(paths, [&results](const fs::path& path) {
    return std::find(results.begin(), results.end(), path.filename()) != results.end();
  });
}

std::vector<fs::path> videos_in(const fs::path& folder) {
  std::vector<fs::path> files = files::files_in(folder);
  std::erase_if(files, [](const fs::path& file) { return !files::is_video(file); });
  erase_results(files, folder);
  return files;
}

// The name without its extension, or that of the folder if nothing is left of it.
std::string name_of(const std::string& common, const fs::path& folder) {
  const std::string stem = common.starts_with('.') ? "" : fs::path(common).stem().string();
  return stem.empty() ? folder_name(folder) : stem;
}

std::string name_of_one(const Source& source) {
  return source.video.empty() ? folder_name(folder_of(source)) : source.video.stem().string();
}

// What the names of the views have in common, or the folder that has both.
std::string name_of_two(const Source& left, const Source& right) {
  const fs::path folder = folder_of(left);
  if (folder != folder_of(right)) return folder_name(folder / "..");
  if (left.video.empty()) return folder_name(folder);
  for (const Partner& partner : partners_of(left.video.filename().string())) {
    if (partner.right == right.video.filename().string()) return name_of(partner.common, folder);
  }
  return left.video.stem().string();
}

// What the names of the images share, or that of the only left one.
std::string name_of_images(const ViewImages& views, const fs::path& folder) {
  const std::string only = name_without_view(views.left.front().filename().string(), false);
  std::string name = name_of(views.left.size() == 1 ? only : views.common, folder);
  while (name.size() > 1 && (name.back() == '_' || name.back() == '-')) name.pop_back();
  return name == "_" || name == "-" ? folder_name(folder) : name;
}

// Whether both views have the same files, also by links.
bool are_same(const Source& left, const Source& right) {
  const std::vector<fs::path>&a = left.images, &b = right.images;
  std::error_code error;
  if (a.size() != b.size() || !fs::equivalent(file_of(left), file_of(right), error)) return false;
  return a.empty() || fs::equivalent(a.back(), b.back(), error);
}

class FolderSearch {
 public:
  FolderSearch(fs::path folder, const InputOptions& options, bool asked)
      : folder_(std::move(folder)), options_(options), asked_(asked) {}

  FolderContents run() {
    for (auto* find : {find_pair_folder, find_euroc, find_kitti_odometry, find_kitti_raw}) {
      if (add_data_set(find)) return std::move(contents_);
    }
    add_videos();
    add_folders();
    add_images();
    return std::move(contents_);
  }

 private:
  using Find = std::optional<FoundRecording> (*)(const fs::path&);

  bool add_data_set(Find find) {
    try {
      const std::optional<FoundRecording> found = find(folder_);
      if (!found) return false;
      contents_.used_folders = found->used_folders;
      contents_.recordings.push_back(completed(*found, options_));
    } catch (const UserError& error) {
      contents_.problems.push_back({folder_.string(), error.what()});
      contents_.used_folders = files::folders_in(folder_);
    }
    return true;
  }

  // `problem_of`: the input of a problem; empty if there is no problem.
  void add(const Source& left, const Source& right, const std::string& name,
           const std::string& problem_of) {
    try {
      FoundRecording found = recording_of(left, right, options_);
      found.recording.name = name;
      contents_.recordings.push_back(completed(std::move(found), options_));
    } catch (const UserError& error) {
      if (!problem_of.empty()) contents_.problems.push_back({problem_of, error.what()});
    }
  }

  void add_videos() {
    std::vector<fs::path> videos = videos_in(folder_);
    for (const PathPair& pair : take_pairs(videos)) {
      add({pair.left, {}, {}}, {pair.right, {}, {}}, name_of(pair.common, folder_),
          pair.left.string());
    }
    for (const fs::path& video : videos) {
      if (is_view_name(video.filename().string())) {
        contents_.problems.push_back(
            {video.string(), "the video of the other view is missing: give both videos"});
      } else {
        add({video, {}, {}}, {}, video.stem().string(), video.string());
      }
    }
  }

  void add_folders() {
    std::vector<fs::path> folders = files::folders_in(folder_);
    erase_results(folders, folder_);
    std::erase_if(folders, [](const fs::path& folder) {
      return images_of_folder(folder).empty() && videos_in(folder).size() != 1;
    });
    const std::vector<PathPair> pairs = take_pairs(folders);
    for (const PathPair& pair : pairs) {
      contents_.used_folders.insert(contents_.used_folders.end(), {pair.left, pair.right});
      const bool only = pairs.size() == 1 || pair.common.empty();
      add(source_of(pair.left.string()), source_of(pair.right.string()),
          only ? folder_name(folder_) : pair.common, pair.left.string());
    }
    for (const fs::path& folder : folders) {
      if (!is_view_name(folder.filename().string())) continue;
      contents_.used_folders.push_back(folder);
      contents_.problems.push_back(
          {folder.string(), "the folder of the other view is missing: give both folders"});
    }
  }

  // Images of both views in one folder, or images with both views.
  void add_images() {
    std::vector<fs::path> rest = files::images_in(folder_);
    const std::vector<ViewImages> all_views = take_views(rest);
    const std::size_t before = contents_.recordings.size();
    for (const ViewImages& views : all_views) {
      const bool only = all_views.size() == 1;
      add({{}, views.left, {}}, {{}, views.right, {}},
          only ? folder_name(folder_) : name_of_images(views, folder_), folder_.string());
    }
    if (contents_.recordings.size() > before && !rest.empty()) {
      contents_.recordings[before].remarks.push_back(
          "Images that have no partner are not used: " + std::to_string(rest.size()) +
          ", such as " + rest.front().string() + ".");
    } else if (!rest.empty() && contents_.recordings.empty() && contents_.problems.empty()) {
      add({{}, rest, {}}, {}, folder_name(folder_), asked_ ? folder_.string() : "");
    }
  }

  fs::path folder_;
  const InputOptions& options_;
  bool asked_;
  FolderContents contents_;
};

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height) + " px";
}

std::string percent(double fraction) { return std::to_string(std::lround(fraction * 100)) + " %"; }

const char* name_of(Arrangement arrangement) {
  return arrangement == Arrangement::kSideBySide ? "side by side" : "one above the other";
}

// How a user gives the other view of a source that has one.
std::string advice_for(const Source& source) {
  if (source.images.size() > 1) return "give the views as two images, folders or patterns";
  if (source.video.empty()) return "give the other view too";
  VideoScan scan(source.video, Reading::kGray);
  scan.next();
  if (scan.video_streams() < 2) return "give the other view too";
  return "it has " + std::to_string(scan.video_streams()) +
         " video streams, of which the first one is read: write them to two files (ffmpeg -i FILE "
         "-map 0:v:0 -c copy left.mkv -map 0:v:1 -c copy right.mkv)";
}

// The arrangement that the shape of a frame suggests.
Arrangement guess_arrangement(const Recording& recording, cv::Size size) {
  const std::optional<Arrangement> shape = arrangement_by_shape(size.width, size.height);
  const bool odd =
      shape && (*shape == Arrangement::kSideBySide ? size.width : size.height) % 2 != 0;
  if (shape && !odd) return *shape;
  throw UserError(file_of(recording.left).string() + ": " + size_text(size) +
                  " is the shape of one view: " + advice_for(recording.left) +
                  ", or state the arrangement (--layout)");
}

// The calibration that rectifies the halves, if one does.
std::optional<StereoCalibration> rectifying_calibration(const Recording& recording, cv::Size half) {
  if (recording.rectified || recording.calibration.empty()) return std::nullopt;
  const auto read = read_calibration(recording.calibration, half.width, half.height);
  if (!read) throw UserError(read.error().message);
  return *read;
}

// Checks that the halves match, and finds which one is the left view unless the user states it.
void confirm_arrangement(Recording& recording, cv::Size size, cv::Size half, bool swap) {
  constexpr int kSamples = 3;  // frames
  const std::vector<cv::Mat> frames = sample_frames(recording.left, kSamples);
  const std::optional<StereoCalibration> calibration = rectifying_calibration(recording, half);
  HalvesMatch match = match_halves(frames, recording.arrangement, calibration);
  // Views that only match before they are rectified keep their order: the calibration is wrong.
  if (!match.confirmed && calibration) {
    match = match_halves(frames, recording.arrangement, std::nullopt);
    match.swapped = false;
  }
  const std::string text = size_text(size) + ", " + name_of(recording.arrangement) + ": " +
                           percent(std::max(match.forward, match.backward)) +
                           " of the points of one half are in the other one";
  if (!match.confirmed) {
    throw UserError(file_of(recording.left).string() +
                    ": by its shape it may have both views, but its halves do not match (" + text +
                    "): give the other view too, or state the arrangement (--layout)");
  }
  recording.remarks.push_back("Both views are in one frame (" + text + ").");
  if (swap || !match.swapped) return;
  recording.swapped = true;
  recording.remarks.push_back("The first half is the right view: in the other order " +
                              percent(match.backward) + " of the points match instead of " +
                              percent(match.forward) + ". --layout keeps the order.");
}

cv::Size half_size(cv::Size size, Arrangement arrangement, const fs::path& file) {
  const bool beside = arrangement == Arrangement::kSideBySide;
  if ((beside ? size.width : size.height) % 2 != 0) {
    throw UserError(file.string() + ": " + size_text(size) + " cannot be halved: its " +
                    (beside ? "width" : "height") + " is odd");
  }
  return beside ? cv::Size(size.width / 2, size.height) : cv::Size(size.width, size.height / 2);
}

// The size of a view.
cv::Size size_of_two(const Recording& recording) {
  const cv::Size left = first_frame(recording.left).size();
  const cv::Size right = first_frame(recording.right).size();
  if (left == right) return left;
  throw UserError("the views have different sizes: " + file_of(recording.left).string() + " has " +
                  size_text(left) + ", " + file_of(recording.right).string() + " has " +
                  size_text(right) + ": record both in the same mode, or convert one of them");
}

// One source: the calibration is for a half, and decides how the halves match.
void complete_one(FoundRecording& found, const InputOptions& options) {
  Recording& recording = found.recording;
  const cv::Size size = first_frame(recording.left).size();
  recording.arrangement = options.arrangement.value_or(Arrangement::kTwoSources);
  if (!options.arrangement) recording.arrangement = guess_arrangement(recording, size);
  recording.swapped = options.swap;
  const cv::Size half = half_size(size, recording.arrangement, file_of(recording.left));
  choose_calibration(recording, found.calibrations, options, half.width, half.height);
  if (!options.arrangement) confirm_arrangement(recording, size, half, options.swap);
}

}  // namespace

FolderContents search_folder(const fs::path& folder, const InputOptions& options, bool asked) {
  return FolderSearch(folder, options, asked).run();
}

Recording completed(FoundRecording found, const InputOptions& options) {
  Recording& recording = found.recording;
  recording.name = outputs::printable(recording.name);  // it becomes that of a folder
  if (recording.right.empty()) {
    complete_one(found, options);
    return std::move(recording);
  }
  if (options.swap) std::swap(recording.left, recording.right);
  const cv::Size size = size_of_two(recording);
  choose_calibration(recording, found.calibrations, options, size.width, size.height);
  return std::move(recording);
}

Source source_of(const std::string& input) {
  std::error_code error;
  Source source;
  if (files::is_pattern(input)) {
    source.images = files::files_of_pattern(input);
    if (source.images.empty()) throw UserError(input + ": no file has such a name");
  } else if (fs::is_directory(input, error)) {
    source.images = images_of_folder(input);
    const std::vector<fs::path> videos = videos_in(input);
    if (source.images.empty() && videos.size() == 1) source.video = videos.front();
    if (source.empty()) throw UserError(input + ": the folder has neither images nor one video");
  } else if (!fs::exists(input, error)) {
    throw UserError(input + ": no such file or folder");
  } else if (!fs::is_regular_file(input, error)) {
    throw UserError(input + ": is a pipe or a device, which may never end: record it into a file");
  } else if (files::is_image(input)) {
    source.images = {input};
  } else {
    source.video = input;
  }
  return source;
}

FoundRecording recording_of(const Source& left, const Source& right, const InputOptions& options) {
  const bool two = !right.empty();
  if (two && left.video.empty() != right.video.empty()) {
    throw UserError(file_of(left).string() + " and " + file_of(right).string() +
                    ": one is a video and the other one is not");
  }
  const bool one_arrangement =
      options.arrangement && *options.arrangement == Arrangement::kTwoSources;
  if (two ? options.arrangement && !one_arrangement : one_arrangement) {
    throw UserError(file_of(left).string() + ": the arrangement that is stated needs " +
                    (two ? "one source, not two" : "two sources"));
  }
  if (two && are_same(left, right)) {
    throw UserError(file_of(left).string() + " and " + file_of(right).string() +
                    " are the same file: give the left view and the right one");
  }
  FoundRecording found;
  Recording& recording = found.recording;
  const bool images = left.video.empty();
  recording.kind = two ? (images ? "two lists of images" : "two video files")
                       : (images ? "images with both views" : "video file with both views");
  if (images) {
    set_images(recording, left.images, right.images, options.frame_rate);
  } else {
    recording.left = left;
    recording.right = right;
  }
  recording.name = two ? name_of_two(left, right) : name_of_one(left);
  const fs::path folder = folder_of(left);
  std::vector<fs::path> beside{folder};
  if (two && folder_of(right) != folder) {
    beside.push_back(folder_of(right));
    // The folder that has those of both views.
    const fs::path both = (folder / "..").lexically_normal();
    if (both == (folder_of(right) / "..").lexically_normal()) beside.push_back(both);
  }
  found.calibrations = calibrations_in(beside);
  return found;
}

}  // namespace mtstereo::run
