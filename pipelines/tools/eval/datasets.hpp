// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/eval/data_set.hpp"
#include "tools/eval/ground_truth.hpp"

namespace mtstereo::eval {

/// The name of a layout for the option --dataset.
std::string_view layout_name(Layout layout);

/// The layout with this name; none if there is no such layout.
std::optional<Layout> find_layout(std::string_view name);

/// All names, in the order of Layout.
std::vector<std::string> layout_names();

/// Detects the layout of a folder. Throws UserError if the layout is unknown.
Layout detect_layout(const std::filesystem::path& root);

/// Lists the pairs of a folder. Throws UserError if the folder cannot be read or holds no pair of
/// that layout.
DataSet find_pairs(const std::filesystem::path& root, Layout layout);

/// The same for several folders, each with the given layout or the detected one. If there is more
/// than one, the names of the pairs begin with the name of their folder. Throws UserError also if
/// two pairs have the same name.
DataSet find_pairs(const std::vector<std::filesystem::path>& roots, std::optional<Layout> layout);

/// A pair in memory.
struct LoadedPair {
  cv::Mat left;   ///< CV_8UC1
  cv::Mat right;  ///< CV_8UC1, same size
  GroundTruth truth;
};

/// Reads a pair. Throws UserError, naming the file, if a file is missing or corrupt or has another
/// size.
LoadedPair load_pair(const StereoPair& pair, DmapMeaning meaning = DmapMeaning::kAuto);

}  // namespace mtstereo::eval
