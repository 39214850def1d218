// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/recording_files.hpp"

#include <string>

#include "geometry/calibration_path.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

std::vector<fs::path> recording_files(const Recording& recording) {
  std::vector<fs::path> files;
  for (const Source* source : {&recording.left, &recording.right}) {
    if (!source->video.empty()) files.push_back(source->video);
    files.insert(files.end(), source->images.begin(), source->images.end());
  }
  if (recording.calibration.empty()) return files;
  for (const std::string& file : split_calibration_path(recording.calibration).files) {
    files.emplace_back(file);
  }
  return files;
}

}  // namespace mtstereo::run
