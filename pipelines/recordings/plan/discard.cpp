// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/discard.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <string>
#include <system_error>

#include "lib/outputs/user_error.hpp"
#include "recordings/plan/folder_names.hpp"
#include "recordings/plan/plan_contents.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

// What has a name. While it is open, nothing else gets its identity.
class Opened {
 public:
  explicit Opened(const fs::path& path)
      : number_(open(path.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC)),
        is_missing_(number_ < 0 && errno == ENOENT) {}
  ~Opened() {
    if (number_ >= 0) close(number_);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  bool is_missing() const { return is_missing_; }
  // Whether another process has replaced or removed it.
  bool has_lost(const fs::path& path) const {
    struct stat opened = {}, named = {};
    if (number_ < 0 || fstat(number_, &opened) != 0) return false;
    return lstat(path.c_str(), &named) != 0 || opened.st_dev != named.st_dev ||
           opened.st_ino != named.st_ino;
  }

 private:
  int number_;
  bool is_missing_;
};

// A file in the folder that is not of this program. The list of the files is of no use if another
// process replaced the folder after it was read.
std::string obstacle_of(const fs::path& folder) {
  for (;;) {
    const Opened opened(folder);
    if (opened.is_missing()) return {};
    const std::string obstacle = foreign_file_in(folder);
    if (obstacle.empty() || !opened.has_lost(folder)) return obstacle;
  }
}

// Where the folder is now; none if there was none.
std::optional<fs::path> set_aside(const fs::path& folder, const fs::path& parent) {
  for (;;) {
    if (const std::string obstacle = obstacle_of(folder); !obstacle.empty()) {
      throw UserError(obstacle);
    }
    const fs::path aside = unused_name(parent, "discarded");
    std::error_code error;
    fs::create_directories(parent, error);
    if (error) throw UserError(parent.string() + ": " + error.message());
    fs::rename(folder, aside, error);
    if (error == std::errc::no_such_file_or_directory) {
      if (!fs::exists(fs::symlink_status(folder, error))) return std::nullopt;
      continue;  // another process has removed `parent`
    }
    if (error) throw UserError(folder.string() + ": cannot be replaced: " + error.message());
    // A file may have appeared in it meanwhile. Nobody else has this name.
    const std::string obstacle = foreign_file_in(aside);
    if (obstacle.empty()) return aside;
    if (!rename_folder(aside, folder)) throw UserError(obstacle);
  }
}

}  // namespace

bool discard(const fs::path& folder, const fs::path& parent, const IsKept& is_kept) {
  const std::optional<fs::path> aside = set_aside(folder, parent);
  if (!aside) return true;
  const bool kept = is_kept && is_kept(*aside);
  // If there is another one by now, it is as good.
  if (!kept || !rename_folder(*aside, folder)) remove_listed(*aside);
  return !kept;
}

}  // namespace mtstereo::run
