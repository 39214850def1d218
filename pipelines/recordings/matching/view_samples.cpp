// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/view_samples.hpp"

#include <algorithm>

#include "recordings/inputs/view_match.hpp"
#include "recordings/matching/recorded_views.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

constexpr std::int64_t kMostSamples = 4;

ViewSample read_sample(RecordedViews& views, FramePair pair, const std::vector<int>& shifts) {
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
  const ViewSize size = view_size(work);
  ViewSamples result;
  result.scale = std::max(1.0, static_cast<double>(size.width) / kMatchedWidth);
  const Parameters parameters = matcher_parameters(work.options);
  result.max_disparity = parameters.integer(Parameter::kMaxDisparity);
  result.min_disparity = parameters.integer(Parameter::kMinDisparity);
  result.calibration = rectifying_calibration(work);
  RecordedViews views(work, kMatchedWidth);
  const auto pairs = static_cast<std::int64_t>(work.pairs.pairs.size());
  const std::int64_t count = std::min(pairs, kMostSamples);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t number = (2 * i + 1) * pairs / (2 * count);
    const FramePair pair = frames_of(work, number);
    ViewSample sample = read_sample(views, pair, shifts);
    if (!sample.left.empty() && !sample.right.empty()) {
      result.samples.push_back(std::move(sample));
    }
  }
  return result;
}

}  // namespace mtstereo::run
