// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/sources.hpp"

#include <glib.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/files/unread_kinds.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/calibration_search.hpp"
#include "recordings/inputs/image_lists.hpp"
#include "recordings/inputs/own_names.hpp"
#include "recordings/inputs/view_names.hpp"
#include "recordings/matching/product_files.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

// The folder in which the calibration of a source is.
fs::path folder_of(const Source& source) {
  const fs::path folder = file_of(source).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

std::string name_of_one(const Source& source) {
  return source.video.empty() ? folder_name(folder_of(source)) : source.video.stem().string();
}

// The folders of both views, those in which these have the same path, such as left and right of
// left/data and right/data, and the one that has them.
std::vector<fs::path> folders_beside(const Source& left, const Source& right) {
  fs::path a = folder_of(left).lexically_normal(), b = folder_of(right).lexically_normal();
  std::vector<fs::path> beside{folder_of(left)};
  if (a == b) return beside;
  beside.push_back(folder_of(right));
  while (a.has_parent_path() && b.has_parent_path() && a.filename() == b.filename()) {
    a = a.parent_path();
    b = b.parent_path();
    beside.insert(beside.end(), {a, b});
  }
  const fs::path both = (a / "..").lexically_normal();
  if (both == (b / "..").lexically_normal()) beside.push_back(both);
  return beside;
}

// What the names of the views have in common, or the folder that has both.
std::string name_of_two(const Source& left, const Source& right) {
  const fs::path folder = folder_of(left);
  if (folder != folder_of(right)) return folder_name(folder / "..");
  if (left.video.empty()) return folder_name(folder);
  for (const Partner& partner : partners_of(left.video.filename().string())) {
    if (partner.right == right.video.filename().string()) {
      return name_without_extension(partner.common, folder);
    }
  }
  return left.video.stem().string();
}

// Whether both views have the same files, also by links.
bool are_same(const Source& left, const Source& right) {
  const std::vector<fs::path>&a = left.images, &b = right.images;
  std::error_code error;
  if (a.size() != b.size() || !fs::equivalent(file_of(left), file_of(right), error)) return false;
  return a.empty() || fs::equivalent(a.back(), b.back(), error);
}

// Fails for an input that is not there.
[[noreturn]] void fail_as_missing(const std::string& input, const std::string& what) {
  if (input.empty()) {
    throw UserError(
        "an input has an empty name, such as that of a variable that is not set: give files or "
        "folders");
  }
  const auto is_input = [](const std::string& text) {
    std::error_code error;
    return files::is_pattern(text) || fs::exists(text, error);
  };
  for (std::size_t at = input.find(','); at != std::string::npos; at = input.find(',', at + 1)) {
    const std::string left = input.substr(0, at), right = input.substr(at + 1);
    if (!is_input(left) || !is_input(right)) continue;
    throw UserError(input + ": " + what + "; separate the two views by a space: " + left + " " +
                    right);
  }
  throw UserError(input + ": " + what);
}

// Why there is no file or folder with this name.
std::string reason_of_absence(const std::string& input) {
  std::error_code error;
  if (!fs::exists(input, error) && error) return error.message();
  if (!fs::is_symlink(fs::symlink_status(input, error))) return "no such file or folder";
  return "is a link to " + fs::read_symlink(input, error).string() + ", which does not exist";
}

[[noreturn]] void fail_as_address(const std::string& input) {
  g_autofree gchar* path = g_filename_from_uri(input.c_str(), nullptr, nullptr);
  if (path != nullptr) {
    throw UserError(input + ": is the address of a file: give its path, " + path);
  }
  throw UserError(
      input +
      ": is a stream, which may never end: record it into a file (ffmpeg -i URL -c copy "
      "view.mkv), or match it live (from-network.sh)");
}

[[noreturn]] void fail_without_views(const fs::path& folder) {
  std::string what = files::first_unread(files::files_in(folder));
  if (!what.empty()) throw UserError(what);
  what = folder.string() + ": the folder has neither images nor one video";
  if (!files::folders_in(folder).empty()) {
    const fs::path whole = folder.has_filename() ? folder : folder.parent_path();
    what += "; if the folders in it have them, give the folder that has both views, " +
            (whole.has_parent_path() ? whole.parent_path().string() : ".") +
            ", or two folders with images";
  }
  throw UserError(what);
}

}  // namespace

std::vector<fs::path> images_of_folder(const fs::path& folder) {
  std::vector<fs::path> images = files::images_in(folder);
  for (const char* name : {"data", "images"}) {
    // One image may be that of the vignette.
    if (images.size() > 1) break;
    std::vector<fs::path> inner = files::images_in(folder / name);
    if (inner.size() > images.size()) images = std::move(inner);
  }
  return images;
}

const fs::path& file_of(const Source& source) {
  return source.video.empty() ? source.images.front() : source.video;
}

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

bool is_result(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / kRunFile, error) || fs::exists(folder / kPlanFile, error);
}

std::string name_without_extension(const std::string& name, const fs::path& folder) {
  const std::string stem = name.starts_with('.') ? "" : fs::path(name).stem().string();
  return stem.empty() ? folder_name(folder) : stem;
}

Source source_of(const std::string& input) {
  std::error_code error;
  Source source;
  if (input.find("://") != std::string::npos && !fs::exists(input, error)) fail_as_address(input);
  if (files::is_pattern(input)) {
    source.images = files::files_of_pattern(input);
    if (source.images.empty()) fail_as_missing(input, "no file has such a name");
    files::refuse_unread(source.images.front());
  } else if (fs::is_directory(input, error)) {
    source.images = images_of_folder(input);
    const std::vector<fs::path> videos = videos_in(input);
    if (source.images.empty() && videos.size() == 1) source.video = videos.front();
    if (source.empty()) fail_without_views(input);
  } else if (!fs::exists(input, error)) {
    fail_as_missing(input, reason_of_absence(input));
  } else if (!fs::is_regular_file(input, error)) {
    throw UserError(input + ": is a pipe or a device, which may never end: record it into a file");
  } else {
    files::refuse_unread(input);
    (files::is_image(input) ? source.images.emplace_back() : source.video) = input;
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
  found.calibrations = calibrations_in(folders_beside(left, two ? right : left));
  return found;
}

}  // namespace mtstereo::run
