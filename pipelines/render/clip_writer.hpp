// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "render/render.hpp"

namespace mtstereo::render {

/// The layout of the output folder.
enum class Layout {
  kClip,        ///< left/000000.png, right/, truth/000000.pfm, mask/ and one calib.txt
  kViews,       ///< left/000000.png and right/ only
  kMiddlebury,  ///< one folder per frame: im0.png, im1.png, disp0GT.pfm, mask0nocc.png, calib.txt
};

/// Writes rendered frames to disk. Masks have Middlebury's values: 255 = visible in both views, 128
/// = only in the left one, 0 = no ground truth. Every call throws std::runtime_error, naming the
/// file and the reason, if something cannot be written.
class ClipWriter {
 public:
  /// Creates the folder. A folder that is not empty is an error unless `overwrite` is set; then the
  /// files of an earlier clip (the names above, nothing else) are removed first. `with_depth`: the
  /// layout kClip also has depth/000000.pfm, the true depths [m].
  ClipWriter(std::filesystem::path folder, Layout layout, bool overwrite, bool with_depth = false);

  /// Writes frame `number` (0, 1, ...); truth and mask are those of this rectified pair, and left
  /// out by kViews.
  void write(int number, const StereoFrame& frame, const Rectification& rectification);

  /// Writes the clip's calib.txt, whose range covers all frames written.
  void finish(const Rectification& rectification);

  /// The search range that covers all frames written so far [px].
  int disparities() const;

 private:
  std::filesystem::path folder_;
  Layout layout_;
  bool with_depth_;
  double largest_ = 0;  // largest disparity of all frames [px]
};

/// The place of the board in one frame.
struct FramePose {
  bool rests = true;       ///< it does not move
  Eigen::Isometry3d pose;  ///< from the board to the left camera
};

/// Writes one line per frame: number, 1 at rest or 0, rotation vector [rad] and position of the
/// board's center [m]. Throws like ClipWriter.
void write_poses(const std::filesystem::path& file, const std::vector<FramePose>& poses);

/// Writes a CV_32FC1 image as little-endian PFM. Throws like ClipWriter.
void write_pfm(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace mtstereo::render
