// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/outputs/written_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <system_error>

namespace mtstereo::outputs {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMove = ": move it, or choose another folder by --out";

bool is_inside(const fs::path& name) {
  if (name.empty() || name.is_absolute()) return false;
  for (const fs::path& part : name) {
    if (part.empty() || part == "." || part == "..") return false;
  }
  return true;
}

// A folder that is reached through a link is not of this program.
bool has_plain_parents(const fs::path& folder, const fs::path& name) {
  std::error_code error;
  for (fs::path part = name.parent_path(); !part.empty(); part = part.parent_path()) {
    if (!fs::is_directory(fs::symlink_status(folder / part, error))) return false;
  }
  return true;
}

// What has a name, by one look: another process may remove or replace it before a second one.
struct Found {
  explicit Found(const fs::path& path) {
    if (lstat(path.c_str(), &status) != 0) error = errno;
  }
  bool is_missing() const { return error == ENOENT || error == ENOTDIR; }
  bool is_file() const { return error == 0 && S_ISREG(status.st_mode); }
  bool is_folder() const { return error == 0 && S_ISDIR(status.st_mode); }

  struct stat status = {};
  int error = 0;
};

// Why a regular file is not the one that was written; empty if it is.
std::string change_of(const struct stat& file, std::optional<std::uintmax_t> bytes) {
  const auto found = static_cast<std::uintmax_t>(file.st_size);
  if (!bytes || found == *bytes) return {};
  return "has " + std::to_string(found) + " of " + std::to_string(*bytes) + " bytes";
}

class Search {
 public:
  Search(const fs::path& folder, const Intent& intent) : folder_(folder), intent_(intent) {}

  std::string obstacle(const fs::path& name) const {
    const fs::path path = folder_ / name;
    const Found found(path);
    if (found.is_missing()) return {};
    if (found.error != 0) {
      return path.string() +
             ": cannot be examined: " + std::generic_category().message(found.error);
    }
    if (found.is_file()) return obstacle_of_file(path, name, found.status);
    if (found.is_folder()) return obstacle_of_folder(path, name);
    return path.string() + " is in the way (a link, a pipe or a device)" + kMove;
  }

 private:
  std::string obstacle_of_file(const fs::path& path, const fs::path& name,
                               const struct stat& status) const {
    if (intent_.inputs.has(path)) {
      return path.string() + " is an input, and would be replaced: choose another folder by --out";
    }
    const auto found = intent_.written.files().find(name.generic_string());
    if (found == intent_.written.files().end()) {
      return path.string() + " is in the way, and no earlier run wrote it" + kMove;
    }
    const std::string change = change_of(status, found->second);
    if (change.empty()) return {};
    return path.string() + " was changed since it was written (it " + change + ")" + kMove;
  }

  std::string obstacle_of_folder(const fs::path& path, const fs::path& name) const {
    std::error_code error;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error)) {
      std::string found = obstacle(name / entry->path().filename());
      if (!found.empty()) return found;
    }
    if (!error || error == std::errc::no_such_file_or_directory) return {};
    return path.string() + ": cannot be read: " + error.message();
  }

  const fs::path& folder_;
  const Intent& intent_;
};

}  // namespace

void WrittenFiles::add(const std::string& name, std::optional<std::uintmax_t> bytes) {
  if (is_inside(name)) files_.insert_or_assign(name, bytes);
}

FileSet::FileSet(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    struct stat found = {};
    if (stat(file.c_str(), &found) == 0) files_.emplace(found.st_dev, found.st_ino);
  }
}

bool FileSet::has(const fs::path& file) const {
  struct stat found = {};
  return stat(file.c_str(), &found) == 0 && files_.count({found.st_dev, found.st_ino}) != 0;
}

std::string obstacle_in(const fs::path& folder, const Intent& intent) {
  const Search search(folder, intent);
  for (const std::string& target : intent.targets) {
    std::string found = search.obstacle(target);
    if (!found.empty()) return found;
  }
  for (const auto& [name, bytes] : intent.written.files()) {
    if (!intent.inputs.has(folder / name)) continue;
    return (folder / name).string() +
           " is an input, and would be removed: choose another folder by --out";
  }
  return {};
}

void remove_written(const fs::path& folder, const WrittenFiles& written) {
  std::set<fs::path, std::greater<>> parents;  // the inner ones first
  for (const auto& [name, bytes] : written.files()) {
    const fs::path file = folder / name;
    if (!has_plain_parents(folder, name)) continue;
    const Found found(file);
    if (!found.is_file() || !change_of(found.status, bytes).empty()) continue;
    unlink(file.c_str());
    for (fs::path part = fs::path(name).parent_path(); !part.empty(); part = part.parent_path()) {
      parents.insert(part);
    }
  }
  for (const fs::path& parent : parents) rmdir((folder / parent).c_str());
}

std::string defect_of(const fs::path& folder, const WrittenFiles& written) {
  for (const auto& [name, bytes] : written.files()) {
    struct stat found = {};
    if (stat((folder / name).c_str(), &found) != 0 || !S_ISREG(found.st_mode)) {
      return name + " is missing";
    }
    const std::string change = change_of(found, bytes);
    if (!change.empty()) return name + " " + change;
  }
  return {};
}

}  // namespace mtstereo::outputs
