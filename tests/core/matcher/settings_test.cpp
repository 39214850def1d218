// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/settings.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "parameters/choices.hpp"
#include "support/matching.hpp"
#include "support/parameter_samples.hpp"

namespace mtstereo::settings_test {
namespace {

/// The expected value of what is derived from a parameter.
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
    {"mode", "full", 1, [](const Settings& s) { return s.by_paths(); }},
    {"mode", "dense", 1, [](const Settings& s) { return s.by_paths(); }},
    {"mode", "semi-dense", 1, [](const Settings& s) { return s.by_paths(); }},
    {"mode", "sparse", 1, [](const Settings& s) { return s.by_paths(); }},
    {"cost", "gradient", 0, [](const Settings& s) { return s.by_paths(); }},
    {"preset", "fast", 1, [](const Settings& s) { return s.by_paths(); }},
    {"preset", "paper", 0, [](const Settings& s) { return s.by_paths(); }},
    {"mode", "sparse", 0, [](const Settings& s) { return column_paths(s, 0); }},
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
    {"node-levels", "7,2,0", 2, [](const Settings& s) { return s.node_levels.level[1]; }},
    {"census-kernel-size", "3", 60, [](const Settings& s) { return s.selection.ratio_offset; }},
};

TEST(Settings, HaveEachParameterInItsUnit) {
  for (const test::ParameterSample& sample : test::parameter_samples()) {
    if (sample.setting == nullptr) continue;
    for (const std::string& value : sample.values) {
      const Parameters parameters = test::parameters({{sample.name, value}});
      const double number = parameters.get(find_parameter(sample.name)->id);
      EXPECT_FLOAT_EQ(static_cast<float>(number * sample.unit),
                      static_cast<float>(sample.setting(Settings(parameters))))
          << sample.name << " = " << value;
    }
  }
}

TEST(Settings, SamplesAreThoseOfTheTable) {
  const auto& samples = test::parameter_samples();
  ASSERT_EQ(static_cast<std::size_t>(kParameters), samples.size());
  for (int i = 0; i < kParameters; ++i) EXPECT_STREQ(parameter_table()[i].name, samples[i].name);
}

TEST(Settings, DeriveOtherValuesFromParameters) {
  for (const Mapping& mapping : kMappings) {
    const Settings settings(test::parameters({{mapping.name, mapping.text}}));
    EXPECT_FLOAT_EQ(static_cast<float>(mapping.expected),
                    static_cast<float>(mapping.field(settings)))
        << mapping.name << " = " << mapping.text;
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

TEST(Settings, DrawOnlyTheEndsOfNodesInModeSparse) {
  const auto width = [](const char* mode) {
    return Settings(
               test::parameters({{"mode", mode}, {"cost", "gradient"}, {"node-end-width", "7"}}))
        .drawn_end_width();
  };
  EXPECT_EQ(7, width("sparse"));
  EXPECT_EQ(0, width("semi-dense"));
}

TEST(Settings, TrustTheLastMapLessAsTheNoiseGrowsInModeSemiDense) {
  const Settings settings((Parameters()));
  const int usual = settings.least_reliability();
  EXPECT_EQ(usual - 20, settings.least_confidence(0).known);
  EXPECT_EQ(usual - 20, settings.least_confidence(6.5F).known);
  EXPECT_EQ(usual - 10, settings.least_confidence(7.75F).known);
  EXPECT_EQ(usual, settings.least_confidence(9).known);
  EXPECT_EQ(usual, settings.least_confidence(100).known);
  EXPECT_EQ(settings.least_confidence(0).fresh, settings.least_confidence(100).fresh);
  const Settings dense(test::parameters({{"mode", "dense"}}));
  EXPECT_EQ(dense.least_reliability() - 20, dense.least_confidence(100).known);
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

template <typename... Enums>
void expect_choices(std::tuple<Enums...>*) {
  (expect_choice<Enums>(), ...);
}

TEST(Choices, EnumValuesAreTheIndicesOfTheWordsInTheTable) {
  expect_choices(static_cast<Choices*>(nullptr));
}

}  // namespace
}  // namespace mtstereo::settings_test
