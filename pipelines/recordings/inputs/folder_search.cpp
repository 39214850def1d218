// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/folder_search.hpp"

#include <algorithm>
#include <iterator>
#include <regex>
#include <string>
#include <system_error>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/files/unread_kinds.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/calibration_search.hpp"
#include "recordings/inputs/completion.hpp"
#include "recordings/inputs/data_sets.hpp"
#include "recordings/inputs/image_sizes.hpp"
#include "recordings/inputs/nested_views.hpp"
#include "recordings/inputs/sources.hpp"
#include "recordings/inputs/view_names.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

constexpr const char* kNoVideo = "the video of the other view is missing: give both videos";
constexpr const char* kNoFolder = "the folder of the other view is missing: give both folders";

// What the names of the images share, or that of the only left one.
std::string name_of_images(const ViewImages& views, const fs::path& folder) {
  const std::string only = name_without_view(views.left.front().filename().string(), false);
  std::string name = name_without_extension(views.left.size() == 1 ? only : views.common, folder);
  while (name.size() > 1 && (name.back() == '_' || name.back() == '-')) name.pop_back();
  return name == "_" || name == "-" ? folder_name(folder) : name;
}

// Whether a name is that of other data than a view, such as its depths.
bool is_other_data(const std::string& name) {
  static const std::regex words(
      "(^|[^a-z])([Dd]epth|[Dd]isp|[Dd]isparity|[Oo]cclusions?|[Gg]round_?[Tt]ruth|boundaries|flow|"
      "maps?|mask|normals?|seg)([^a-z]|$)|Flow$|Segmentation$");
  return std::regex_search(name, words);
}

bool is_other_folder(const fs::path& folder) { return is_other_data(folder.filename().string()); }

// Whether a folder of a view has nothing but its other data, such as left/disparity beside
// left/rgb.
bool is_only_other_data(const fs::path& folder) {
  static const std::regex whole(
      "(depth|disp|disparity|flow|mask|normal|occlusion|seg)(s|_?maps?)?");
  return std::regex_match(files::lower_stem(folder), whole);
}

// Moves what belongs to the views, such as their depths, to the rest of the images.
void leave_other_data(std::vector<ViewImages>& all_views, std::vector<fs::path>& rest) {
  const auto others =
      std::stable_partition(all_views.begin(), all_views.end(),
                            [](const ViewImages& views) { return !is_other_data(views.common); });
  if (others == all_views.begin()) return;
  for (auto views = others; views != all_views.end(); ++views) {
    rest.insert(rest.end(), views->left.begin(), views->left.end());
    rest.insert(rest.end(), views->right.begin(), views->right.end());
  }
  all_views.erase(others, all_views.end());
}

class FolderSearch {
 public:
  FolderSearch(fs::path folder, const fs::path& named, const InputOptions& options, bool asked)
      : folder_(std::move(folder)), options_(options), asked_(asked) {
    const fs::path below = folder_.lexically_relative(named).lexically_normal();
    if (below != ".") levels_ = static_cast<int>(std::distance(below.begin(), below.end()));
  }

  FolderContents run() {
    if (!add_data_sets()) {
      add_videos();
      add_folders();
      add_images();
    }
    note_unread_recordings();
    return std::move(contents_);
  }

 private:
  using Find = std::optional<FoundRecording> (*)(const fs::path&);

  bool add_data_sets() {
    for (auto* find : {find_pair_folder, find_euroc, find_kitti_odometry, find_kitti_raw}) {
      if (add_data_set(find)) return true;
    }
    return false;
  }

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
    // The name of a folder below that of the user becomes a part of the whole name.
    const bool is_of_folder = levels_ > 0 && name == folder_name(folder_);
    for (const ImagesOfSize& part : by_size(left, right)) {
      const std::string sized = is_of_folder ? part.size : name + "-" + part.size;
      add_part(part.left, part.right, part.size.empty() ? name : sized, problem_of);
    }
  }

  void add_part(const Source& left, const Source& right, const std::string& name,
                const std::string& problem_of) {
    try {
      FoundRecording found = recording_of(left, right, options_);
      found.calibrations_above = calibrations_above_views(
          file_of(left).parent_path(), file_of(right.empty() ? left : right).parent_path());
      found.recording.name = name;
      contents_.recordings.push_back(completed(std::move(found), options_));
    } catch (const UserError& error) {
      if (!problem_of.empty()) contents_.problems.push_back({problem_of, error.what()});
    }
  }

  // A folder may have thousands of recordings: what was found for the last one is kept.
  const std::vector<CalibrationLevel>& calibrations_above_views(const fs::path& left,
                                                                const fs::path& right) {
    if (left != last_left_ || right != last_right_) {
      calibrations_ = calibrations_above(left, right, folder_, levels_);
      last_left_ = left;
      last_right_ = right;
    }
    return calibrations_;
  }

  void add_videos() {
    std::vector<fs::path> videos = videos_in(folder_);
    for (const PathPair& pair : take_pairs(videos)) {
      add({pair.left, {}, {}}, {pair.right, {}, {}}, name_without_extension(pair.common, folder_),
          pair.left.string());
    }
    for (const fs::path& video : videos) {
      if (is_view_name(video.filename().string())) {
        contents_.problems.push_back({video.string(), kNoVideo});
      } else {
        add({video, {}, {}}, {}, video.stem().string(), video.string());
      }
    }
  }

  void add_folders() {
    std::vector<fs::path> folders = files::folders_in(folder_);
    erase_results(folders, folder_);
    const auto rest = std::stable_partition(folders.begin(), folders.end(), [](const auto& folder) {
      return !images_of_folder(folder).empty() || videos_in(folder).size() == 1;
    });
    const std::vector<fs::path> outer(rest, folders.end());
    add_nested(outer);
    folders.erase(rest, folders.end());
    const std::vector<PathPair> pairs = take_views_of_folders(folders);
    leave_other_folders(outer, !pairs.empty() && !is_other_folder(pairs.front().left));
    for (const PathPair& pair : pairs) {
      contents_.used_folders.insert(contents_.used_folders.end(), {pair.left, pair.right});
      const bool only = pairs.size() == 1 || pair.common.empty();
      add(source_of(pair.left.string()), source_of(pair.right.string()),
          only ? folder_name(folder_) : pair.common, pair.left.string());
    }
    for (const fs::path& folder : folders) {
      if (!is_view_name(folder.filename().string())) continue;
      contents_.used_folders.push_back(folder);
      contents_.problems.push_back({folder.string(), kNoFolder});
    }
  }

  // The pairs of folders, without those of what belongs to views beside them, such as their depths.
  std::vector<PathPair> take_views_of_folders(std::vector<fs::path>& folders) {
    const std::vector<fs::path> all = folders;
    std::vector<PathPair> pairs = take_pairs(folders);
    const auto others = std::stable_partition(pairs.begin(), pairs.end(), [](const PathPair& pair) {
      return !is_other_folder(pair.left);
    });
    if (others == pairs.begin()) return pairs;
    pairs.erase(others, pairs.end());
    std::erase_if(folders, is_other_folder);
    std::copy_if(all.begin(), all.end(), std::back_inserter(contents_.used_folders),
                 is_other_folder);
    return pairs;
  }

  // Those of other data beside views, or with the same folders as those of the views, such as
  // depth/Camera_0 and rgb/Camera_0.
  void leave_other_folders(const std::vector<fs::path>& folders, bool beside_views) {
    for (const fs::path& folder : folders) {
      if (!is_other_folder(folder)) continue;
      const std::vector<fs::path> inner = files::folders_in(folder);
      const auto has_same = [&inner](const fs::path& views) {
        return !inner.empty() && !is_other_folder(views) &&
               files::is_folder(views / inner.front().filename());
      };
      if (beside_views || std::any_of(folders.begin(), folders.end(), has_same)) {
        contents_.used_folders.push_back(folder);
      }
    }
  }

  // Folders of views that have a folder for each scene, such as left/alley and right/alley.
  void add_nested(std::vector<fs::path> folders) {
    const std::vector<PathPair> views = take_views_of_folders(folders);
    for (const PathPair& view : views) {
      NestedViews scenes = nested_views(view.left, view.right);
      std::erase_if(scenes.lonely, is_only_other_data);
      const auto is_other = [](const PathPair& scene) { return is_only_other_data(scene.left); };
      if (!std::all_of(scenes.pairs.begin(), scenes.pairs.end(), is_other)) {
        std::erase_if(scenes.pairs, is_other);
      }
      if (scenes.pairs.empty()) {
        note_unread_photos(view.left);
        continue;
      }
      contents_.used_folders.insert(contents_.used_folders.end(), {view.left, view.right});
      const std::string prefix = views.size() == 1 || view.common.empty() ? "" : view.common + "-";
      for (const PathPair& scene : scenes.pairs) {
        std::string name = prefix + scene.common;
        std::replace(name.begin(), name.end(), '/', '-');
        add(source_of(scene.left.string()), source_of(scene.right.string()), name,
            scene.left.string());
      }
      for (const fs::path& scene : scenes.lonely) {
        std::error_code error;
        contents_.problems.push_back(
            {scene.string(), fs::is_directory(scene, error) ? kNoFolder : kNoVideo});
      }
    }
  }

  // Images of both views in one folder, or images with both views.
  void add_images() {
    std::vector<fs::path> rest = files::images_in(folder_);
    std::vector<ViewImages> all_views = take_views(rest);
    leave_other_data(all_views, rest);
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

  void note_unread_photos(const fs::path& view) {
    const std::vector<fs::path> files = files::files_in(view);
    if (files.empty() || !files::is_unread_photo(files.front())) return;
    contents_.problems.push_back({files.front().string(), files::unread_kind(files.front())});
  }

  void note_unread_recordings() {
    const std::vector<fs::path> files = files::unread_recordings(files::files_in(folder_));
    if (files.empty()) return;
    std::string reason = files::unread_kind(files.front());
    if (files.size() > 1) {
      reason += " (" + std::to_string(files.size()) + " such files are in this folder)";
    }
    contents_.unread = {files.front().string(), reason};
  }

  fs::path folder_;
  const InputOptions& options_;
  bool asked_;
  int levels_ = 0;  // below the folder that the user gave
  fs::path last_left_, last_right_;
  std::vector<CalibrationLevel> calibrations_;  // around these folders
  FolderContents contents_;
};

}  // namespace

FolderContents search_folder(const fs::path& folder, const fs::path& named,
                             const InputOptions& options, bool asked) {
  return FolderSearch(folder, named, options, asked).run();
}

}  // namespace mtstereo::run
