// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mtstereo::run {

/// What the right view may be called, by the name of the left one.
struct Partner {
  std::string right;   ///< such as "drive_right.mp4" for "drive_left.mp4"
  std::string common;  ///< what both names share, such as "drive.mp4"
};

/// The possible partners of a name: left and right, l and r, cam0 and cam1, image_02 and image_03.
/// None if it is not the name of a left view.
std::vector<Partner> partners_of(const std::string& left);

/// Whether a name is that of a left or right view.
bool is_view_name(const std::string& name);

/// Two paths whose names are those of a left and a right view.
struct PathPair {
  std::filesystem::path left, right;
  std::string common;  ///< what both names share
};

/// Finds the pairs among paths of one folder and removes them from the list.
std::vector<PathPair> take_pairs(std::vector<std::filesystem::path>& paths);

}  // namespace mtstereo::run
