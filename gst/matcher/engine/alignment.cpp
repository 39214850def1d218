// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/alignment.hpp"

#include <algorithm>
#include <utility>

namespace mtstereo::plugin {
namespace {

/// Whether views of one size are the same image, by some rows. Two cameras never see the same, but
/// test images without content are equal.
bool are_one_image(GrayView left, GrayView right) {
  constexpr int kRows = 16;
  constexpr int kContent = 32;  // [gray values]
  std::uint8_t least = 255, most = 0;
  for (int i = 0; i < kRows; ++i) {
    const int y = left.height * i / kRows;
    const std::uint8_t *begin = left.row(y), *end = begin + left.width;
    if (!std::equal(begin, end, right.row(y))) return false;
    const auto [low, high] = std::minmax_element(begin, end);
    least = std::min(least, *low);
    most = std::max(most, *high);
  }
  return most - least >= kContent;
}

}  // namespace

Alignment AlignmentSettings::effective_alignment(Preset preset) const {
  return alignment.value_or(preset == Preset::kPaper ? Alignment::kOff : Alignment::kCorrect);
}

Sharpness AlignmentSettings::effective_sharpness(Preset preset) const {
  return sharpness.value_or(preset == Preset::kPaper ? Sharpness::kKeep : Sharpness::kMatch);
}

/// An inspection takes about as long for small frames as for large ones, and matching does not.
/// With these intervals inspections take at most 3 % of the time of matching on two cores.
int AlignmentSettings::effective_interval(Preset preset, int width, int height,
                                          int disparities) const {
  if (interval > 0) return interval;
  constexpr std::int64_t kShortest = 30, kLongest = 600;  // [pairs]
  // Matching work per inspection [px x disparities]
  const std::int64_t work = preset == Preset::kFast ? 4'000'000'000 : 1'100'000'000;
  const std::int64_t pair = std::int64_t{width} * height * disparities;
  return static_cast<int>(std::clamp(work / pair, kShortest, kLongest));
}

void PairAlignment::switch_off() {
  fresh_ = true;
  report_.problems = 0;
  report_.trusted = false;
  report_.applied = {};
}

/// Whether there is a stored field for frames of this size. Its first use determines its size.
bool PairAlignment::field_fits(const AlignmentSettings& settings, Size size) {
  if (settings.field_revision != field_revision_) {
    field_revision_ = settings.field_revision;
    field_size_ = {};
  }
  if (settings.field && field_size_ == Size{}) field_size_ = size;
  return settings.field && field_size_ == size;
}

/// The correction that was set.
ViewCorrection PairAlignment::held(const AlignmentSettings& settings, Size size) {
  switch_off();
  ViewCorrection correction;
  if (field_fits(settings, size)) correction.rows = *settings.field;
  correction.left_blur = settings.left_blur;
  correction.right_blur = settings.right_blur;
  report_.field = settings.field;
  report_.roll_degrees = correction.rows.roll_degrees(size.width);
  return correction;
}

/// Creates the tracker, and starts it over if the stream, the frame size or the stored field is a
/// new one.
Status PairAlignment::fit(const AlignmentSettings& settings, Size size) {
  const bool new_field = settings.field_revision != field_revision_;
  if (!fresh_ && !new_field && size == size_ && tracker_) return {};
  if (!tracker_) {
    Result<AlignmentTracker> made = AlignmentTracker::create();
    if (!made) return made.error();
    tracker_.emplace(std::move(made.value()));
  }
  if (new_field || size != size_) report_.field.reset();
  const bool restores = field_fits(settings, size);
  tracker_->reset();
  schedule_.restart();
  fresh_ = false;
  size_ = size;
  return restores ? tracker_->restore(*settings.field) : Status();
}

Status PairAlignment::inspect(const AlignmentSettings& settings, GrayView left, GrayView right,
                              const Parameters& parameters) {
  const int max_disparity = parameters.integer(Parameter::kMaxDisparity);
  const int min_disparity = parameters.integer(Parameter::kMinDisparity);
  Status status = fit(settings, {left.width, left.height});
  if (status) status = tracker_->watch(left, right);
  one_image_ = status && are_one_image(left, right);
  interval_ = settings.effective_interval(parameters.preset(), left.width, left.height,
                                          max_disparity - min_disparity);
  // The inspection of views that differ in sharpness takes three times as long.
  const bool differ = report_.findings.left_blur > 0 || report_.findings.right_blur > 0;
  if (differ && settings.interval == 0) interval_ *= 3;
  if (!status || !schedule_.due(interval_)) return status;
  status = tracker_->inspect(left, right, max_disparity, min_disparity);
  schedule_.inspected(tracker_->trusted());
  ++report_.inspections;
  return status;
}

void PairAlignment::update_report(int width) {
  const ViewCorrection& correction = tracker_->correction();
  report_.trusted = tracker_->trusted();
  if (report_.trusted) {
    report_.field = correction.rows;
    report_.roll_degrees = correction.rows.roll_degrees(width);
  }
  report_.findings = tracker_->findings();
  report_.problems = std::uint32_t{one_image_} << kOneImage;
  for (int problem = 0; problem < kPairProblems; ++problem) {
    if (tracker_->has(static_cast<PairProblem>(problem))) {
      report_.problems |= std::uint32_t{1} << problem;
    }
  }
}

Status PairAlignment::prepare(const AlignmentSettings& settings, GrayView left, GrayView right,
                              Matcher& matcher) {
  const Parameters& parameters = matcher.parameters();
  const Alignment alignment = settings.effective_alignment(parameters.preset());
  ViewCorrection correction;
  if (alignment == Alignment::kOff) {
    switch_off();
  } else if (alignment == Alignment::kHold) {
    correction = held(settings, {left.width, left.height});
  } else {
    const Status status = inspect(settings, left, right, parameters);
    if (!status) return status;
    update_report(left.width);
    if (alignment == Alignment::kCorrect) {
      correction = tracker_->correction();
      if (settings.effective_sharpness(parameters.preset()) == Sharpness::kKeep) {
        correction.left_blur = correction.right_blur = 0;
      }
    }
  }
  report_.applied = correction;
  report_.field_revision = settings.field_revision;
  return correction == matcher.correction() ? Status() : matcher.set_correction(correction);
}

}  // namespace mtstereo::plugin
