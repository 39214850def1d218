// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include "calibrate/detection.hpp"
#include "calibrate/source.hpp"

namespace mtstereo::calibrate {

/// The folder of the results: calibration.yml, report.json, the views that were taken as files
/// that can be calibrated again (left/, right/), and pictures.
class OutputFolder {
 public:
  /// Creates the folder, and removes the views of an earlier calibration. Throws CalibrationError
  /// if there is a calibration already and `overwrite` is false.
  OutputFolder(std::filesystem::path folder, bool overwrite);

  /// Writes both images of a view, and a picture of them with their corners.
  void write_view(std::size_t index, const ImagePair& images, const CornerPair& corners) const;
  /// Reads the image of a view.
  cv::Mat view(std::size_t index, bool left) const;
  /// left/ and right/ change their names: the sources were given in the wrong order.
  void swap_sides() const;

  /// Writes a picture, unless it is empty.
  void write_picture(const std::string& name, const cv::Mat& picture) const;
  void write_text(const std::string& name, const std::string& text) const;
  std::filesystem::path calibration() const { return folder_ / "calibration.yml"; }

 private:
  std::filesystem::path folder_;
};

}  // namespace mtstereo::calibrate
