// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/outputs/listed_folder.hpp"
#include "programs/calibrate/detection.hpp"
#include "programs/calibrate/source.hpp"

namespace mtstereo::calibrate {

/// The folder of the results: calibration.yml, report.json, the views that were taken as files
/// that can be calibrated again (left/, right/), and images.
class OutputFolder {
 public:
  /// Creates and locks the folder. Throws UserError if there is a calibration already and
  /// `overwrite` is false, and UserError if files that mtcalibrate did not write, or `inputs`,
  /// are in the way. The files of an earlier calibration are removed when the first view is taken.
  OutputFolder(std::filesystem::path folder, bool overwrite,
               const std::vector<std::filesystem::path>& inputs);

  /// Writes both images of a view, and one image of both with their corners.
  void write_view(std::size_t index, const ImagePair& images, const CornerPair& corners);
  /// Reads the image of a view.
  cv::Mat view(std::size_t index, bool left) const;
  /// left/ and right/ change their names: the sources were given in the wrong order.
  void swap_sides();

  /// Writes an image, unless it is empty.
  void write_image(const std::string& name, const cv::Mat& image);
  void write_text(const std::string& name, const std::string& text);
  /// The file of the calibration, which is about to be written.
  std::filesystem::path calibration();

 private:
  std::filesystem::path folder_;
  outputs::ListedFolder files_;
  std::size_t views_ = 0;
};

}  // namespace mtstereo::calibrate
