// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include "render/render.hpp"

namespace mtstereo::render {

/// How the frames lie in the output folder.
enum class Layout {
  kClip,        ///< left/000000.png, right/, truth/000000.pfm, mask/ and one calib.txt
  kMiddlebury,  ///< a folder a frame: im0.png, im1.png, disp0GT.pfm, mask0nocc.png, calib.txt
};

/// Writes rendered frames to disk. Masks are as Middlebury's: 255 = seen by both cameras, 128 = by
/// the left one alone, 0 = without ground truth. Every call throws std::runtime_error, naming the
/// file and the reason, when something cannot be written.
class ClipWriter {
 public:
  /// Makes the folder. One that holds something already is refused, unless `overwrite`: then what
  /// an earlier clip left in it (the names above, nothing else) is removed first.
  ClipWriter(std::filesystem::path folder, Layout layout, bool overwrite);

  /// Writes frame `number` (0, 1, ...); `settings` are complete()d ones.
  void write(int number, const StereoFrame& frame, const Settings& settings);

  /// Writes the clip's calib.txt, whose range covers all frames written.
  void finish(const Settings& settings);

  /// The search range that covers all frames written so far [px].
  int disparities() const;

 private:
  std::filesystem::path folder_;
  Layout layout_;
  double largest_ = 0;  // disparity of all frames [px]
};

/// Writes a CV_32FC1 image as little-endian PFM. Throws as above.
void write_pfm(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace mtstereo::render
