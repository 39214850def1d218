// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/outputs/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::outputs {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostNoted = 32;

// The folders that were created, for signal handlers: the inner ones first.
std::array<std::atomic<const char*>, kMostNoted> noted{};
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler reads it");

void note(const char* folder) {
  for (std::atomic<const char*>& each : noted) {
    const char* none = nullptr;
    if (each.compare_exchange_strong(none, folder)) return;
  }
}

void forget(const char* folder) {
  for (std::atomic<const char*>& each : noted) {
    const char* same = folder;
    each.compare_exchange_strong(same, nullptr);
  }
}

// The line of a process, such as "mtstereo-run left.mp4 right.mp4 --out results".
std::string command_of(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/cmdline", std::ios::binary);
  std::string line;
  for (std::string word; std::getline(in, word, '\0');) line += (line.empty() ? "" : " ") + word;
  return line;
}

// Who holds the lock on a folder, by the table of the kernel.
std::string holder_of(ino_t folder) {
  std::ifstream table("/proc/locks");
  const std::string end = ":" + std::to_string(folder);
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string number, kind, advice, mode, place;
    pid_t process = 0;
    words >> number >> kind >> advice >> mode >> process >> place;
    if (kind != "FLOCK" || !place.ends_with(end) || process <= 0) continue;
    const std::string command = command_of(process);
    return "process " + std::to_string(process) + (command.empty() ? "" : " (" + command + ")");
  }
  return "another process";
}

// Whether the name still leads to the folder that is open.
bool is_same(const fs::path& folder, const struct stat& opened) {
  struct stat named = {};
  return stat(folder.c_str(), &named) == 0 && named.st_dev == opened.st_dev &&
         named.st_ino == opened.st_ino;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, Sharing sharing) {
  try {
    // Another process may remove the empty folder in between.
    do {
      create(folder);
    } while (!lock(folder, sharing));
  } catch (...) {
    if (file_ >= 0) close(file_);
    remove_empty();
    throw;
  }
}

FolderLock::~FolderLock() {
  remove_empty();
  close(file_);
}

namespace {

// A link to nothing does not exist, and no folder can be created in its place.
void refuse_dangling_link(const fs::path& folder, const fs::path& part) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(part, error))) return;
  const fs::path target = fs::read_symlink(part, error);
  throw UserError(folder.string() + ": the folder cannot be created, because " + part.string() +
                  " is a link to " + target.string() +
                  ", which does not exist: create that folder, or give another one");
}

}  // namespace

void FolderLock::create(const fs::path& folder) {
  std::list<fs::path> missing;
  std::error_code error;
  fs::path part = fs::absolute(folder).lexically_normal();
  for (; !fs::exists(part, error) && part != part.parent_path(); part = part.parent_path()) {
    if (!part.has_filename()) continue;
    refuse_dangling_link(folder, part);
    missing.push_back(part);
  }
  if (!fs::is_directory(part, error)) {
    throw UserError(folder.string() + ": the folder cannot be created, because " + part.string() +
                    " is a file: give the name of a folder, which may not exist yet");
  }
  fs::create_directories(folder, error);
  if (error) {
    throw UserError(folder.string() + ": the folder cannot be created: " + error.message());
  }
  for (const fs::path& each : missing) note(each.c_str());
  created_.splice(created_.end(), missing);
}

// False if the folder has been removed meanwhile.
bool FolderLock::lock(const fs::path& folder, Sharing sharing) {
  if (file_ >= 0) close(std::exchange(file_, -1));
  file_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file_ < 0) {
    if (errno == ENOENT) return false;
    throw UserError(folder.string() + ": " + std::generic_category().message(errno));
  }
  struct stat opened = {};
  fstat(file_, &opened);
  const int mode = sharing == Sharing::kShared ? LOCK_SH : LOCK_EX;
  int result = 0;
  do {
    result = flock(file_, mode | LOCK_NB);
  } while (result != 0 && errno == EINTR);
  if (result != 0 && errno == EWOULDBLOCK) {
    throw UserError(folder.string() + ": " + holder_of(opened.st_ino) +
                    " writes into this folder: wait for its end, or choose another folder");
  }
  // A file system without locks is used without one.
  return is_same(folder, opened);
}

void FolderLock::remove_empty() {
  for (const fs::path& each : created_) {
    rmdir(each.c_str());
    forget(each.c_str());
  }
  created_.clear();
}

void remove_empty_folders() noexcept {
  for (const std::atomic<const char*>& each : noted) {
    const char* const folder = each;
    if (folder != nullptr) rmdir(folder);
  }
}

}  // namespace mtstereo::outputs
