// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tools/eval/data_set.hpp"

namespace mtstereo::eval {

/// One function per layout. Each searches the folder of `set` and appends to `set.pairs` and
/// `set.problems`, which the caller sorts.
void find_pair_folders(DataSet& set);  ///< Middlebury and ETH3D
void find_kitti(DataSet& set);
void find_scene_flow(DataSet& set);  ///< Driving, Monkaa, FlyingThings3D
void find_trimbot(DataSet& set);     ///< synthetic and real garden

/// Whether a folder looks like this layout, for detect_layout().
bool looks_like_pair_folders(const std::vector<std::filesystem::path>& folders);
bool looks_like_eth3d(const std::vector<std::filesystem::path>& folders);
bool looks_like_kitti(const std::filesystem::path& root);
bool looks_like_scene_flow(const std::vector<std::filesystem::path>& folders);
bool looks_like_trimbot(const std::vector<std::filesystem::path>& folders);

/// Which of the three Scene Flow data sets a folder holds.
Layout scene_flow_kind(const std::filesystem::path& root,
                       const std::vector<std::filesystem::path>& folders);
/// Which of the two gardens a folder holds.
Layout trimbot_kind(const std::filesystem::path& root,
                    const std::vector<std::filesystem::path>& folders);

/// The weight of a Middlebury training pair in the official mean (evaluation version 3), looked up
/// by the name of its folder.
double middlebury_weight(std::string_view name);

/// The path of a file relative to the data set's folder, without extension, separated by '/'.
std::string name_below(const std::filesystem::path& root, const std::filesystem::path& file);

/// The name of a folder itself, even if it was given as "." or with a trailing '/'.
std::string own_name(const std::filesystem::path& folder);

/// True if a file of this name, or a link to one, exists.
bool is_file(const std::filesystem::path& file);

/// Default search ranges [px] of the data sets that do not state one.
inline constexpr int kKittiRange = 100;
inline constexpr int kSceneFlowRange = 192;
inline constexpr int kEth3dRange = 64;
inline constexpr int kTrimbotSyntheticRange = 100;
inline constexpr int kTrimbotRealRange = 64;
inline constexpr int kNamedSidesRange = 128;  ///< DrivingStereo, Sintel, Virtual KITTI 2

}  // namespace mtstereo::eval
