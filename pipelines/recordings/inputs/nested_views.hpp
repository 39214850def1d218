// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "recordings/inputs/view_names.hpp"

namespace mtstereo::run {

/// The scenes in the folders of two views, such as clean_left/alley and clean_right/alley.
struct NestedViews {
  std::vector<PathPair> pairs;  ///< for source_of(); `common` is what their paths share
  std::vector<std::filesystem::path> lonely;  ///< those that the other view does not have
};

/// Finds them at any depth: folders with images or videos that have the same path in both folders,
/// or paths such as a_left.mp4 and a_right.mp4. No pairs if a folder in them has both views: then
/// the folders are not those of views.
NestedViews nested_views(const std::filesystem::path& left, const std::filesystem::path& right);

}  // namespace mtstereo::run
