// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/outputs/listed_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "lib/outputs/user_error.hpp"
#include "lib/outputs/write_file.hpp"

namespace mtstereo::outputs {

namespace fs = std::filesystem;

namespace {

constexpr const char* kAnySize = "-";

// Lines with the size and the name of a file; the last line of a name counts.
WrittenFiles read_list(const fs::path& file, const std::string& head) {
  WrittenFiles written;
  std::error_code error;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return written;
  if (!std::getline(in, line) || line != head) return written;
  while (std::getline(in, line)) {
    const std::size_t space = line.find(' ');
    if (space == std::string::npos) continue;
    std::uintmax_t bytes = 0;
    std::istringstream size(line.substr(0, space));
    const bool known = static_cast<bool>(size >> bytes);
    written.add(unescaped(line.substr(space + 1)), known ? std::optional(bytes) : std::nullopt);
  }
  written.add(file.filename().string());
  return written;
}

}  // namespace

ListedFolder::ListedFolder(fs::path folder, std::string program)
    : folder_(std::move(folder)),
      list_("." + program + "-files"),
      head_("files of " + program),
      lock_(folder_),
      written_(read_list(folder_ / list_, head_)) {}

void ListedFolder::check(std::vector<std::string> targets, const FileSet& inputs) const {
  targets.push_back(list_);
  const std::string obstacle = obstacle_in(folder_, {std::move(targets), written_, inputs});
  if (!obstacle.empty()) throw UserError(obstacle);
}

void ListedFolder::clear() {
  WrittenFiles others;
  for (const auto& [name, bytes] : written_.files()) {
    if (name != list_) others.add(name, bytes);
  }
  remove_written(folder_, others);  // the list last
  remove_written(folder_, written_);
  written_ = {};
}

// Before the file is written: one that is listed may be missing, but not the other way round.
void ListedFolder::list(const std::string& name, std::optional<std::uintmax_t> bytes) {
  const fs::path file = folder_ / list_;
  std::string line = (bytes ? std::to_string(*bytes) : kAnySize) + (" " + escaped(name)) + "\n";
  if (!written_.has(list_)) line.insert(0, head_ + "\n");
  const int out = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
  const bool stored =
      out >= 0 && ::write(out, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  const int error = errno;
  if (out >= 0) close(out);
  if (!stored) {
    throw UserError(file.string() +
                    " cannot be written: " + std::generic_category().message(error));
  }
  written_.add(list_);
  written_.add(name, bytes);
}

// Removes the file of an earlier run, and makes the folder that the new one is in.
void ListedFolder::make_room(const std::string& name) const {
  check({name}, {});
  std::error_code error;
  fs::create_directories((folder_ / name).parent_path(), error);
  if (error) throw UserError((folder_ / name).string() + ": " + error.message());
  unlink((folder_ / name).c_str());
}

void ListedFolder::write(const std::string& name, std::string_view bytes) {
  make_room(name);
  list(name, bytes.size());
  write_file(folder_ / name, bytes);
}

fs::path ListedFolder::listed(const std::string& name) {
  make_room(name);
  list(name, std::nullopt);
  return folder_ / name;
}

void ListedFolder::exchange(const std::string& folder, const std::string& other) {
  const WrittenFiles before = written_;
  for (const auto& [name, bytes] : before.files()) {
    const std::string parent = fs::path(name).parent_path().string();
    if (parent == folder || parent == other) list(name, std::nullopt);
  }
}

void ListedFolder::measure(const std::string& name) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(folder_ / name, error);
  if (!error) list(name, bytes);
}

}  // namespace mtstereo::outputs
