// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// The files of one pair and its properties in the data set. The files have not been read yet.
struct StereoPair {
  std::string name;  ///< path relative to the data set's folder, without extension; unique
  std::filesystem::path left;
  std::filesystem::path right;
  std::filesystem::path truth;  ///< .pfm, .png or _dmap.bin
  /// what the values of an image are divided by: gray values of 8 bits, 1/256 gray value of 16 bits
  double truth_factor = 1;
  bool truth_of_sintel = false;  ///< three channels per value
  /// If the values are depths: what they divide, which gives px; else 0
  double truth_product = 0;
  /// 255 = visible in both views, other values = not (Middlebury, ETH3D); may be empty
  std::filesystem::path visible_mask;
  /// ground truth of only the pixels that are visible in both views (KITTI); may be empty
  std::filesystem::path visible_truth;
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

}  // namespace mtstereo::eval
