// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/recorded_views.hpp"

#include "recordings/inputs/halves.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {

RecordedViews::RecordedViews(const Work& work, int width)
    : recording_(work.recording),
      width_(width),
      left_(work.recording.left, work.left,
            recording_.arrangement == Arrangement::kSideBySide ? 2 * width : width) {
  if (recording_.arrangement == Arrangement::kTwoSources) {
    right_.emplace(work.recording.right, work.right, width);
  }
}

cv::Mat RecordedViews::left(std::int64_t number) {
  return right_ ? left_.at(number) : half(number, 0);
}

cv::Mat RecordedViews::right(std::int64_t number) {
  return right_ ? right_->at(number) : half(number, 1);
}

cv::Mat RecordedViews::half(std::int64_t number, int side) {
  const cv::Mat both = left_.at(number);
  if (both.empty()) return {};
  return half_of(both, recording_.arrangement, recording_.swapped ? 1 - side : side, width_);
}

FramePair frames_of(const Work& work, std::int64_t pair) {
  FramePair frames = work.pairs.pairs[static_cast<std::size_t>(pair)];
  if (work.recording.arrangement != Arrangement::kTwoSources) frames.right = frames.left;
  return frames;
}

std::optional<StereoCalibration> rectifying_calibration(const Work& work) {
  const ViewSize size = view_size(work);
  return rectifying_calibration(work.recording, size.width, size.height);
}

}  // namespace mtstereo::run
