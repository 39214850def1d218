// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/checks/check_figures.hpp"

#include <algorithm>
#include <opencv2/core.hpp>
#include <utility>

#include "alignment/sharpness.hpp"
#include "lib/median.hpp"
#include "recordings/matching/map_files.hpp"
#include "recordings/matching/matching_run.hpp"
#include "recordings/matching/prepare_pairs.hpp"
#include "recordings/matching/recorded_views.hpp"
#include "recordings/matching/view_correction.hpp"
#include "recordings/media/sample_frames.hpp"

namespace mtstereo::run {
namespace {

constexpr std::size_t kModePairs = 4;  // that are matched in each mode
constexpr int kSaturatedGray = 250;    // [gray values]
constexpr double kBrightShare = 0.95;  // of the pixels
constexpr double kHalfIfBelow = 0.5;   // density: half the resolution may find more

// The gray values of some frames of one view.
class GrayValues {
 public:
  void add(const cv::Mat& view) {
    for (int y = 0; y < view.rows; ++y) {
      const auto* row = view.ptr<std::uint8_t>(y);
      for (int x = 0; x < view.cols; ++x) ++counts_[row[x]];
    }
    noises_.push_back(noise_of(view_of(view), scratch_));
  }

  ViewFigures figures() const {
    ViewFigures figures;
    double pixels = 0, sum = 0, saturated = 0;
    for (std::size_t value = 0; value < counts_.size(); ++value) {
      const auto count = static_cast<double>(counts_[value]);
      pixels += count;
      sum += count * static_cast<double>(value);
      if (value >= kSaturatedGray) saturated += count;
    }
    if (pixels == 0) return figures;
    figures.mean = sum / pixels;
    figures.saturated = saturated / pixels;
    figures.noise = median(noises_);
    double below = 0;
    std::size_t value = 0;
    while (below + static_cast<double>(counts_[value]) < kBrightShare * pixels) {
      below += static_cast<double>(counts_[value++]);
    }
    figures.bright = static_cast<double>(value);
    return figures;
  }

 private:
  std::array<std::int64_t, 256> counts_{};
  std::vector<double> noises_;
  SharpnessScratch scratch_;
};

std::array<ViewFigures, 2> measure_views(const Work& work) {
  RecordedViews views(work, kLargestImageSide);
  GrayValues left, right;
  for (const std::int64_t pair : sample_pairs(static_cast<std::int64_t>(work.pairs.pairs.size()))) {
    const FramePair frames = frames_of(work, pair);
    left.add(views.left(frames.left));
    right.add(views.right(frames.right));
  }
  return {left.figures(), right.figures()};
}

// Some of the sampled pairs.
std::vector<std::int64_t> mode_pairs(const Work& work) {
  const auto all = sample_pairs(static_cast<std::int64_t>(work.pairs.pairs.size()));
  const std::size_t step = (all.size() + kModePairs - 1) / kModePairs;
  std::vector<std::int64_t> some;
  for (std::size_t i = step / 2; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

ModeFigures match(const Work& work, const std::string& name, const std::string& mode,
                  const std::string& resolution) {
  Work matched = work;
  auto& parameters = matched.options.parameters;
  std::erase_if(parameters, [&](const auto& each) {
    return each.first == "mode" || (!resolution.empty() && each.first == "resolution");
  });
  parameters.emplace_back("mode", mode);
  const bool rated = matcher_parameters(matched.options).text(Parameter::kCost) == "census";
  if (!resolution.empty()) parameters.emplace_back("resolution", resolution);
  MatchingRun run(matched, mode_pairs(work), map_pipeline(matched), 1);
  std::vector<double> densities, wrong, times, details;
  while (const std::optional<PairResult> result = run.next()) {
    FrameFigures figures;
    measure_map(result->map.get(), figures);
    densities.push_back(figures.density);
    times.push_back(result->matching_ms);
    if (result->fine_detail > 0) details.push_back(result->fine_detail);
    const std::optional<double> stated = stated_errors(result->map.get());
    if (rated && stated) wrong.push_back(*stated);
  }
  ModeFigures figures{name, median(densities), std::nullopt, median(times), median(details)};
  if (!wrong.empty()) figures.wrong = median(wrong);
  return figures;
}

void measure_modes(CheckFigures& figures) {
  const Work& work = figures.work;
  figures.modes.push_back(match(work, "sparse", "sparse", ""));
  // resolution=auto measures the detail, and begins at full resolution.
  const bool full = matcher_parameters(work.options).text(Parameter::kResolution) == "full";
  figures.modes.push_back(match(work, kSemiDense, kSemiDense, full ? "auto" : ""));
  const ModeFigures usual = figures.modes.back();
  if (full && usual.density < kHalfIfBelow) {
    figures.modes.push_back(match(work, kHalfRefined, kSemiDense, "half-refined"));
  }
  figures.modes.push_back(match(work, "dense", "dense", ""));
}

}  // namespace

const ModeFigures* CheckFigures::mode(const std::string& name) const {
  const auto found = std::find_if(modes.begin(), modes.end(),
                                  [&](const ModeFigures& each) { return each.name == name; });
  return found == modes.end() ? nullptr : &*found;
}

CheckFigures measure(const Recording& recording, const WorkOptions& options,
                     const std::optional<ClockRelation>& relation, bool estimate) {
  CheckFigures figures;
  Work& work = figures.work;
  WorkOptions checked = options;
  checked.products.clear();
  figures.range_given =
      !finds_range(options) &&
      (recording.max_disparity || matcher_parameters(options).is_set(Parameter::kMaxDisparity));
  if (!figures.range_given && !finds_range(options)) {
    checked.parameters.emplace_back("max-disparity", "auto");
  }
  work = prepare_pairs(recording, checked, relation, estimate);
  figures.range = search_range(work);
  if (!figures.range_given) {
    const int usual = Parameters().integer(Parameter::kMaxDisparity);
    set_range(work, figures.range ? figures.range->max_disparity : usual);
    complete_options(work);
  }
  figures.inspection = inspect_views(work);
  figures.diagnosis = diagnose_views(work, figures.inspection);
  figures.views = measure_views(work);
  figures.corrected = is_corrected(work.options);
  work.correction = {{"alignment", "off"}};
  if (figures.corrected) work.correction = correction_of(figures.inspection);
  if (figures.diagnosis.worthless() && figures.diagnosis.problem != ViewProblem::kOutOfStep) {
    return figures;
  }
  figures.times = check_clocks(work);
  if (!figures.diagnosis.worthless()) measure_modes(figures);
  return figures;
}

}  // namespace mtstereo::run
