// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/work_key.hpp"

#include <glib.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "lib/outputs/json_text.hpp"
#include "recordings/inputs/recording_files.hpp"
#include "recordings/matching/json_files.hpp"
#include "recordings/plan/whole_folder.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

std::string checksum_of(const std::string& text) {
  char* const sum = g_compute_checksum_for_string(G_CHECKSUM_SHA256, text.c_str(), -1);
  std::string result = sum;
  g_free(sum);
  return result;
}

std::int64_t size_of(const fs::path& file) {
  std::error_code missing;
  const std::uintmax_t size = fs::file_size(file, missing);
  return missing ? -1 : static_cast<std::int64_t>(size);
}

}  // namespace

WorkKey work_key(const Recording& recording, const std::string& settings) {
  WorkKey key;
  std::ostringstream all;
  all << MTSTEREO_VERSION << '\n'
      << settings << '\n'
      << outputs::text_of(recording_json(recording)) << '\n';
  for (const fs::path& file : recording_files(recording)) {
    key.sizes.push_back(size_of(file));
    std::error_code missing;
    const fs::file_time_type time = fs::last_write_time(file, missing);
    all << key.sizes.back() << ' ' << (missing ? 0 : time.time_since_epoch().count()) << '\n';
  }
  key.all = checksum_of(all.str());
  return key;
}

fs::path changed_file(const Recording& recording, const WorkKey& key) {
  const std::vector<fs::path> files = recording_files(recording);
  const std::size_t known = std::min(files.size(), key.sizes.size());
  for (std::size_t i = 0; i < known; ++i) {
    if (size_of(files[i]) != key.sizes[i]) return files[i];
  }
  return {};
}

void write_key(const WorkKey& key, const fs::path& file) {
  std::string text = key.all + "\n";
  for (const std::int64_t size : key.sizes) text += std::to_string(size) + "\n";
  write_aside(file, text);
}

WorkKey read_key(const fs::path& file) {
  WorkKey key;
  std::ifstream in(file);
  in >> key.all;
  for (std::int64_t size = 0; in >> size;) key.sizes.push_back(size);
  return key;
}

}  // namespace mtstereo::run
