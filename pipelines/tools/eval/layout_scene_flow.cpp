// SPDX-License-Identifier: LGPL-2.1-or-later

// Scene Flow (Driving, Monkaa, FlyingThings3D): frames_cleanpass/.../left/*.png, .../right/*.png
// and disparity/.../left/*.pfm, with the same folders in between. The final pass is used where
// there is no clean one.

#include <algorithm>
#include <set>
#include <sstream>
#include <string>

#include "lib/files/file_names.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/layouts.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

bool is_frames_folder(const fs::path& folder) {
  const std::string name = folder.filename().string();
  if (name == "frames_cleanpass" || name == "image_clean") return true;
  const fs::path above = folder.parent_path();
  return (name == "frames_finalpass" && !files::is_folder(above / "frames_cleanpass")) ||
         (name == "image_final" && !files::is_folder(above / "image_clean"));
}

// The frames that the authors of FlyingThings3D withdrew: lines such as "TEST/A/0005/left/0006.png"
// or "TEST/A/0005/0006" in the list that is part of the data set.
std::set<std::string> unused_frames(const fs::path& root) {
  std::set<std::string> unused;
  const fs::path list = root / "all_unused_files.txt";
  if (!is_file(list)) return unused;
  std::istringstream stream(read_bytes(list));
  for (std::string word; stream >> word;) {
    unused.insert(fs::path(word).replace_extension().generic_string());
  }
  return unused;
}

class Finder {
 public:
  Finder(DataSet& set, fs::path frames)
      : set_(set),
        frames_(std::move(frames)),
        truths_(frames_.parent_path() / "disparity"),
        unused_(unused_frames(set.root)) {
    const fs::path above = frames_.parent_path().lexically_relative(set.root);
    if (*above.begin() != "..") above_ = above;  // if the given folder is the pass itself
  }

  void add_folder(const fs::path& left_folder) {
    const fs::path below = left_folder.parent_path().lexically_relative(frames_);
    for (const fs::path& left : files_in(left_folder)) {
      if (files::is_image(left)) add_frame(left, below.lexically_normal());
    }
  }

 private:
  void add_frame(const fs::path& left, const fs::path& below) {
    const std::string frame = (below / left.stem()).lexically_normal().generic_string();
    const std::string listed = (below / "left" / left.stem()).lexically_normal().generic_string();
    if (unused_.contains(frame) || unused_.contains(listed)) return;

    StereoPair pair;
    pair.name = (above_ / frame).lexically_normal().generic_string();
    pair.left = left;
    pair.right = frames_ / below / "right" / left.filename();
    pair.truth = truths_ / below / "left" / (left.stem().string() + ".pfm");
    for (const fs::path& file : {pair.right, pair.truth}) {
      if (is_file(file)) continue;
      set_.problems.push_back({pair.name, file.lexically_normal().string() + ": no such file"});
      return;
    }
    pair.max_disparity = kSceneFlowRange;
    set_.pairs.push_back(std::move(pair));
  }

  DataSet& set_;
  fs::path frames_;
  fs::path truths_;
  fs::path above_;  // from the data set's folder to the parent of the pass
  std::set<std::string> unused_;
};

}  // namespace

void find_scene_flow(DataSet& set) {
  for (const fs::path& frames : folders_below(set.root)) {
    if (!is_frames_folder(frames)) continue;
    Finder finder(set, frames);
    for (const fs::path& folder : folders_below(frames)) {
      if (folder.filename() == "left") finder.add_folder(folder);
    }
  }
}

bool looks_like_scene_flow(const std::vector<fs::path>& folders) {
  return std::any_of(folders.begin(), folders.end(), is_frames_folder);
}

Layout scene_flow_kind(const fs::path& root, const std::vector<fs::path>& folders) {
  bool scene_folders = false;
  for (const fs::path& folder : folders) {
    const fs::path below = folder.lexically_relative(root);
    for (const fs::path& part : below) {
      const std::string name = part.string();
      if (name.ends_with("mm_focallength")) return Layout::kDriving;
      if (name == "TRAIN" || name == "TEST") return Layout::kFlyingThings;
    }
    if (is_frames_folder(folder.parent_path())) {
      scene_folders |= folder.filename() != "left" && folder.filename() != "right";
    }
  }
  // Monkaa has one folder per scene; frames directly below the pass are a part of FlyingThings3D.
  return scene_folders ? Layout::kMonkaa : Layout::kFlyingThings;
}

}  // namespace mtstereo::eval
