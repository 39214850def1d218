// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "matcher/settings.hpp"

namespace mtstereo::test {

/// What the tests of all parameters need to know of one.
struct ParameterSample {
  const char* name;
  /// Valid values, from which the frames with random parameters are made; what is there more than
  /// once is more frequent. For images of any width, unless the test sets them.
  std::vector<std::string> values;
  /// With the parameters `base`, the value `other` changes the result.
  std::vector<std::pair<const char*, std::string>> base;
  const char* other;
  /// The parameter in Settings, and the value of 1 there. nullptr: it only selects defaults.
  double (*setting)(const Settings& settings);
  double unit = 1;
};

/// One for each parameter.
inline const std::vector<ParameterSample>& parameter_samples() {
  using S = const Settings&;
  using Base = decltype(ParameterSample::base);
  static const Base kPaper = {{"preset", "paper"}};
  // With costs that leave outliers, and with wrong disparities in the gaps.
  static const Base kOutliers = {{"preset", "paper"},
                                 {"cost-kernel-size", "1"},
                                 {"pixel-confidence", "0"},
                                 {"pixel-search-range", "100"},
                                 {"outlier-radius", "2"}};
  static const Base kWrongGaps = {{"large-step-penalty", "0"},
                                  {"range-penalty", "0"},
                                  {"pixel-confidence", "0"},
                                  {"left-right-tolerance", "-1"},
                                  {"max-gap", "30"}};
  // clang-format off
  static const std::vector<ParameterSample> kSamples = {
      {"preset", {"default", "fast", "paper"}, {}, "paper", nullptr},
      {"mode", {"sparse", "semi-dense", "dense", "full"}, {}, "sparse", [](S s) { return 1.0 * static_cast<int>(s.mode); }},
      {"max-disparity", {"1", "64", "77"}, {}, "15", [](S s) { return 1.0 * s.view_disparities; }},
      {"min-disparity", {"-9", "0", "9"}, {}, "12", [](S s) { return 1.0 * s.min_disparity; }},
      {"resolution", {"full", "full", "half", "half-refined"}, {}, "half", [](S s) { return 1.0 * static_cast<int>(s.resolution); }},
      {"threads", {"1", "2", "3"}, {}, "3", [](S s) { return 1.0 * s.threads; }},
      {"noise-filter", {"true", "false"}, {}, "false", [](S s) { return 1.0 * s.noise_filter; }},
      {"gray-levels", {"2", "8", "16", "37", "256"}, kPaper, "3", [](S s) { return 1.0 * s.gray_levels; }},
      {"min-node-width", {"0", "0", "1", "2"}, kPaper, "3", [](S s) { return 1.0 * s.min_node_width; }},
      {"max-node-width", {"0.5", "0.5", "0.4", "1"}, kPaper, "0.05", [](S s) { return s.max_node_width; }},
      {"node-levels", {"1,0", "1,0", "0", "2,0", "2,1,0", "5,3,0", "9,0"}, kPaper, "0", [](S s) { return 1.0 * s.node_levels.count; }},
      {"max-neighbors", {"10", "0", "1", "3", "25"}, kPaper, "3", [](S s) { return 1.0 * s.max_neighbors; }},
      {"cost", {"census", "census", "gradient"}, {}, "gradient", [](S s) { return 1.0 * static_cast<int>(s.cost); }},
      {"cost-kernel-size", {"21", "1", "3", "9", "41"}, kPaper, "3", [](S s) { return 1.0 * s.cost_kernel_size; }},
      {"cost-volume", {"half", "full"}, kPaper, "full", [](S s) { return 1.0 * static_cast<int>(s.cost_volume); }},
      {"intensity-weight", {"0.8", "0", "0.5", "1"}, kPaper, "0.2", [](S s) { return 1.0 * s.intensity_weight; }},
      {"node-confidence", {"12", "0", "0", "3"}, kPaper, "3", [](S s) { return 1.0 * s.node_confidence; }, 0.01},
      {"outlier-radius", {"21", "0", "1", "6", "31"}, kPaper, "3", [](S s) { return 1.0 * s.outlier_radius; }},
      {"outlier-removal", {"nodes", "nodes-and-pixels"}, kOutliers, "nodes", [](S s) { return 1.0 * static_cast<int>(s.outlier_removal); }},
      {"census-scales", {"1", "2"}, {}, "1", [](S s) { return 1.0 * s.census_scales; }},
      {"census-kernel-size", {"5", "3", "1"}, {}, "3", [](S s) { return 1.0 * s.census_cost.kernel_size; }},
      {"pixel-search-range", {"15", "0", "60", "100"}, kPaper, "90", [](S s) { return s.search_range.range; }, 0.01},
      {"range-penalty", {"2", "0", "5", "24"}, {{"min-confidence", "0"}, {"large-step-penalty", "0"}}, "24", [](S s) { return 1.0 * s.census_cost.range_penalty; }},
      {"small-step-penalty", {"4", "0", "1", "50"}, {}, "3", [](S s) { return 1.0 * s.smoothness.small_step; }},
      {"large-step-penalty", {"30", "0", "3", "50"}, {}, "3", [](S s) { return 1.0 * s.smoothness.large_step; }},
      {"pixel-confidence", {"4", "0", "12"}, {}, "60", [](S s) { return s.selection.confidence; }, 0.01},
      {"runner-up", {"any", "expected"}, kPaper, "any", [](S s) { return 1.0 * s.selection.runner_up_in_range; }},
      {"left-right-tolerance", {"1", "-1", "0", "5"}, {}, "0", [](S s) { return 1.0 * s.selection.left_right_tolerance; }},
      {"subpixel", {"true", "false"}, {}, "false", [](S s) { return 1.0 * s.selection.subpixel; }},
      {"speckle-size", {"0", "0", "1", "5", "20"}, {}, "65535", [](S s) { return 1.0 * s.speckle_size; }},
      {"min-confidence", {"0", "0", "0", "40", "90", "200"}, {}, "3", [](S s) { return 1.0 * s.min_confidence; }},
      {"thin-objects", {"true", "false"}, kWrongGaps, "false", [](S s) { return 1.0 * s.thin_objects; }},
      {"node-end-width", {"3", "1", "9", "31"}, {{"preset", "paper"}, {"mode", "sparse"}}, "9", [](S s) { return 1.0 * s.node_end_width; }},
      {"max-gap", {"0", "1", "6", "30"}, {}, "0", [](S s) { return 1.0 * s.max_gap; }},
      {"smoothing-radius", {"0", "0", "1", "3", "31"}, {}, "3", [](S s) { return 1.0 * s.smoothing_radius; }},
      {"temporal", {"off", "hold", "filter"}, {}, "hold", [](S s) { return 1.0 * static_cast<int>(s.temporal); }},
  };
  // clang-format on
  return kSamples;
}

}  // namespace mtstereo::test
