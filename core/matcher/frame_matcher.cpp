// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/frame_matcher.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "matcher/fine_detail.hpp"
#include "stages/prepare/halving.hpp"

namespace mtstereo {
namespace {

int thread_count(const Settings& settings) {
  if (settings.threads > 0) return settings.threads;
  return std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
}

/// Pixels with a disparity have a confidence, which takes a quarter of the disparity's memory. The
/// counter of a block is as wide as a confidence, so that compilers vectorize the loop.
int known_pixels(const std::uint8_t* confidence, int width) {
  constexpr int kBlock = 255;  // what the counter can hold
  int known = 0;
  for (int first = 0; first < width; first += kBlock) {
    std::uint8_t in_block = 0;
    const int last = std::min(first + kBlock, width);
    for (int x = first; x < last; ++x) in_block += confidence[x] != 0;
    known += in_block;
  }
  return known;
}

double density(const GrayView& confidence) {
  std::int64_t known = 0;
  for (int y = 0; y < confidence.height; ++y) {
    known += known_pixels(confidence.row(y), confidence.width);
  }
  return static_cast<double>(known) / (static_cast<double>(confidence.width) * confidence.height);
}

}  // namespace

void FrameMatcher::set(const Settings& settings) {
  settings_ = settings;
  sized_ = false;
  if (settings_.chooses_resolution) {
    settings_.match_at(choice_.resolution());
  } else {
    choice_.restart();
  }
}

void FrameMatcher::restart() {
  choice_.restart();
  forget();
  set(settings_);
}

/// Sizes the memory for views of size_.input.
void FrameMatcher::size_memory(const Settings& settings) {
  const ImageSize frame = {size_.input.width - settings.min_disparity, size_.input.height};
  size_.frame = frame;
  size_.matched = settings.half() ? ImageSize{half_of(frame.width), half_of(frame.height)} : frame;
  memory_.resize(settings, size_);
}

void FrameMatcher::resize(ImageSize input) {
  if (sized_ && size_.input == input) return;
  sized_ = false;
  if (!(size_.input == input)) restart();  // another stream
  size_.input = input;
  size_.threads = thread_count(settings_);
  if (!pool_ || pool_->threads() != size_.threads) {
    pool_.reset();
    pool_.emplace(size_.threads);
  }
  if (settings_.chooses_resolution) {
    // Later changes of the resolution then allocate nothing.
    Settings other = settings_;
    other.match_at(settings_.half() ? Resolution::kFull : Resolution::kHalfRefined);
    size_memory(other);
  }
  size_memory(settings_);
  sized_ = true;
}

FrameResult FrameMatcher::compute(GrayView left, GrayView right, const Observer& observer) {
  const auto start = std::chrono::steady_clock::now();
  resize({left.width, left.height});
  Views& views = memory_.views;
  views.start(settings_, left, right);
  memory_.result.start(memory_.maps);
  FrameResult result = run_steps(observer);
  result.statistics.half_resolution = settings_.half();
  if (settings_.chooses_resolution) result.statistics.fine_detail = choose_resolution(result);
  result.statistics.density = density(result.confidence);
  views.release();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  result.statistics.milliseconds = took.count();
  return result;
}

FrameResult FrameMatcher::run_steps(const Observer& observer) {
  const Bands bands(*pool_, size_.matched.height);
  const Bands input_bands(*pool_, size_.frame.height);
  const StepContext context = {settings_, bands, input_bands};
  for_each_step(settings_, [&](const Step& step) {
    step.run(context, memory_);
    if (observer) observer(step, memory_);
  });
  return {memory_.result.disparity->view(), memory_.result.confidence->view(), {}};
}

/// Measures the detail of this pair and chooses the resolution of the next one. Returns the share
/// of fine detail, 0 if it is unknown.
double FrameMatcher::choose_resolution(const FrameResult& result) {
  const DetailViews compared = {memory_.views.left, memory_.views.input[1], result.disparity,
                                result.confidence, std::min(settings_.min_disparity, 0)};
  const Bands bands(*pool_, result.disparity.height);
  const std::optional<double> share = measure_detail(bands, compared).share();
  choice_.take(share);
  if (choice_.resolution() != settings_.resolution) {
    settings_.match_at(choice_.resolution());
    sized_ = false;
  }
  return share.value_or(0);
}

}  // namespace mtstereo
