// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/view_samples.hpp"

#include <algorithm>

#include "lib/outputs/user_error.hpp"
#include "recordings/clocks/gray_frames.hpp"
#include "recordings/inputs/halves.hpp"
#include "recordings/inputs/view_match.hpp"
#include "recordings/matching/view_geometry.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

constexpr std::int64_t kMostSamples = 4;

// The views of a recording by the numbers of their frames.
class SmallViews {
 public:
  explicit SmallViews(const Work& work)
      : recording_(work.recording),
        left_(work.recording.left, work.left, width_of(work.recording)) {
    if (recording_.arrangement == Arrangement::kTwoSources) {
      right_.emplace(work.recording.right, work.right, kMatchedWidth);
    }
  }

  cv::Mat left(std::int64_t number) { return right_ ? left_.at(number) : half(number, 0); }
  cv::Mat right(std::int64_t number) { return right_ ? right_->at(number) : half(number, 1); }

 private:
  static int width_of(const Recording& recording) {
    return recording.arrangement == Arrangement::kSideBySide ? 2 * kMatchedWidth : kMatchedWidth;
  }
  cv::Mat half(std::int64_t number, int side) {
    const cv::Mat both = left_.at(number);
    if (both.empty()) return {};
    return half_of(both, recording_.arrangement, recording_.swapped ? 1 - side : side);
  }

  const Recording& recording_;
  GrayFrames left_;
  std::optional<GrayFrames> right_;
};

ViewSample read_sample(SmallViews& views, FramePair pair, const std::vector<int>& shifts) {
  ViewSample sample;
  sample.left = views.left(pair.left);
  sample.right = views.right(pair.right);
  for (const int frames : shifts) {
    sample.shifted.push_back({frames, views.right(pair.right + frames)});
  }
  return sample;
}

}  // namespace

ViewSamples read_view_samples(const Work& work, const std::vector<int>& shifts) {
  const Recording& recording = work.recording;
  const ViewSize size = view_size(work);
  ViewSamples result;
  result.scale = std::max(1.0, static_cast<double>(size.width) / kMatchedWidth);
  const Parameters parameters = matcher_parameters(work.options);
  result.max_disparity = parameters.integer(Parameter::kMaxDisparity);
  result.min_disparity = parameters.integer(Parameter::kMinDisparity);
  if (!recording.rectified && !recording.calibration.empty()) {
    const auto calibration = read_calibration(recording.calibration, size.width, size.height);
    if (!calibration) throw UserError(calibration.error().message);
    result.calibration = *calibration;
  }
  SmallViews views(work);
  const auto pairs = static_cast<std::int64_t>(work.pairs.pairs.size());
  const std::int64_t count = std::min(pairs, kMostSamples);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t number = (2 * i + 1) * pairs / (2 * count);
    FramePair pair = work.pairs.pairs[static_cast<std::size_t>(number)];
    if (recording.arrangement != Arrangement::kTwoSources) pair.right = pair.left;
    ViewSample sample = read_sample(views, pair, shifts);
    if (!sample.left.empty() && !sample.right.empty()) {
      result.samples.push_back(std::move(sample));
    }
  }
  return result;
}

}  // namespace mtstereo::run
