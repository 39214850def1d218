// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/datasets.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "lib/files/file_names.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/layouts.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 8> kLayoutNames{
    "middlebury", "kitti2015", "trimbot-synthetic", "trimbot-real",
    "driving",    "monkaa",    "flyingthings",      "eth3d"};

// How to continue with a file of the wrong size that an evaluation does not need.
constexpr const char* kAdvice =
    "; replace it with the one of this resolution, or remove it to evaluate without it";

void require_folder(const fs::path& root) {
  std::error_code error;
  if (!fs::exists(root, error)) throw UserError(root, "no such folder");
  if (!fs::is_directory(root, error)) throw UserError(root, "is not a folder");
}

cv::Mat read_truth(const StereoPair& pair, cv::Size size, DmapMeaning meaning) {
  const std::string extension = files::extension_of(pair.truth);
  if (pair.truth_of_sintel) return read_sintel_disparity(pair.truth);
  if (pair.truth_product > 0) return read_png_depth(pair.truth, pair.truth_product);
  if (extension == ".pfm") return read_pfm_disparity(pair.truth);
  if (extension != ".bin") return read_png_disparity(pair.truth) / pair.truth_factor;

  cv::Mat map = read_dmap(pair.truth, size);
  const bool has_cameras = !pair.cameras.first.empty() && !pair.cameras.second.empty();
  if (meaning == DmapMeaning::kDisparity) return map;
  if (meaning == DmapMeaning::kAuto && !has_cameras) return map;
  if (!has_cameras) {
    throw UserError(pair.truth,
                    "cannot be read as depth: that needs the *_cam.txt of both cameras beside "
                    "the images");
  }
  try {
    return depth_to_disparity(map, read_camera(pair.cameras.first),
                              read_camera(pair.cameras.second));
  } catch (const UserError& error) {
    throw UserError(pair.truth, std::string("cannot be converted to disparity: ") + error.what());
  }
}

}  // namespace

std::string_view layout_name(Layout layout) {
  return kLayoutNames[static_cast<std::size_t>(layout)];
}

std::optional<Layout> find_layout(std::string_view name) {
  const auto* const found = std::find(kLayoutNames.begin(), kLayoutNames.end(), name);
  if (found == kLayoutNames.end()) return std::nullopt;
  return static_cast<Layout>(found - kLayoutNames.begin());
}

std::vector<std::string> layout_names() { return {kLayoutNames.begin(), kLayoutNames.end()}; }

std::string name_below(const fs::path& root, const fs::path& file) {
  return fs::path(file).replace_extension().lexically_relative(root).generic_string();
}

std::string own_name(const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(folder, error);
  return (error ? folder : real).filename().string();
}

bool is_file(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

Layout detect_layout(const fs::path& root) {
  require_folder(root);
  if (looks_like_kitti(root)) return Layout::kKitti2015;
  const std::vector<fs::path> folders = folders_below(root);
  if (looks_like_scene_flow(folders)) return scene_flow_kind(root, folders);
  if (looks_like_pair_folders(folders)) {
    return looks_like_eth3d(folders) ? Layout::kEth3d : Layout::kMiddlebury;
  }
  if (looks_like_trimbot(folders)) return trimbot_kind(root, folders);
  throw UserError(root,
                  "has no known layout. Put the images into left/ and right/ there, and the ground "
                  "truth of the left views into disparity/, with the same names: .pfm, or .png of "
                  "16 bits (px = value / 256). docs/evaluation.md describes other layouts, and "
                  "--dataset selects one");
}

DataSet find_pairs(const fs::path& root, Layout layout) {
  require_folder(root);
  DataSet set;
  set.layout = layout;
  set.root = root.has_filename() ? root : root.parent_path();
  switch (layout) {
    case Layout::kMiddlebury:
    case Layout::kEth3d:
      find_pair_folders(set);
      break;
    case Layout::kKitti2015:
      find_kitti(set);
      break;
    case Layout::kDriving:
    case Layout::kMonkaa:
    case Layout::kFlyingThings:
      find_scene_flow(set);
      break;
    case Layout::kTrimbotSynthetic:
    case Layout::kTrimbotReal:
      find_trimbot(set);
      break;
  }
  if (set.pairs.empty() && set.problems.empty()) {
    throw UserError(root, "holds no stereo pair in the layout of " +
                              std::string(layout_name(layout)) + " (see docs/evaluation.md)");
  }
  std::sort(set.pairs.begin(), set.pairs.end(),
            [](const StereoPair& a, const StereoPair& b) { return a.name < b.name; });
  return set;
}

LoadedPair load_pair(const StereoPair& pair, DmapMeaning meaning) {
  LoadedPair loaded;
  loaded.left = read_gray(pair.left);
  loaded.right = read_gray(pair.right);
  const cv::Size size = loaded.left.size();
  require_size(pair.right, loaded.right, size);
  loaded.truth.disparity = read_truth(pair, size, meaning);
  require_size(pair.truth, loaded.truth.disparity, size);
  if (!pair.visible_mask.empty()) {
    loaded.truth.visible = read_visible_mask(pair.visible_mask);
    require_size(pair.visible_mask, loaded.truth.visible, size, kAdvice);
  } else if (!pair.visible_truth.empty()) {
    const cv::Mat visible = read_png_disparity(pair.visible_truth);
    require_size(pair.visible_truth, visible, size);
    // NaN (unknown) does not equal itself. NOLINTNEXTLINE(misc-redundant-expression)
    loaded.truth.visible = visible == visible;
  }
  return loaded;
}

}  // namespace mtstereo::eval
