// SPDX-License-Identifier: LGPL-2.1-or-later
#include "frame_matcher.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

#include "stages/prepare/halving.hpp"

namespace mtstereo {
namespace {

int thread_count(const Settings& settings) {
  if (settings.threads > 0) return settings.threads;
  return std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
}

/// The counter is as wide as the disparities, 32 bits, so that compilers vectorize the loop.
int known_pixels(const std::int32_t* row, int width) {
  int known = 0;
  for (int x = 0; x < width; ++x) known += row[x] != kNoDisparity;
  return known;
}

}  // namespace

void FrameMatcher::set(const Settings& settings) {
  settings_ = settings;
  sized_ = false;
}

void FrameMatcher::resize(ImageSize input) {
  if (sized_ && size_.input == input) return;
  sized_ = false;
  size_.input = input;
  const ImageSize frame = {input.width - settings_.min_disparity, input.height};
  size_.frame = frame;
  size_.matched = settings_.half() ? ImageSize{half_of(frame.width), half_of(frame.height)} : frame;
  size_.threads = thread_count(settings_);
  if (!pool_ || pool_->threads() != size_.threads) {
    pool_.reset();
    pool_.emplace(size_.threads);
  }
  memory_.resize(settings_, size_);
  sized_ = true;
}

void FrameMatcher::compute(GrayView left, GrayView right, const Observer& observer) {
  disparity_ = {};
  confidence_ = {};
  resize({left.width, left.height});
  Views& views = memory_.views;
  views.left = left;
  views.noise_level = 0;
  views.input = {left, right};
  views.matched = views.input;
  if (settings_.half()) views.matched = {views.halves[0].view(), views.halves[1].view()};
  const Bands bands(*pool_, size_.matched.height);
  const Bands input_bands(*pool_, size_.frame.height);
  const StepContext context = {settings_, bands, input_bands};
  for (const Step& step : steps()) {
    if (!step.runs(settings_)) continue;
    step.run(context, memory_);
    if (observer) observer(step, memory_);
  }
  views.left = {};
  views.input = views.matched = {};  // the caller may free the input
  const auto result = callers_maps(settings_, memory_.maps, memory_.enlarged, memory_.output);
  disparity_ = result.disparity.view();
  confidence_ = result.confidence.view();
}

double FrameMatcher::density() {
  if (disparity_.height == 0) return 0;
  std::atomic<std::int64_t> known{0};
  Bands(*pool_, disparity_.height).rows([&](int y0, int y1, int) {
    std::int64_t in_band = 0;
    for (int y = y0; y < y1; ++y) in_band += known_pixels(disparity_.row(y), disparity_.width);
    known += in_band;
  });
  return static_cast<double>(known) / (static_cast<double>(disparity_.width) * disparity_.height);
}

}  // namespace mtstereo
