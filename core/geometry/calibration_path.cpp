// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/calibration_path.hpp"

#include <sys/stat.h>

#include <cstddef>

namespace mtstereo {
namespace {

bool exists(const std::string& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0;
}

/// The text between commas, where `commas` are their places.
std::vector<std::string> parts_of(const std::string& text, const std::vector<std::size_t>& commas) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (const std::size_t comma : commas) {
    parts.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  parts.push_back(text.substr(begin));
  return parts;
}

bool all_exist(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (!exists(file)) return false;
  }
  return true;
}

/// Of several commas, those between files.
std::vector<std::string> split_files(const std::string& text) {
  std::vector<std::size_t> commas;
  for (std::size_t at = text.find(','); at != std::string::npos; at = text.find(',', at + 1)) {
    commas.push_back(at);
  }
  if (commas.empty() || exists(text)) return {text};
  for (const std::size_t comma : commas) {
    if (std::vector<std::string> two = parts_of(text, {comma}); all_exist(two)) return two;
  }
  for (std::size_t i = 0; i < commas.size(); ++i) {
    for (std::size_t j = i + 1; j < commas.size(); ++j) {
      std::vector<std::string> three = parts_of(text, {commas[i], commas[j]});
      if (all_exist(three)) return three;
    }
  }
  return parts_of(text, commas.size() == 2 ? commas : std::vector<std::size_t>{commas.front()});
}

}  // namespace

CalibrationPath split_calibration_path(const std::string& path) {
  CalibrationPath result;
  std::string files = path;
  const std::size_t mark = path.rfind('#');
  if (mark != std::string::npos && path.find('/', mark) == std::string::npos && !exists(path)) {
    files = path.substr(0, mark);
    result.selection = path.substr(mark + 1);
  }
  result.files = split_files(files);
  return result;
}

}  // namespace mtstereo
