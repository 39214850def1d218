// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/recording_files.hpp"

#include <string>

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

// The files of "FILE", "FILE,FILE" or "FILE#SELECTION".
void add_calibration(const std::string& calibration, std::vector<fs::path>& files) {
  const std::size_t comma = calibration.find(',');
  std::error_code error;
  if (calibration.empty()) return;
  if (comma != std::string::npos && !fs::exists(calibration, error)) {
    files.emplace_back(calibration.substr(0, comma));
    files.emplace_back(calibration.substr(comma + 1));
  } else {
    const bool whole = fs::exists(calibration, error);
    files.emplace_back(whole ? calibration : calibration.substr(0, calibration.find('#')));
  }
}

}  // namespace

std::vector<fs::path> recording_files(const Recording& recording) {
  std::vector<fs::path> files;
  for (const Source* source : {&recording.left, &recording.right}) {
    if (!source->video.empty()) files.push_back(source->video);
    files.insert(files.end(), source->images.begin(), source->images.end());
  }
  add_calibration(recording.calibration, files);
  return files;
}

}  // namespace mtstereo::run
