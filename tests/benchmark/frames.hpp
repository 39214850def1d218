// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "mtstereo/image.hpp"

namespace mtstereo::bench {

/// A rectified pair of 8-bit gray images.
struct Pair {
  cv::Mat left;
  cv::Mat right;
};

/// A street at a time [s] into the scene, rendered: the same bytes in every run.
Pair render_street(int width, int height, double time = 1);

GrayView view_of(const cv::Mat& image);

/// A pair to be matched. Its images are made when they are first asked for, so that those that a
/// filter leaves out cost nothing.
class Frame {
 public:
  /// A rendered one.
  Frame(int width, int height, int disparities);
  /// The pair of KITTI 2015 with this name below a folder. Throws eval::InputError where it is not.
  static Frame kitti(const std::string& folder, const std::string& name, int disparities);

  const std::string& name() const { return name_; }  ///< as in "street-640x480-64"
  int disparities() const { return disparities_; }
  const Pair& images() const;
  double megapixels() const { return images().left.total() * 1e-6; }

 private:
  Frame(std::string name, int disparities, Pair images);

  std::string name_;
  int disparities_;
  cv::Size size_;
  mutable Pair images_;
};

using FramePointer = std::shared_ptr<const Frame>;

/// The frames of a run: one for `quick`, else the sizes of docs/benchmark.md, and the real pair
/// where `data` names a folder that has it (a note on the standard error tells where it has not).
std::vector<FramePointer> frames(bool quick, const char* data);

/// The frame that the paper's and the other modes, and the single stages, are timed on.
FramePointer main_frame(const std::vector<FramePointer>& all);

}  // namespace mtstereo::bench
