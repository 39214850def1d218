// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/files.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <system_error>

#include "lib/outputs/user_error.hpp"
#include "lib/outputs/write_file.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;

std::string read_bytes(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw UserError(file, "no such file");
  if (error) throw UserError(file, "cannot be read: " + error.message());
  if (!fs::is_regular_file(status)) throw UserError(file, "is not a file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw UserError(file, "cannot be read: " + error.message());

  std::ifstream stream(file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    throw UserError(file, "cannot be read");
  }
  return bytes;
}

void make_parent_folder(const fs::path& file) {
  if (!file.has_parent_path()) return;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) {
    throw UserError(file.parent_path(), "the folder cannot be created: " + error.message());
  }
}

void write_bytes(const fs::path& file, const std::string& bytes) {
  make_parent_folder(file);
  try {
    outputs::write_file(file, bytes);
  } catch (const mtstereo::UserError& error) {
    throw UserError(file, std::string("cannot be written: ") + error.what());
  }
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (!it->is_directory(ignored)) files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

namespace {

void add_folder(const fs::path& folder, std::set<fs::path>& seen, std::vector<fs::path>& found) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (error) throw UserError(folder, "cannot be read: " + error.message());
  if (!seen.insert(real).second) return;
  found.push_back(folder);

  std::vector<fs::path> below;
  fs::directory_iterator it(folder, error);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (it->is_directory(ignored)) below.push_back(it->path());
  }
  if (error) throw UserError(folder, "cannot be read: " + error.message());
  std::sort(below.begin(), below.end());
  for (const fs::path& child : below) add_folder(child, seen, found);
}

}  // namespace

std::vector<fs::path> folders_below(const fs::path& root) {
  std::set<fs::path> seen;
  std::vector<fs::path> found;
  add_folder(root, seen, found);
  return found;
}

}  // namespace mtstereo::eval
