// SPDX-License-Identifier: LGPL-2.1-or-later
// The K.txt of FoundationStereo: nine numbers of K in one line, and the baseline in meters in the
// next one. The views are rectified.
#include <string>
#include <vector>

#include "geometry/calibration_remarks.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {

StereoCalibration read_foundation_stereo(const Entry& file, const Request& request) {
  no_selection(file, request.selection);
  const std::vector<Entry> lines = file.list();
  constexpr std::size_t kLines = 2;
  if (lines.size() != kLines) {
    file.fail("K in the first line and the baseline in the second are needed; lines of numbers: " +
              std::to_string(lines.size()));
  }
  const Entry k(lines[0].value(), file.file(), "line 1");
  const Entry length(lines[1].value(), file.file(), "line 2");
  CameraCalibration camera;
  camera.width = request.width;
  camera.height = request.height;
  set_camera_matrix(camera, k);
  const double baseline = length.numbers(1, "the baseline in meters")[0];
  StereoCalibration calibration = rectified_pair({camera, k}, {camera, k}, baseline, length);
  calibration.format = "FoundationStereo";
  note_length(calibration, "write it in meters");
  return calibration;
}

}  // namespace mtstereo::formats
