// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "recordings/media/frame_index.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::run {

/// The frames that one camera of a rendered scene records.
struct Shooting {
  render::Scene scene;
  bool right = false;
  double start = 0;  ///< time of the first frame [s]
  double rate = 12;  ///< frames per second
  int frames = 0;
  cv::Size size{160, 90};
};

/// Frames with the times that their recorder states: equal steps from 0 on.
struct Shot {
  std::vector<cv::Mat> frames;
  double rate = 12;  ///< nominal
};

/// Renders the frames in gray, with noise of one gray value.
Shot shoot(const Shooting& shooting);

/// The same frames after a change of each one by its number.
Shot changed(const Shot& shot, const std::function<cv::Mat(int, const cv::Mat&)>& change);
/// With a factor for the brightness and noise of this standard deviation.
Shot degraded(const Shot& shot, double factor, double noise);

/// Writes the frames as images.
Source write_images(const Shot& shot, const std::filesystem::path& folder);
/// Writes the frames as H.264 in MP4 with this bit rate [kbit/s].
Source write_video(const Shot& shot, const std::filesystem::path& file, int bitrate);

}  // namespace mtstereo::run
