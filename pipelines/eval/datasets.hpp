// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "eval/ground_truth.hpp"

namespace mtstereo::eval {

/// How a folder is laid out, that is which data set it holds; docs/evaluation.md shows each.
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

/// The name of a layout, as the option --dataset takes it.
std::string_view layout_name(Layout layout);

/// The layout with this name, if there is one.
std::optional<Layout> find_layout(std::string_view name);

/// All names, in the order of Layout.
std::vector<std::string> layout_names();

/// The files of one pair and what the data set says about it. Nothing is read yet.
struct StereoPair {
  std::string name;  ///< path from the data set's folder, without extension; unique in it
  std::filesystem::path left;
  std::filesystem::path right;
  std::filesystem::path truth;  ///< .pfm, .png or _dmap.bin
  /// 255 where both views see the pixel, all else is not (Middlebury, ETH3D); may be empty
  std::filesystem::path visible_mask;
  /// ground truth of the pixels that both views see alone (KITTI); may be empty
  std::filesystem::path visible_truth;
  /// *_cam.txt of left and right, for a depth map; may be empty
  std::pair<std::filesystem::path, std::filesystem::path> cameras;
  /// number of disparities to search [px]; none where the data set should tell and does not
  std::optional<int> max_disparity;
  double weight = 1;  ///< in the mean of the errors
};

/// A pair that cannot be used.
struct Problem {
  std::string pair;
  std::string reason;  ///< one sentence that names the file
};

/// What a folder holds.
struct DataSet {
  Layout layout = Layout::kMiddlebury;
  std::filesystem::path root;
  std::vector<StereoPair> pairs;   ///< sorted by name
  std::vector<Problem> problems;   ///< pairs of which a file is missing
  std::vector<std::string> notes;  ///< what the reader of the figures should know
};

/// Finds out which layout a folder has. Throws InputError where it has none that is known.
Layout detect_layout(const std::filesystem::path& root);

/// Lists the pairs of a folder. Throws InputError where the folder cannot be read, and where it has
/// nothing of that layout.
DataSet find_pairs(const std::filesystem::path& root, Layout layout);

/// A pair in memory.
struct LoadedPair {
  cv::Mat left;   ///< CV_8UC1
  cv::Mat right;  ///< CV_8UC1, same size
  GroundTruth truth;
};

/// Reads a pair. Throws InputError, naming the file, where one is missing, broken or of another
/// size.
LoadedPair load_pair(const StereoPair& pair, DmapMeaning meaning = DmapMeaning::kAuto);

/// The weight of a Middlebury training pair in the official mean (evaluation version 3), by the
/// name of its folder.
double middlebury_weight(std::string_view name);

}  // namespace mtstereo::eval
