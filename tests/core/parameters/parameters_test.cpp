// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/parameters.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/matching.hpp"

namespace mtstereo::parameters_test {
namespace {

/// The words of a choice; none for parameters of other types.
std::vector<std::string> choice_words(const ParameterInfo& info) {
  std::vector<std::string> words;
  if (info.type != ParameterType::kChoice) return words;
  for (std::string rest = std::string(info.choices) + "|"; !rest.empty();) {
    words.push_back(rest.substr(0, rest.find('|')));
    rest.erase(0, rest.find('|') + 1);
  }
  return words;
}

/// Valid values of a parameter, as text.
std::vector<std::string> valid_texts(const ParameterInfo& info) {
  std::vector<std::string> texts;
  for (const auto& of_modes : info.defaults)
    texts.insert(texts.end(), of_modes.begin(), of_modes.end());
  switch (info.type) {
    case ParameterType::kInteger:
      texts.push_back(std::to_string(static_cast<int>(info.minimum)));
      texts.push_back(std::to_string(static_cast<int>(info.maximum)));
      break;
    case ParameterType::kNumber:
      for (const double share : {0.0, 0.123456789, 0.5, 1.0}) {
        Parameters set;
        EXPECT_TRUE(set.set(info.id, info.minimum + share * (info.maximum - info.minimum)).ok());
        texts.push_back(set.text(info.id));
      }
      break;
    case ParameterType::kBoolean:
      for (const char* const text : {"true", "false", "0", "1"}) texts.push_back(text);
      break;
    case ParameterType::kChoice: {
      const std::vector<std::string> words = choice_words(info);
      texts.insert(texts.end(), words.begin(), words.end());
      break;
    }
    case ParameterType::kLevels:
      for (const char* const text : {"0", "63,0", "7,6,5,4,3,2,1,0", "2,1,0"})
        texts.push_back(text);
      break;
  }
  return texts;
}

TEST(ParameterTable, IsInTheOrderOfParameterAndHasUniqueNames) {
  std::set<std::string> names;
  int index = 0;
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(index++, static_cast<int>(info.id)) << info.name;
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(&info, &parameter_info(info.id));
    EXPECT_EQ(&info, find_parameter(info.name));
    EXPECT_EQ(std::string::npos,
              std::string(info.name).find_first_not_of("abcdefghijklmnopqrstuvwxyz-0123456789"))
        << info.name;
    EXPECT_NE('\0', *info.help) << info.name;
    EXPECT_LE(info.minimum, info.maximum) << info.name;
  }
  EXPECT_EQ(kParameters, index);
}

TEST(ParameterTable, DescribesEveryChoice) {
  for (const ParameterInfo& info : parameter_table()) {
    const std::vector<std::string> words = choice_words(info);
    ASSERT_LE(words.size(), info.choice_help.size()) << info.name;
    std::set<std::string> texts;
    for (std::size_t i = 0; i < info.choice_help.size(); ++i) {
      const char* const help = info.choice_help[i];
      if (i >= words.size()) {
        EXPECT_EQ(nullptr, help) << info.name << " has no choice " << i;
        continue;
      }
      ASSERT_NE(nullptr, help) << info.name << " = " << words[i];
      EXPECT_NE('\0', *help) << info.name << " = " << words[i];
      EXPECT_NE(words[i], help) << info.name;
      EXPECT_TRUE(texts.insert(help).second) << info.name << " describes two choices by: " << help;
    }
  }
}

TEST(ParameterTable, HasNoRowForOtherNames) {
  for (const char* const name : {"", "Mode", "mode ", "max_disparity", "disparity", "mod"}) {
    EXPECT_EQ(nullptr, find_parameter(name)) << name;
  }
}

TEST(Parameters, AcceptEveryDefaultOfTheTable) {
  for (const ParameterInfo& info : parameter_table()) {
    for (const auto& of_modes : info.defaults) {
      for (const char* const text : of_modes) {
        Parameters parameters;
        const Status status = parameters.set(info.id, std::string_view(text));
        EXPECT_TRUE(status.ok()) << info.name << ": "
                                 << (status.ok() ? "" : status.error().message);
        EXPECT_EQ(text, parameters.text(info.id)) << info.name;
      }
    }
  }
}

// Feature: presets
TEST(Parameters, HaveTheDefaultsOfPresetAndModeIfUnset) {
  const char* const presets[] = {"default", "fast", "paper"};
  const char* const modes[] = {"sparse", "semi-dense", "dense", "full"};
  for (int preset = 0; preset < kPresets; ++preset) {
    for (int mode = 0; mode < kModes; ++mode) {
      const Parameters parameters =
          test::parameters({{"preset", presets[preset]}, {"mode", modes[mode]}});
      EXPECT_EQ(static_cast<Preset>(preset), parameters.preset());
      EXPECT_EQ(static_cast<Mode>(mode), parameters.mode());
      for (const ParameterInfo& info : parameter_table()) {
        if (info.id == Parameter::kPreset || info.id == Parameter::kMode) continue;
        EXPECT_EQ(info.defaults[preset][mode], parameters.text(info.id)) << info.name;
        EXPECT_FALSE(parameters.is_set(info.id)) << info.name;
      }
    }
  }
}

TEST(Parameters, StartWithTheDefaultPresetInModeSemiDense) {
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(parameter_default(info.id, Preset::kDefault, Mode::kSemiDense),
              Parameters().text(info.id))
        << info.name;
    EXPECT_FALSE(Parameters().is_set(info.id)) << info.name;
  }
}

TEST(Parameters, OverrideSingleDefaultsOfAPreset) {
  const Parameters parameters =
      test::parameters({{"speckle-size", "7"}, {"preset", "paper"}, {"cost", "census"}});
  EXPECT_EQ(7, parameters.integer(Parameter::kSpeckleSize));
  EXPECT_EQ("census", parameters.text(Parameter::kCost));
  EXPECT_EQ("21", parameters.text(Parameter::kOutlierRadius));
  EXPECT_EQ("nodes-and-pixels", parameters.text(Parameter::kOutlierRemoval));
}

TEST(ParameterTable, HasTheDefaultsAsText) {
  EXPECT_EQ("64", parameter_defaults_text(Parameter::kMaxDisparity));
  EXPECT_EQ("default", parameter_defaults_text(Parameter::kPreset));
  EXPECT_EQ("semi-dense", parameter_defaults_text(Parameter::kMode));
  EXPECT_EQ("full; preset fast: half-refined", parameter_defaults_text(Parameter::kResolution));
  EXPECT_EQ("3 (sparse 0, dense 0, full 0); preset paper: 0",
            parameter_defaults_text(Parameter::kMaxGap));
  EXPECT_EQ("16; preset paper: 8 (sparse 16)", parameter_defaults_text(Parameter::kGrayLevels));
  EXPECT_EQ("census; preset paper: gradient", parameter_defaults_text(Parameter::kCost));
}

TEST(Parameters, KeepSetValuesWhenTheModeChanges) {
  Parameters parameters = test::parameters({{"preset", "paper"}, {"gray-levels", "37"}});
  for (const char* const mode : {"sparse", "semi-dense"}) {
    test::set_all(parameters, {{"mode", mode}});
    EXPECT_EQ(37, parameters.integer(Parameter::kGrayLevels)) << mode;
  }
  parameters.unset(Parameter::kGrayLevels);
  EXPECT_FALSE(parameters.is_set(Parameter::kGrayLevels));
  EXPECT_EQ(8, parameters.integer(Parameter::kGrayLevels));
  test::set_all(parameters, {{"mode", "sparse"}});
  EXPECT_EQ(16, parameters.integer(Parameter::kGrayLevels));
}

TEST(Parameters, ParseTheirOwnText) {
  for (const ParameterInfo& info : parameter_table()) {
    for (const std::string& text : valid_texts(info)) {
      Parameters first, second;
      ASSERT_TRUE(first.set(std::string_view(info.name), text).ok()) << info.name << " = " << text;
      ASSERT_TRUE(second.set(info.id, std::string_view(first.text(info.id))).ok())
          << info.name << " = " << first.text(info.id);
      EXPECT_EQ(first.get(info.id), second.get(info.id)) << info.name << " = " << text;
      EXPECT_EQ(first.text(info.id), second.text(info.id)) << info.name << " = " << text;
      EXPECT_EQ(first.node_levels().level, second.node_levels().level) << info.name;
      EXPECT_TRUE(first.is_set(info.id));
    }
  }
}

TEST(Parameters, AcceptTheSameValuesAsNumberAndText) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type == ParameterType::kLevels) continue;
    for (const std::string& text : valid_texts(info)) {
      Parameters from_text, from_number;
      ASSERT_TRUE(from_text.set(info.id, std::string_view(text)).ok());
      ASSERT_TRUE(from_number.set(info.id, from_text.get(info.id)).ok())
          << info.name << " " << text;
      EXPECT_EQ(from_text.text(info.id), from_number.text(info.id)) << info.name;
    }
  }
}

TEST(Parameters, ParseLevelsFromCoarseToFine) {
  const Parameters parameters = test::parameters({{"node-levels", "12,3,0"}});
  const Parameters::Levels levels = parameters.node_levels();
  ASSERT_EQ(3, levels.count);
  EXPECT_EQ(12, levels.level[0]);
  EXPECT_EQ(3, levels.level[1]);
  EXPECT_EQ(0, levels.level[2]);
  EXPECT_EQ(3, parameters.get(Parameter::kNodeLevels));
  EXPECT_EQ("12,3,0", parameters.text(Parameter::kNodeLevels));
}

TEST(Parameters, ReturnTheMode) {
  EXPECT_EQ(Mode::kSemiDense, Parameters().mode());
  EXPECT_EQ(Mode::kSparse, test::parameters({{"mode", "sparse"}}).mode());
  Parameters by_index;
  ASSERT_TRUE(by_index.set(Parameter::kMode, 0.0).ok());
  EXPECT_EQ(Mode::kSparse, by_index.mode());
}

TEST(Parameters, AreCopiedAsValues) {
  const Parameters original = test::parameters({{"max-disparity", "100"}});
  Parameters copy = original;
  test::set_all(copy, {{"max-disparity", "200"}});
  EXPECT_EQ(100, original.integer(Parameter::kMaxDisparity));
  EXPECT_EQ(200, copy.integer(Parameter::kMaxDisparity));
}

TEST(Parameters, FitFramesUpToTheLimits) {
  const Parameters narrow = test::parameters({{"max-disparity", "1"}});
  for (const auto& [width, height] :
       {std::pair{1, 1}, {kLargestImageSide, 1}, {1, kLargestImageSide}, {16384, 16384}}) {
    EXPECT_TRUE(narrow.check_frame(width, height).ok()) << width << "x" << height;
  }
  EXPECT_TRUE(test::parameters({{"max-disparity", "640"}}).check_frame(640, 480).ok());
  // 4 px is more than 3 px and less than a tenth of 41 px.
  EXPECT_TRUE(test::parameters({{"min-node-width", "3"}, {"max-node-width", "0.1"}})
                  .check_frame(64, 4)
                  .ok());
}

TEST(Parameters, FitSixteenBitsUpToTheLimit) {
  const Parameters parameters = test::parameters({{"max-disparity", "255"}});
  EXPECT_TRUE(parameters.check_scale16(1).ok());
  EXPECT_TRUE(parameters.check_scale16(256).ok());
  EXPECT_TRUE(parameters.check_scale16(257).ok()) << "255 * 257 = 65535";
  EXPECT_TRUE(test::parameters({{"max-disparity", "1"}}).check_scale16(65535).ok());
  EXPECT_TRUE(test::parameters({{"max-disparity", "1984"}}).check_scale16(33).ok());
}

}  // namespace
}  // namespace mtstereo::parameters_test
