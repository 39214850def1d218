// SPDX-License-Identifier: LGPL-2.1-or-later

// Middlebury and ETH3D: each pair is a folder with im0.png, im1.png, disp0GT.pfm and calib.txt.
// Sets of Middlebury before 2014: view1.png, view5.png, disp1.png (2005, 2006) or im2, im6, disp2
// (2001, 2003), with disparities times a factor in 8 bits. InStereo2K: left.png, right.png,
// left_disp.png, with disparities times 100 in 16 bits.

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <sstream>

#include "lib/files/file_names.hpp"
#include "lib/images/images.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/layouts.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

struct Names {
  const char *left, *right, *truth;
};

constexpr std::array<Names, 5> kOldNames{{{"view1.png", "view5.png", "disp1.png"},
                                          {"im2.png", "im6.png", "disp2.png"},
                                          {"im2.ppm", "im6.ppm", "disp2.pgm"},
                                          {"im2.ppm", "im6.ppm", "disp2.png"},
                                          {"left.png", "right.png", "left_disp.png"}}};

// The names in a folder of an old set or InStereo2K; none in other folders.
const Names* old_names(const fs::path& folder) {
  const auto* const found =
      std::find_if(kOldNames.begin(), kOldNames.end(), [&](const Names& names) {
        return is_file(folder / names.left) && is_file(folder / names.right) &&
               is_file(folder / names.truth);
      });
  return found == kOldNames.end() ? nullptr : found;
}

bool holds_pair(const fs::path& folder) {
  return is_file(folder / "im0.png") || is_file(folder / "im1.png") || old_names(folder) != nullptr;
}

// By what the ground truth of an old set is multiplied: 8 in 2001 (images of 430 to 435 px); later
// 1 at full size, 2 at half, and 3 (2005, 2006) or 4 (2003) at the smallest.
int old_factor(const Names& names, int width) {
  if (width > 1000) return 1;
  if (width > 520) return 2;
  if (names.left == kOldNames[0].left) return 3;
  return width < 450 ? 8 : 4;
}

void add_old(DataSet& set, StereoPair pair, const fs::path& folder, const Names& names) {
  pair.left = folder / names.left;
  pair.right = folder / names.right;
  pair.truth = folder / names.truth;
  if (names.left == kOldNames.back().left) {
    pair.truth_factor = 100 / 256.0;
    pair.max_disparity = 256;
  } else {
    const int factor = old_factor(names, images::read(pair.left, cv::IMREAD_GRAYSCALE).cols);
    pair.truth_factor = factor;
    pair.max_disparity = 256 / factor;
  }
  set.pairs.push_back(std::move(pair));
}

// ETH3D has an archive of its own for the ground truth: two_view_training_gt/NAME.
fs::path truth_folder(const fs::path& folder) {
  const fs::path above = folder.parent_path();
  const fs::path other = above.parent_path() / (above.filename().string() + "_gt");
  const fs::path apart = other / folder.filename();
  return above.has_filename() && files::is_folder(apart) ? apart : folder;
}

// An integer of calib.txt, as in "ndisp=290"; none if the line is missing.
std::optional<int> calibration_value(const fs::path& file, const std::string& key) {
  if (!is_file(file)) return std::nullopt;
  std::istringstream stream(read_bytes(file));
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(key + "=", 0) != 0) continue;
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    int value = 0;
    const char* begin = line.data() + key.size() + 1;
    const char* end = line.data() + line.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end || value < 1) {
      throw UserError(file, "'" + line + "' is not an integer above 0");
    }
    return value;
  }
  return std::nullopt;
}

std::optional<int> search_range(Layout layout, const fs::path& calibration) {
  const std::optional<int> stated = calibration_value(calibration, "ndisp");
  if (layout == Layout::kMiddlebury) return stated;
  // ETH3D states the width of the image, which limits nothing; only a smaller number is a range.
  const std::optional<int> width = calibration_value(calibration, "width");
  return stated && width && *stated < *width ? *stated : kEth3dRange;
}

// The first of these files that exists, or the first name if none does.
fs::path first_file(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (is_file(folder / name)) return folder / name;
  }
  return folder / *names.begin();
}

// Booster has a folder per camera and its maps as NumPy arrays.
const char* remedy_of(const fs::path& folder) {
  if (!files::is_folder(folder.parent_path() / "camera_02")) return "";
  return "; for a pair of Booster, put camera_00/im0.png as im0.png, camera_02/im0.png as im1.png "
         "and disp_00.npy as disp0GT.pfm (cv2.imwrite) into a folder of their own";
}

void add_folder(DataSet& set, const fs::path& folder) {
  StereoPair pair;
  pair.name =
      folder == set.root ? own_name(folder) : folder.lexically_relative(set.root).generic_string();
  if (const Names* names = old_names(folder)) return add_old(set, std::move(pair), folder, *names);
  pair.left = folder / "im0.png";
  pair.right = folder / "im1.png";
  const fs::path truths = truth_folder(folder);
  pair.truth = first_file(truths, {"disp0GT.pfm", "disp0.pfm"});
  for (const fs::path& file : {pair.left, pair.right, pair.truth}) {
    if (is_file(file)) continue;
    set.problems.push_back({pair.name, file.string() + ": no such file" + remedy_of(folder)});
    return;
  }
  const fs::path mask = truths / "mask0nocc.png";
  if (is_file(mask)) pair.visible_mask = mask;
  try {
    pair.max_disparity = search_range(set.layout, folder / "calib.txt");
  } catch (const UserError& error) {
    set.problems.push_back({pair.name, error.what()});
    return;
  }
  if (set.layout == Layout::kMiddlebury) {
    pair.weight = middlebury_weight(fs::path(pair.name).filename().string());
  }
  set.pairs.push_back(std::move(pair));
}

// Names of ETH3D pairs, such as "playground_1l" and "forest_2s".
bool has_eth3d_name(const std::string& name) {
  if (name.size() < 4) return false;
  const std::string end = name.substr(name.size() - 3);
  return end[0] == '_' && std::isdigit(static_cast<unsigned char>(end[1])) != 0 &&
         (end[2] == 'l' || end[2] == 's');
}

}  // namespace

double middlebury_weight(std::string_view name) {
  constexpr std::array<std::string_view, 5> kHalf{"PianoL", "Playroom", "Playtable", "Shelves",
                                                  "Vintage"};
  return std::find(kHalf.begin(), kHalf.end(), name) != kHalf.end() ? 0.5 : 1.0;
}

void find_pair_folders(DataSet& set) {
  for (const fs::path& folder : folders_below(set.root)) {
    if (holds_pair(folder)) add_folder(set, folder);
  }
}

bool looks_like_pair_folders(const std::vector<fs::path>& folders) {
  return std::any_of(folders.begin(), folders.end(), holds_pair);
}

bool looks_like_eth3d(const std::vector<fs::path>& folders) {
  return std::all_of(folders.begin(), folders.end(), [](const fs::path& folder) {
    return !holds_pair(folder) || has_eth3d_name(own_name(folder));
  });
}

}  // namespace mtstereo::eval
