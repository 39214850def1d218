// SPDX-License-Identifier: LGPL-2.1-or-later

// The TrimBot2020 gardens: two folders of images, vcam_0 and vcam_1 (rendered), cam_0 and cam_1
// (real) or left and right, and ground truth beside the left images or in its own folder. Files of
// one frame have the same frame number, the last digits in the name, or else the same name.
// DrivingStereo: train-left-image/SCENE, train-right-image/SCENE, train-disparity-map/SCENE.
// Sintel: clean_left/SCENE, clean_right/SCENE, disparities/SCENE; the final pass where there is no
// clean one. Virtual KITTI 2: rgb/Camera_0, rgb/Camera_1, depth/Camera_0.

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string>

#include "lib/files/file_names.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/layouts.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

// Of Virtual KITTI 2: the focal length [px] times the baseline [cm], which are the same everywhere.
constexpr double kVirtualKittiProduct = 725.0087 * 53.2725;

// The folders of one stereo rig.
struct Rig {
  fs::path left, right;
};

// Data sets with a folder of scenes for each side, named alike.
struct Words {
  const char *left, *right, *truth;
};
constexpr Words kDrivingStereo = {"left-image", "right-image", "disparity-map"};
constexpr Words kVirtualKitti = {"rgb/Camera_0", "rgb/Camera_1", "depth/Camera_0"};
constexpr Words kSintel = {"clean_left", "clean_right", "disparities"};
constexpr Words kSintelFinal = {"final_left", "final_right", "disparities"};
constexpr std::array kNamedSides = {kDrivingStereo, kVirtualKitti, kSintel, kSintelFinal};

// Whether the folder or the one above is that of the left side in such a data set.
bool has_side(const fs::path& left, const Words& words) {
  const fs::path above = left.parent_path();
  return (above.filename() / left.filename()).string().find(words.left) != std::string::npos;
}

// The words of the data set of a folder; none if it is of another one.
const Words* words_of(const fs::path& left) {
  const auto* const found = std::find_if(kNamedSides.begin(), kNamedSides.end(),
                                         [&](const Words& words) { return has_side(left, words); });
  return found == kNamedSides.end() ? nullptr : found;
}

// The folder with another one of its words.
fs::path named_folder(const fs::path& left, const Words& words, const std::string& word) {
  const fs::path above = left.parent_path();
  std::string names = (above.filename() / left.filename()).string();
  names.replace(names.find(words.left), std::string(words.left).size(), word);
  return above.parent_path() / names;
}

// The folder of the right camera, if this is the folder of a left one. In rigs with several pairs,
// left cameras have even numbers: vcam_0 with vcam_1, vcam_2 with vcam_3.
std::optional<Rig> rig_of(const fs::path& left) {
  const std::string name = left.filename().string();
  fs::path right;
  if (name == "left") {
    right = left.parent_path() / "right";
  } else if (const Words* words = words_of(left)) {
    right = named_folder(left, *words, words->right);
    const bool final = words->left == kSintelFinal.left;
    if (final && files::is_folder(named_folder(left, *words, kSintel.left))) return std::nullopt;
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
Frames frames_in(const fs::path& folder, bool by_name, Accept accept) {
  Frames frames;
  for (const fs::path& file : files_in(folder)) {
    if (accept(file)) frames[by_name ? file.stem().string() : frame_of(file)].push_back(file);
  }
  return frames;
}

// Whether frame numbers do not tell the files apart, as in 000000_10 and 000001_10 or in times with
// milliseconds at the end, but the names do.
bool names_tell_apart(const Rig& rig) {
  const Frames numbers = frames_in(rig.left, false, is_view);
  if (std::all_of(numbers.begin(), numbers.end(), [](auto& f) { return f.second.size() == 1; })) {
    return false;
  }
  const Frames left = frames_in(rig.left, true, is_view);
  const Frames right = frames_in(rig.right, true, is_view);
  return std::all_of(left.begin(), left.end(), [&](auto& f) { return right.count(f.first) == 1; });
}

// The separate ground truth folder is searched first; with several cameras, its subfolder named
// after the camera.
Frames truths_of(const Rig& rig, bool by_name) {
  const auto is_map = [](const fs::path& f) { return is_truth(f, false); };
  if (const Words* words = words_of(rig.left)) {
    return frames_in(named_folder(rig.left, *words, words->truth), by_name, is_map);
  }
  const fs::path up = rig.left.parent_path();
  for (const char* name : {"ground_truth_disparity", "ground_truth", "disparity", "disp", "gt"}) {
    for (const fs::path& folder : {up / name / rig.left.filename(), up / name}) {
      Frames frames = frames_in(folder, by_name, is_map);
      if (!frames.empty()) return frames;
    }
  }
  return frames_in(rig.left, by_name, [](const fs::path& f) { return is_truth(f, true); });
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
      : set_(set),
        rig_(rig),
        by_name_(names_tell_apart(rig)),
        right_(frames_in(rig.right, by_name_, is_view)),
        truth_(truths_of(rig, by_name_)) {}

  void add_all() {
    for (const auto& [frame, files] : frames_in(rig_.left, by_name_, is_view)) {
      add(frame, files);
    }
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
    pair.max_disparity = set_.layout == Layout::kTrimbotSynthetic ? kTrimbotSyntheticRange
                         : words_of(rig_.left) == nullptr         ? kTrimbotRealRange
                                                                  : kNamedSidesRange;
    pair.truth_of_sintel = has_side(rig_.left, kSintel) || has_side(rig_.left, kSintelFinal);
    if (has_side(rig_.left, kVirtualKitti)) pair.truth_product = kVirtualKittiProduct;
    set_.pairs.push_back(std::move(pair));
  }

  DataSet& set_;
  Rig rig_;
  bool by_name_;
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
