// SPDX-License-Identifier: LGPL-2.1-or-later

// The TrimBot2020 gardens: two folders of images, vcam_0 and vcam_1 (rendered), cam_0 and cam_1
// (real) or left and right, and ground truth beside the left images or in its own folder. Files of
// one frame have the same frame number, the last digits in the name.

#include <algorithm>
#include <cctype>
#include <map>
#include <string>

#include "lib/files/file_names.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/layouts.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

// The folders of one stereo rig.
struct Rig {
  fs::path left, right;
};

// The folder of the right camera, if this is the folder of a left one. In rigs with several pairs,
// left cameras have even numbers: vcam_0 with vcam_1, vcam_2 with vcam_3.
std::optional<Rig> rig_of(const fs::path& left) {
  const std::string name = left.filename().string();
  fs::path right;
  if (name == "left") {
    right = left.parent_path() / "right";
  } else {
    const std::size_t at = name.rfind("cam_");
    if (at == std::string::npos || name.size() != at + 5) return std::nullopt;
    const char digit = name.back();
    if (std::isdigit(static_cast<unsigned char>(digit)) == 0 || (digit - '0') % 2 != 0) {
      return std::nullopt;
    }
    right = left.parent_path() / (name.substr(0, at + 4) + static_cast<char>(digit + 1));
  }
  if (!files::is_folder(right)) return std::nullopt;
  return Rig{left, right};
}

// The last number in a name, or the whole name if it has none.
std::string frame_of(const fs::path& file) {
  const std::string number = files::last_number(file);
  return number.empty() ? file.stem().string() : number;
}

// Label images, overlays and depth images are stored beside the views.
bool is_view(const fs::path& file) {
  if (!files::is_image(file)) return false;
  const std::string stem = file.stem().string();
  for (const char* other : {"_gtr", "_over", "_dmap", "_disp", "_depth", "_vis"}) {
    if (stem.ends_with(other)) return false;
  }
  return true;
}

bool is_truth(const fs::path& file, bool beside_images) {
  const std::string extension = files::extension_of(file);
  if (extension == ".bin") return file.stem().string().ends_with("dmap");
  return extension == ".pfm" || (extension == ".png" && !beside_images);
}

using Frames = std::map<std::string, std::vector<fs::path>>;

template <typename Accept>
Frames frames_in(const fs::path& folder, Accept accept) {
  Frames frames;
  for (const fs::path& file : files_in(folder)) {
    if (accept(file)) frames[frame_of(file)].push_back(file);
  }
  return frames;
}

// The separate ground truth folder is searched first; with several cameras, its subfolder named
// after the camera.
Frames truths_of(const Rig& rig) {
  const fs::path up = rig.left.parent_path();
  for (const char* name : {"ground_truth_disparity", "ground_truth", "disparity", "disp", "gt"}) {
    for (const fs::path& folder : {up / name / rig.left.filename(), up / name}) {
      Frames frames = frames_in(folder, [](const fs::path& f) { return is_truth(f, false); });
      if (!frames.empty()) return frames;
    }
  }
  return frames_in(rig.left, [](const fs::path& f) { return is_truth(f, true); });
}

// The camera of "vcam_0_f00001_undist.png" is in "vcam_0_f00001_cam.txt".
fs::path camera_file(const fs::path& image) {
  const std::string stem = image.stem().string();
  for (const std::string& base : {stem.substr(0, stem.rfind('_')), stem}) {
    const fs::path file = image.parent_path() / (base + "_cam.txt");
    if (is_file(file)) return file;
  }
  return {};
}

class RigFinder {
 public:
  RigFinder(DataSet& set, const Rig& rig)
      : set_(set), rig_(rig), right_(frames_in(rig.right, is_view)), truth_(truths_of(rig)) {}

  void add_all() {
    for (const auto& [frame, files] : frames_in(rig_.left, is_view)) add(frame, files);
  }

 private:
  // The only file of a frame. No file or several are recorded as a problem.
  const fs::path* one_of(const Frames& frames, const std::string& frame, const std::string& pair,
                         const std::string& what) {
    const auto found = frames.find(frame);
    if (found != frames.end() && found->second.size() == 1) return &found->second.front();
    const std::string count = found == frames.end() ? "no " : "more than one ";
    set_.problems.push_back(
        {pair, rig_.left.string() + ": " + count + what + " with frame number " + frame});
    return nullptr;
  }

  void add(const std::string& frame, const std::vector<fs::path>& left) {
    StereoPair pair;
    pair.name = name_below(set_.root, left.front());
    if (left.size() > 1) {
      set_.problems.push_back(
          {pair.name,
           rig_.left.string() + ": more than one left image with frame number " + frame});
      return;
    }
    const fs::path* right = one_of(right_, frame, pair.name, "right image");
    if (right == nullptr) return;
    const fs::path* truth = one_of(truth_, frame, pair.name, "ground truth");
    if (truth == nullptr) return;
    pair.left = left.front();
    pair.right = *right;
    pair.truth = *truth;
    pair.cameras = {camera_file(pair.left), camera_file(pair.right)};
    pair.max_disparity =
        set_.layout == Layout::kTrimbotSynthetic ? kTrimbotSyntheticRange : kTrimbotRealRange;
    set_.pairs.push_back(std::move(pair));
  }

  DataSet& set_;
  Rig rig_;
  Frames right_;
  Frames truth_;
};

}  // namespace

void find_trimbot(DataSet& set) {
  for (const fs::path& folder : folders_below(set.root)) {
    if (const std::optional<Rig> rig = rig_of(folder)) RigFinder(set, *rig).add_all();
  }
}

bool looks_like_trimbot(const std::vector<fs::path>& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [](const fs::path& folder) { return rig_of(folder).has_value(); });
}

Layout trimbot_kind(const fs::path& root, const std::vector<fs::path>& folders) {
  const bool rendered = std::any_of(folders.begin(), folders.end(), [](const fs::path& folder) {
    return folder.filename().string().starts_with("vcam_");
  });
  std::string name = own_name(root);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return rendered || name.find("synth") != std::string::npos ? Layout::kTrimbotSynthetic
                                                             : Layout::kTrimbotReal;
}

}  // namespace mtstereo::eval
