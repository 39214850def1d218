// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "eval/datasets.hpp"

namespace mtstereo::eval {

/// What one layout's function finds: each adds to `set.pairs` and `set.problems`, which are sorted
/// afterwards. Each takes the folder that --dataset was given for.
void find_pair_folders(DataSet& set);  ///< Middlebury and ETH3D
void find_kitti(DataSet& set);
void find_scene_flow(DataSet& set);  ///< Driving, Monkaa, FlyingThings3D
void find_trimbot(DataSet& set);     ///< synthetic and real garden

/// Whether a folder looks like one of that layout's, for detect_layout().
bool looks_like_pair_folders(const std::vector<std::filesystem::path>& folders);
bool looks_like_eth3d(const std::vector<std::filesystem::path>& folders);
bool looks_like_kitti(const std::filesystem::path& root);
bool looks_like_scene_flow(const std::vector<std::filesystem::path>& folders);
bool looks_like_trimbot(const std::vector<std::filesystem::path>& folders);

/// Which of the three rendered sets a folder of that kind is.
Layout scene_flow_kind(const std::filesystem::path& root,
                       const std::vector<std::filesystem::path>& folders);
/// Which of the two gardens.
Layout trimbot_kind(const std::filesystem::path& root,
                    const std::vector<std::filesystem::path>& folders);

/// The file's path from the data set's folder, without extension, with '/' between the parts.
std::string name_below(const std::filesystem::path& root, const std::filesystem::path& file);

/// The name of a folder itself, also where it was given as "." or with a '/' at its end.
std::string own_name(const std::filesystem::path& folder);

/// True where there is a file (or a link to one) of that name.
bool is_file(const std::filesystem::path& file);

/// Default search ranges [px] of the data sets that do not tell their own.
inline constexpr int kKittiRange = 100;
inline constexpr int kSceneFlowRange = 192;
inline constexpr int kEth3dRange = 64;
inline constexpr int kTrimbotSyntheticRange = 100;
inline constexpr int kTrimbotRealRange = 64;

}  // namespace mtstereo::eval
