// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/range_search.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/map_files.hpp"
#include "recordings/matching/matching_run.hpp"
#include "recordings/matching/view_inspection.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

constexpr const char* kRangeProperty = "max-disparity";
constexpr int kStep = 16;              // ranges are multiples of it [px]
constexpr double kShare = 0.998;       // of the disparities of a pair: the others may be wrong
constexpr double kMargin = 1.1;        // nearer things between the pairs that are matched
constexpr int kReliable = 170;         // confidence
constexpr double kLeastDensity = 0.1;  // of views that match

// Half of the width: beyond it, most of a view has no counterpart.
int widest(const Work& work) {
  const int width = work.geometry ? work.geometry->views.width : view_size(work).width;
  return std::clamp(width / 2 / kStep * kStep, kStep, kLargestMaxDisparity / kStep * kStep);
}

Work inspected(const Work& work, int range) {
  Work copy = work;
  copy.options.products.clear();
  copy.options.parameters = {
      {kRangeProperty, std::to_string(range)}, {"resolution", "half"}, {"disparity-scale", "16"}};
  const std::string smallest = property_of(work.options, "min-disparity");
  if (!smallest.empty()) copy.options.parameters.emplace_back("min-disparity", smallest);
  const bool off = property_of(work.options, "alignment") == "off";
  copy.correction = {{"alignment", off ? "off" : "correct"}};
  if (!off) copy.correction.emplace_back("alignment-interval", "1");
  return copy;
}

}  // namespace

bool finds_range(const WorkOptions& options) {
  return is_range_to_find(property_of(options, kRangeProperty));
}

std::optional<FoundRange> search_range(const Work& work) {
  const int widest_range = widest(work);
  const Work searched = inspected(work, widest_range);
  const auto pairs = static_cast<std::int64_t>(work.pairs.pairs.size());
  MatchingRun run(searched, sample_pairs(pairs), map_pipeline(searched), 1);
  FoundRange found;
  bool any = false;
  while (const std::optional<PairResult> result = run.next()) {
    any = true;
    FrameFigures figures;
    measure_map(result->map.get(), figures);
    if (figures.density < kLeastDensity) continue;
    const double largest = disparity_below(result->map.get(), kShare);
    found.largest = found.pairs == 0 ? largest : std::max(found.largest, largest);
    found.reliable =
        std::max(found.reliable, disparity_below(result->map.get(), kShare, kReliable));
    ++found.pairs;
  }
  if (!any) throw UserError(work.recording.name + ": " + run.damage());
  if (found.pairs == 0) return std::nullopt;
  const double needed = std::max(found.largest, 1.0) * kMargin;
  found.max_disparity = std::min(static_cast<int>(std::ceil(needed / kStep)) * kStep, widest_range);
  return found;
}

void set_range(Work& work, int max_disparity) {
  auto& parameters = work.options.parameters;
  std::erase_if(parameters, [](const auto& each) { return each.first == kRangeProperty; });
  parameters.emplace_back(kRangeProperty, std::to_string(max_disparity));
}

void find_range(Work& work) {
  const std::optional<FoundRange> found = search_range(work);
  if (!found) {
    std::erase_if(work.options.parameters,
                  [](const auto& each) { return each.first == kRangeProperty; });
    work.remarks.emplace_back(
        "The range of disparities cannot be found: the views do not match. The default range is "
        "used; --max-disparity sets another one.");
    return;
  }
  set_range(work, found->max_disparity);
  work.remarks.push_back(outputs::format(
      "max-disparity is %d: 99.8 %% of the disparities in %d pairs are below %.1f px.",
      found->max_disparity, found->pairs, found->largest));
}

}  // namespace mtstereo::run
