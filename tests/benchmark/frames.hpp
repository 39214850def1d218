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

/// The rendered street at a time [s] of the scene: the same bytes in every run.
Pair render_street(int width, int height, double time = 1);

GrayView view_of(const cv::Mat& image);

/// A pair to be matched. Its images are created on first use, so that frames excluded by a filter
/// cost nothing.
class Frame {
 public:
  /// A rendered frame.
  Frame(int width, int height, int disparities);
  /// The pair of KITTI 2015 with this name below a folder. Throws mtstereo::UserError if it is
  /// missing.
  static Frame kitti(const std::string& folder, const std::string& name, int disparities);

  const std::string& name() const { return name_; }  ///< such as "street-640x480-64"
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

/// The frames of a run: one for `quick`, else the sizes of docs/benchmark.md and the real pair if
/// `data` names a folder that contains it; if not, a note is printed on the standard error.
std::vector<FramePointer> frames(bool quick, const char* data);

/// The frame for the measurements that are made on one frame only.
FramePointer main_frame(const std::vector<FramePointer>& all);

}  // namespace mtstereo::bench
