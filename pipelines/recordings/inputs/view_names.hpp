// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
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

/// Finds the pairs among paths of one folder and removes them from the list: those of
/// partners_of(), and cam1 with cam2 if there is no cam3.
std::vector<PathPair> take_pairs(std::vector<std::filesystem::path>& paths);

/// What is left of a name without the word that states the left or the right view; the name itself
/// if it has no such word.
std::string name_without_view(const std::string& name, bool right);

/// The name without its digits: the same for all images of one recording.
std::string name_without_numbers(const std::string& name);

/// The images of two views in one folder, whose names differ in their numbers only.
struct ViewImages {
  std::string common;  ///< what all names share, without digits
  std::vector<std::filesystem::path> left, right;
};

/// Finds the images of both views among those of one folder and removes them from the list. The
/// n-th of both views are a pair, unless no name has a partner: then each view has its own images,
/// such as those with other times or extensions.
std::vector<ViewImages> take_views(std::vector<std::filesystem::path>& paths);

}  // namespace mtstereo::run
