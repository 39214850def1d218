// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/settings.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "parameters/choices.hpp"
#include "parameters/parameter_text.hpp"
#include "support/matching.hpp"

namespace mtstereo {
namespace {

/// The expected value of a setting for a value of a parameter.
struct Mapping {
  const char* name;
  const char* text;
  double expected;
  std::function<double(const Settings&)> field;
};

double guided_margin(const Settings& settings, int level) {
  return settings.path_matching(level).selection.guided_margin;
}

double column_paths(const Settings& settings, int level) {
  return static_cast<int>(settings.path_matching(level).column_paths);
}

const Mapping kMappings[] = {
    {"mode", "sparse", 0, [](const Settings& s) { return static_cast<int>(s.mode); }},
    {"mode", "dense", 2, [](const Settings& s) { return static_cast<int>(s.mode); }},
    {"mode", "full", 3, [](const Settings& s) { return static_cast<int>(s.mode); }},
    {"mode", "full", 1, [](const Settings& s) { return s.by_paths(); }},
    {"mode", "dense", 1, [](const Settings& s) { return s.by_paths(); }},
    {"mode", "semi-dense", 1, [](const Settings& s) { return s.by_paths(); }},
    {"mode", "sparse", 0, [](const Settings& s) { return s.by_paths(); }},
    {"guide", "nodes", 0, [](const Settings& s) { return s.by_paths(); }},
    {"cost", "gradient", 0, [](const Settings& s) { return s.by_paths(); }},
    {"preset", "fast", 0, [](const Settings& s) { return s.by_paths(); }},
    {"mode", "semi-dense", 0, [](const Settings& s) { return column_paths(s, 0); }},
    {"mode", "semi-dense", 1, [](const Settings& s) { return column_paths(s, 1); }},
    {"mode", "dense", 2, [](const Settings& s) { return column_paths(s, 0); }},
    {"mode", "full", 2, [](const Settings& s) { return column_paths(s, 1); }},
    {"mode", "full", 0, [](const Settings& s) { return s.keeps_likely_only(); }},
    {"mode", "dense", 1, [](const Settings& s) { return s.keeps_likely_only(); }},
    {"mode", "semi-dense", 1, [](const Settings& s) { return s.keeps_likely_only(); }},
    {"mode", "semi-dense", 2, [](const Settings& s) { return guided_margin(s, 0); }},
    {"mode", "semi-dense", -1, [](const Settings& s) { return guided_margin(s, 1); }},
    {"mode", "full", -1, [](const Settings& s) { return guided_margin(s, 0); }},
    {"max-disparity", "77", 77,
     [](const Settings& s) { return s.path_matching(0).selection.disparities; }},
    {"max-disparity", "77", 10,
     [](const Settings& s) { return s.path_matching(3).selection.disparities; }},
    {"max-disparity", "77", 20,
     [](const Settings& s) { return s.path_matching(2).cost.disparities; }},
    {"range-penalty", "6", 6,
     [](const Settings& s) { return s.path_matching(0).cost.range_penalty; }},
    {"range-penalty", "6", 2,
     [](const Settings& s) { return s.path_matching(1).cost.range_penalty; }},
    {"max-disparity", "77", 77, [](const Settings& s) { return s.view_disparities; }},
    {"min-disparity", "-9", -9, [](const Settings& s) { return s.min_disparity; }},
    {"min-disparity", "-9", 73, [](const Settings& s) { return s.view_disparities; }},
    {"min-disparity", "9", 55, [](const Settings& s) { return s.disparities; }},
    {"min-disparity", "0", 0, [](const Settings& s) { return s.shifted(); }},
    {"min-disparity", "1", 1, [](const Settings& s) { return s.shifted(); }},
    {"max-disparity", "77", 77, [](const Settings& s) { return s.disparities; }},
    {"max-disparity", "77", 77, [](const Settings& s) { return s.search_range.disparities; }},
    {"max-disparity", "77", 77, [](const Settings& s) { return s.census_cost.disparities; }},
    {"max-disparity", "77", 77, [](const Settings& s) { return s.selection.disparities; }},
    {"resolution", "full", 0, [](const Settings& s) { return s.half(); }},
    {"resolution", "half", 1, [](const Settings& s) { return s.half(); }},
    {"resolution", "half", 0, [](const Settings& s) { return s.refined(); }},
    {"resolution", "half-refined", 1, [](const Settings& s) { return s.half() && s.refined(); }},
    {"resolution", "auto", 0, [](const Settings& s) { return s.half(); }},
    {"resolution", "auto", 1, [](const Settings& s) { return s.chooses_resolution; }},
    {"resolution", "full", 0, [](const Settings& s) { return s.chooses_resolution; }},
    {"resolution", "half", 32, [](const Settings& s) { return s.disparities; }},
    {"threads", "5", 5, [](const Settings& s) { return s.threads; }},
    {"noise-filter", "false", 0, [](const Settings& s) { return s.noise_filter; }},
    {"noise-filter", "true", 1, [](const Settings& s) { return s.noise_filter; }},
    {"gray-levels", "33", 33, [](const Settings& s) { return s.gray_levels; }},
    {"min-node-width", "4", 4, [](const Settings& s) { return s.min_node_width; }},
    {"max-node-width", "0.25", 0.25, [](const Settings& s) { return s.max_node_width; }},
    {"node-levels", "7,2,0", 3, [](const Settings& s) { return s.node_levels.count; }},
    {"node-levels", "7,2,0", 2, [](const Settings& s) { return s.node_levels.level[1]; }},
    {"max-neighbors", "21", 21, [](const Settings& s) { return s.max_neighbors; }},
    {"cost", "census", 1, [](const Settings& s) { return s.census(); }},
    {"cost", "gradient", 0, [](const Settings& s) { return s.census(); }},
    {"cost-kernel-size", "13", 13, [](const Settings& s) { return s.cost_kernel_size; }},
    {"cost-volume", "full", 1, [](const Settings& s) { return static_cast<int>(s.cost_volume); }},
    {"intensity-weight", "0.75", 0.75, [](const Settings& s) { return s.intensity_weight; }},
    {"node-confidence", "25", 0.25, [](const Settings& s) { return s.node_acceptance.confidence; }},
    {"outlier-radius", "9", 9, [](const Settings& s) { return s.outlier_radius; }},
    {"outlier-removal", "nodes-and-pixels", 1,
     [](const Settings& s) { return static_cast<int>(s.outlier_removal); }},
    {"census-scales", "1", 1, [](const Settings& s) { return s.census_scales; }},
    {"census-scales", "2", 2, [](const Settings& s) { return s.census_scales; }},
    {"census-kernel-size", "3", 60, [](const Settings& s) { return s.selection.ratio_offset; }},
    {"census-kernel-size", "3", 3, [](const Settings& s) { return s.census_cost.kernel_size; }},
    {"pixel-search-range", "30", 0.3, [](const Settings& s) { return s.search_range.range; }},
    {"between-nodes", "span", 1,
     [](const Settings& s) { return static_cast<int>(s.search_range.between_nodes); }},
    {"range-penalty", "6", 6, [](const Settings& s) { return s.census_cost.range_penalty; }},
    {"small-step-penalty", "7", 7, [](const Settings& s) { return s.smoothness.small_step; }},
    {"large-step-penalty", "8", 8, [](const Settings& s) { return s.smoothness.large_step; }},
    {"pixel-confidence", "50", 0.5, [](const Settings& s) { return s.selection.confidence; }},
    {"runner-up", "expected", 1, [](const Settings& s) { return s.selection.runner_up_in_range; }},
    {"runner-up", "any", 0, [](const Settings& s) { return s.selection.runner_up_in_range; }},
    {"left-right-tolerance", "-1", -1,
     [](const Settings& s) { return s.selection.left_right_tolerance; }},
    {"subpixel", "false", 0, [](const Settings& s) { return s.selection.subpixel; }},
    {"speckle-size", "123", 123, [](const Settings& s) { return s.speckle_size; }},
    {"min-confidence", "99", 99, [](const Settings& s) { return s.min_confidence; }},
    {"thin-objects", "false", 0, [](const Settings& s) { return s.thin_objects; }},
    {"node-end-width", "15", 15, [](const Settings& s) { return s.node_end_width; }},
    {"max-gap", "44", 44, [](const Settings& s) { return s.max_gap; }},
    {"smoothing-radius", "3", 3, [](const Settings& s) { return s.smoothing_radius; }},
};

TEST(Settings, ConvertEachParameterToItsUnit) {
  for (const Mapping& mapping : kMappings) {
    const Settings settings(test::parameters({{mapping.name, mapping.text}}));
    EXPECT_FLOAT_EQ(static_cast<float>(mapping.expected),
                    static_cast<float>(mapping.field(settings)))
        << mapping.name << " = " << mapping.text;
  }
}

TEST(Settings, MappingsCoverEveryParameter) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.id == Parameter::kPreset) continue;  // it only selects defaults
    const bool tested = std::any_of(
        std::begin(kMappings), std::end(kMappings),
        [&](const Mapping& mapping) { return std::string_view(mapping.name) == info.name; });
    EXPECT_TRUE(tested) << info.name;
  }
}

TEST(Settings, AreThoseOfTheResolutionThatIsChosen) {
  for (const char* const word : {"full", "half-refined", "half"}) {
    const Settings expected(test::parameters({{"resolution", word}, {"max-disparity", "77"}}));
    Settings chosen(test::parameters({{"resolution", "auto"}, {"max-disparity", "77"}}));
    chosen.match_at(Resolution::kHalf);  // what was chosen before leaves no trace
    chosen.match_at(expected.resolution);
    EXPECT_EQ(expected.half(), chosen.half()) << word;
    EXPECT_EQ(expected.refined(), chosen.refined()) << word;
    EXPECT_EQ(expected.disparities, chosen.disparities) << word;
    EXPECT_EQ(expected.search_range.disparities, chosen.search_range.disparities) << word;
    EXPECT_EQ(expected.census_cost.disparities, chosen.census_cost.disparities) << word;
    EXPECT_EQ(expected.selection.disparities, chosen.selection.disparities) << word;
  }
}

TEST(Settings, HalveTheDisparitiesAtHalfResolutionAndRoundUp) {
  for (const auto& [given, matched] : {std::pair{1, 1}, {2, 1}, {3, 2}, {64, 32}, {101, 51}}) {
    const Settings settings(
        test::parameters({{"resolution", "half"}, {"max-disparity", std::to_string(given)}}));
    EXPECT_EQ(given, settings.view_disparities);
    EXPECT_EQ(matched, settings.disparities);
    EXPECT_EQ(matched, settings.selection.disparities);
  }
}

TEST(Settings, KeepInferredPixelsInModeDenseOnly) {
  const auto least = [](const char* mode, const char* confidence) {
    return Settings(test::parameters({{"mode", mode}, {"min-confidence", confidence}}))
        .least_reliability();
  };
  EXPECT_EQ(0, least("dense", "0"));
  EXPECT_EQ(7, least("dense", "7"));
  EXPECT_EQ(kMostInferred + 1, least("semi-dense", "0"));
  EXPECT_EQ(kMostInferred + 1, least("semi-dense", "7"));
  EXPECT_EQ(150, least("semi-dense", "150"));
}

TEST(Settings, DrawOnlyTheEndsOfNodesInModeSparseWithTheGradientCost) {
  const auto settings = [](const char* mode, const char* cost) {
    return Settings(test::parameters({{"mode", mode}, {"cost", cost}, {"node-end-width", "7"}}));
  };
  EXPECT_EQ(7, settings("sparse", "gradient").drawn_end_width());
  EXPECT_EQ(0, settings("sparse", "census").drawn_end_width());
  EXPECT_EQ(0, settings("semi-dense", "gradient").drawn_end_width());
  EXPECT_TRUE(settings("sparse", "census").keeps_only_ends());
  EXPECT_FALSE(settings("sparse", "gradient").keeps_only_ends());
  EXPECT_FALSE(settings("dense", "census").keeps_only_ends());
}

/// Sets each word of a choice and compares the enum value with the index of the word.
template <typename Enum>
void expect_choice() {
  using Choice = ChoiceOf<Enum>;
  const ParameterInfo& info = parameter_info(Choice::kParameter);
  EXPECT_EQ(info.maximum + 1, Choice::kWords.size()) << info.name;
  for (std::size_t i = 0; i < Choice::kWords.size(); ++i) {
    Parameters parameters;
    ASSERT_TRUE(parameters.set(Choice::kParameter, Choice::kWords[i]).ok()) << Choice::kWords[i];
    EXPECT_EQ(static_cast<Enum>(i), choice<Enum>(parameters));
    EXPECT_EQ(Choice::kWords[i], parameters.text(Choice::kParameter));
  }
}

TEST(Choices, EnumValuesAreTheIndicesOfTheWordsInTheTable) {
  expect_choice<Preset>();
  expect_choice<Mode>();
  expect_choice<Resolution>();
  expect_choice<Cost>();
  expect_choice<CostVolumeResolution>();
  expect_choice<OutlierRemoval>();
  expect_choice<BetweenNodes>();
  expect_choice<RunnerUp>();
}

}  // namespace
}  // namespace mtstereo
