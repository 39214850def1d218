// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/eval/ground_truth.hpp"

namespace mtstereo::eval {

/// The layout of a folder, that is, which data set it holds; docs/evaluation.md describes each.
enum class Layout {
  kMiddlebury,
  kKitti2015,
  kTrimbotSynthetic,
  kTrimbotReal,
  kDriving,
  kMonkaa,
  kFlyingThings,
  kEth3d,
};

/// The name of a layout for the option --dataset.
std::string_view layout_name(Layout layout);

/// The layout with this name; none if there is no such layout.
std::optional<Layout> find_layout(std::string_view name);

/// All names, in the order of Layout.
std::vector<std::string> layout_names();

/// The files of one pair and its properties in the data set. The files have not been read yet.
struct StereoPair {
  std::string name;  ///< path relative to the data set's folder, without extension; unique
  Layout layout = Layout::kMiddlebury;
  std::filesystem::path left;
  std::filesystem::path right;
  std::filesystem::path truth;  ///< .pfm, .png or _dmap.bin
  /// 255 = visible in both views, other values = not (Middlebury, ETH3D); may be empty
  std::filesystem::path visible_mask;
  /// ground truth of only the pixels that are visible in both views (KITTI); may be empty
  std::filesystem::path visible_truth;
  /// `truth` itself has only the pixels that are visible in both views (KITTI)
  bool truth_is_visible = false;
  /// 0 = background, other values = foreground objects (KITTI); may be empty
  std::filesystem::path object_map;
  /// *_cam.txt of left and right, for a depth map; may be empty
  std::pair<std::filesystem::path, std::filesystem::path> cameras;
  /// number of disparities to search [px]; none if the data set should state it and does not
  std::optional<int> max_disparity;
  double weight = 1;  ///< weight in the mean of the errors
};

/// A pair that cannot be used.
struct Problem {
  std::string pair;
  std::string reason;  ///< one sentence that names the file
};

/// The contents of a folder, or of several ones.
struct DataSet {
  Layout layout = Layout::kMiddlebury;  ///< of the first folder
  std::filesystem::path root;           ///< the first folder
  std::string name;                     ///< the names of all layouts
  std::string folder;                   ///< all folders
  std::vector<StereoPair> pairs;        ///< sorted by name
  std::vector<Problem> problems;        ///< pairs with a missing file
  std::vector<std::string> notes;       ///< remarks that matter for reading the figures
};

/// Detects the layout of a folder. Throws InputError if it is no known layout.
Layout detect_layout(const std::filesystem::path& root);

/// Lists the pairs of a folder. Throws InputError if the folder cannot be read or holds no pair of
/// that layout.
DataSet find_pairs(const std::filesystem::path& root, Layout layout);

/// The same for several folders, each with the given layout or the detected one. If there is more
/// than one, the names of the pairs begin with the name of their folder. Throws InputError also if
/// two pairs have the same name.
DataSet find_pairs(const std::vector<std::filesystem::path>& roots, std::optional<Layout> layout);

/// A pair in memory.
struct LoadedPair {
  cv::Mat left;   ///< CV_8UC1
  cv::Mat right;  ///< CV_8UC1, same size
  GroundTruth truth;
};

/// Reads a pair. Throws InputError, naming the file, if a file is missing or corrupt or has another
/// size.
LoadedPair load_pair(const StereoPair& pair, DmapMeaning meaning = DmapMeaning::kAuto);

/// Reads the object map of a pair into `truth.objects`, if the pair has one. Throws InputError as
/// load_pair().
void load_objects(const StereoPair& pair, LoadedPair& images);

/// The weight of a Middlebury training pair in the official mean (evaluation version 3), looked up
/// by the name of its folder.
double middlebury_weight(std::string_view name);

}  // namespace mtstereo::eval
