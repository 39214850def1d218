// SPDX-License-Identifier: LGPL-2.1-or-later

// KITTI 2015: training/image_2, image_3, disp_occ_0 and disp_noc_0, where a frame has the same
// name. KITTI 2012: training/colored_0, colored_1 (or image_0, image_1), disp_occ, disp_noc.

#include <array>

#include "lib/files/file_names.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/layouts.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

struct Folders {
  fs::path left, right;
  fs::path occ, noc;  // empty if the folder does not exist
};

fs::path first_folder(const fs::path& base, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (files::is_folder(base / name)) return base / name;
  }
  return {};
}

std::optional<Folders> folders_of(const fs::path& base) {
  constexpr std::array<std::pair<const char*, const char*>, 3> kCameras{
      {{"image_2", "image_3"}, {"colored_0", "colored_1"}, {"image_0", "image_1"}}};
  Folders folders;
  for (const auto& [left, right] : kCameras) {
    if (!files::is_folder(base / left)) continue;
    folders.left = base / left;
    folders.right = base / right;
    break;
  }
  folders.occ = first_folder(base, {"disp_occ_0", "disp_occ"});
  folders.noc = first_folder(base, {"disp_noc_0", "disp_noc"});
  if (folders.left.empty() || (folders.occ.empty() && folders.noc.empty())) return std::nullopt;
  return folders;
}

// The given folder may be the data set's own or its folder `training`.
std::optional<Folders> find_folders(const fs::path& root) {
  if (const std::optional<Folders> inside = folders_of(root / "training")) return inside;
  return folders_of(root);
}

void add_frame(DataSet& set, const Folders& folders, const fs::path& left) {
  StereoPair pair;
  pair.name = left.stem().string();
  pair.left = left;
  pair.right = folders.right / left.filename();
  const bool has_occ = !folders.occ.empty();
  pair.truth = (has_occ ? folders.occ : folders.noc) / left.filename();
  for (const fs::path& file : {pair.right, pair.truth}) {
    if (is_file(file)) continue;
    set.problems.push_back({pair.name, file.string() + ": no such file"});
    return;
  }
  if (has_occ && !folders.noc.empty()) {
    pair.visible_truth = folders.noc / left.filename();
    if (!is_file(pair.visible_truth)) {
      set.problems.push_back({pair.name, pair.visible_truth.string() + ": no such file"});
      return;
    }
  }
  pair.max_disparity = kKittiRange;
  set.pairs.push_back(std::move(pair));
}

}  // namespace

bool looks_like_kitti(const fs::path& root) { return find_folders(root).has_value(); }

void find_kitti(DataSet& set) {
  const std::optional<Folders> folders = find_folders(set.root);
  if (!folders) return;
  if (folders->occ.empty()) {
    set.notes.emplace_back(
        "there is no disp_occ_0: 'all' means the pixels of disp_noc_0, visible in both views");
  }
  for (const fs::path& file : files_in(folders->left)) {
    // Frame 10 of a sequence has ground truth; frame 11 is for optical flow.
    if (files::extension_of(file) == ".png" && file.stem().string().ends_with("_10")) {
      add_frame(set, *folders, file);
    }
  }
}

}  // namespace mtstereo::eval
