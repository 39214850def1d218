// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/outputs/listed_folder.hpp"
#include "tools/render/render.hpp"

namespace mtstereo::render {

/// The layout of the output folder.
enum class Layout {
  kClip,        ///< left/000000.png, right/, truth/000000.pfm, mask/ and one calib.txt
  kViews,       ///< left/000000.png and right/ only
  kMiddlebury,  ///< one folder per frame: im0.png, im1.png, disp0GT.pfm, mask0nocc.png, calib.txt
};

/// Writes rendered frames to disk. Masks have Middlebury's values: 255 = visible in both views, 128
/// = only in the left one, 0 = no ground truth. Every call throws std::runtime_error, naming the
/// file and the reason, if something cannot be written or is in the way.
class ClipWriter {
 public:
  /// Creates the folder. A folder that is not empty is an error unless `overwrite` is set; then the
  /// files that this program wrote into it before, and nothing else, are removed first.
  /// `with_depth`: the layout kClip also has depth/000000.pfm, the true depths [m]. `inputs`: files
  /// that must stay.
  ClipWriter(std::filesystem::path folder, Layout layout, bool overwrite, bool with_depth = false,
             const std::vector<std::filesystem::path>& inputs = {});

  /// Writes frame `number` (0, 1, ...); truth and mask are those of this rectified pair, and left
  /// out by kViews.
  void write(int number, const StereoFrame& frame, const Rectification& rectification);

  /// Writes the clip's calib.txt, whose range covers all frames written.
  void finish(const Rectification& rectification);

  /// The path of another file of the clip, such as "poses.txt", which the caller writes next.
  std::filesystem::path listed(const std::string& name) { return files_.listed(name); }

  /// The search range that covers all frames written so far [px].
  int disparities() const;

 private:
  void write_png(const std::string& name, const cv::Mat& image);

  Layout layout_;
  bool with_depth_;
  outputs::ListedFolder files_;
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
