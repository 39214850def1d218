// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/nested_views.hpp"

#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "lib/files/file_names.hpp"
#include "recordings/inputs/sources.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

// What one view has, by the paths in its folder.
class ViewSearch {
 public:
  explicit ViewSearch(fs::path view) : view_(std::move(view)) {
    // A link to a folder around the view leads nowhere new.
    std::error_code error;
    for (fs::path above = fs::canonical(view_, error); above.has_relative_path();) {
      above = above.parent_path();
      entered_.insert(above);
    }
    enter(view_);
  }

  const std::vector<std::string>& scenes() const { return scenes_; }
  bool has_both_views() const { return has_both_views_; }

 private:
  void enter(const fs::path& folder) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (error || !entered_.insert(real).second || is_result(folder)) return;
    std::vector<fs::path> images = files::images_in(folder), videos = videos_in(folder),
                          folders = files::folders_in(folder);
    const std::size_t video_count = videos.size();
    const bool has_images = !images_of_folder(folder).empty();
    has_both_views_ |= !take_views(images).empty() || !take_pairs(videos).empty();
    std::vector<fs::path> inner = folders;
    has_both_views_ |= !take_pairs(inner).empty();
    if (has_both_views_) return;
    if (has_images || video_count == 1) {
      add(folder);
      return;
    }
    for (const fs::path& video : videos) add(video);
    for (const fs::path& each : folders) enter(each);
  }

  void add(const fs::path& scene) {
    scenes_.push_back(scene.lexically_relative(view_).generic_string());
  }

  fs::path view_;
  std::vector<std::string> scenes_;
  std::set<fs::path> entered_;
  bool has_both_views_ = false;
};

// The path of the other view and what both have in common, if it is one of these.
std::optional<Partner> partner_in(const std::set<std::string>& right, const std::string& left) {
  if (right.contains(left)) return Partner{left, left};
  for (const Partner& partner : partners_of(left)) {
    if (right.contains(partner.right)) return partner;
  }
  return std::nullopt;
}

}  // namespace

NestedViews nested_views(const fs::path& left, const fs::path& right) {
  const ViewSearch first(left), second(right);
  NestedViews views;
  if (first.has_both_views() || second.has_both_views()) return views;
  std::set<std::string> rest(second.scenes().begin(), second.scenes().end());
  for (const std::string& scene : first.scenes()) {
    const std::optional<Partner> partner = partner_in(rest, scene);
    if (!partner) {
      views.lonely.push_back(left / scene);
      continue;
    }
    std::error_code error;
    const bool is_folder = fs::is_directory(left / scene, error);
    views.pairs.push_back(
        {left / scene, right / partner->right,
         is_folder ? partner->common : fs::path(partner->common).replace_extension().string()});
    rest.erase(partner->right);
  }
  for (const std::string& scene : rest) views.lonely.push_back(right / scene);
  return views;
}

}  // namespace mtstereo::run
