// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/new_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>
#include <utility>

namespace mtstereo {
namespace {

/// A name in the same folder that no other file of this process or of another one has.
std::string name_aside(const std::string& path) {
  static std::atomic<unsigned> count{0};
  return path + "." + std::to_string(getpid()) + "-" + std::to_string(count++) + ".part";
}

/// Whether a regular file is not empty and does not begin like those with `mark`, or cannot be
/// read.
bool is_foreign(const std::string& path, std::string_view mark) {
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open()) return true;
  std::string begin(256, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  return !begin.empty() && begin.find(mark) == std::string::npos;
}

}  // namespace

NewFile::NewFile(std::string path) : path_(std::move(path)) {}

NewFile::~NewFile() {
  if (file_ >= 0) close(file_);
  if (!aside_.empty()) unlink(aside_.c_str());
}

Error NewFile::failure(const char* what, int number) const {
  return {ErrorCode::kSystem,
          path_ + " cannot be " + what + ": " + std::generic_category().message(number)};
}

Status NewFile::open(std::string_view mark) {
  struct stat existing = {};
  if (stat(path_.c_str(), &existing) == 0) {
    if (!S_ISREG(existing.st_mode)) {
      return Error{ErrorCode::kSystem, path_ + " cannot be replaced: it is not a regular file"};
    }
    if (!mark.empty() && is_foreign(path_, mark)) {
      return Error{ErrorCode::kSystem, path_ + " cannot be replaced: mtstereo did not write it; " +
                                           "move it away, or write elsewhere"};
    }
  }
  std::string aside = name_aside(path_);
  file_ = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0) return failure("created", errno);
  aside_ = std::move(aside);
  return {};
}

Status NewFile::write(const void* data, std::size_t size) {
  const auto* from = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(file_, from, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      return failure("written", errno);
    }
    from += written;
    size -= static_cast<std::size_t>(written);
  }
  return {};
}

Status NewFile::sync() {
  if (fsync(file_) != 0) return failure("written", errno);
  return {};
}

Status NewFile::finish() {
  if (close(std::exchange(file_, -1)) != 0) return failure("written", errno);
  if (std::rename(aside_.c_str(), path_.c_str()) != 0) return failure("replaced", errno);
  aside_.clear();
  return {};
}

}  // namespace mtstereo
