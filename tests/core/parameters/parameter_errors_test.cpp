// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <limits>
#include <sstream>

#include "support/matching.hpp"

namespace mtstereo::parameter_errors_test {
namespace {

using test::fails_with;

constexpr auto kInvalid = ErrorCode::kInvalidParameter;

/// Sets an invalid value. The message must contain the name, the value and `range`, and the value
/// in force must not change.
template <typename Value>
void expect_rejected(const ParameterInfo& info, const Value& value, const std::string& shown,
                     std::initializer_list<std::string> range) {
  SCOPED_TRACE(testing::Message() << info.name << " = " << shown);
  Parameters untouched;
  EXPECT_TRUE(fails_with(untouched.set(info.id, value), kInvalid, {info.name, shown}));
  EXPECT_FALSE(untouched.is_set(info.id));
  EXPECT_EQ(parameter_default(info.id, Preset::kDefault, Mode::kSemiDense),
            untouched.text(info.id));

  Parameters set;
  const char* const other = parameter_default(info.id, Preset::kPaper, Mode::kSparse);
  ASSERT_TRUE(set.set(info.id, std::string_view(other)).ok());
  EXPECT_TRUE(fails_with(set.set(info.id, value), kInvalid, range));
  EXPECT_TRUE(set.is_set(info.id));
  EXPECT_EQ(other, set.text(info.id)) << "the earlier value must stay";
}

std::string number(double value) {
  std::ostringstream text;
  text << std::setprecision(10) << value;
  return text.str();
}

TEST(ParameterErrors, RejectNumbersOutsideTheRange) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type != ParameterType::kInteger && info.type != ParameterType::kNumber) continue;
    const std::string low = std::to_string(static_cast<int>(info.minimum));
    const std::string high = std::to_string(static_cast<int>(info.maximum));
    const double step = info.type == ParameterType::kInteger ? 1 : 1e-6;
    for (const double value :
         {info.minimum - step, info.maximum + step, -1e300, 1e300, -kInfinity, kInfinity}) {
      expect_rejected(info, value, "", {low, "to " + high, info.unit});
    }
    expect_rejected(info, std::nan(""), "nan", {low, "to " + high});
    expect_rejected(info, info.maximum + 1, std::to_string(static_cast<int>(info.maximum) + 1),
                    {"to " + high});
  }
}

TEST(ParameterErrors, RejectTextOutsideTheRange) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type != ParameterType::kInteger && info.type != ParameterType::kNumber) continue;
    for (const std::string& text :
         {std::to_string(static_cast<int>(info.maximum) + 1),
          std::to_string(static_cast<int>(info.minimum) - 1), std::string("1e30"),
          std::string("inf"), std::string("-inf"), std::string("nan")}) {
      expect_rejected(info, std::string_view(text), "", {" to "});
    }
  }
}

TEST(ParameterErrors, RejectTextThatIsNotANumber) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type == ParameterType::kLevels) continue;
    for (const char* const text : {"", " ", "abc", "1x", "0x1", " 1", "1 ", "+1", "--1", "1,5",
                                   "1.2.3", "1e", "true1", "0|1", "\n1", "one"}) {
      expect_rejected(info, std::string_view(text), text, {"allowed are"});
    }
    // A text that contains a zero byte is not parsed up to that byte.
    expect_rejected(info, std::string_view("1\0", 2), "", {"allowed are"});
  }
}

TEST(ParameterErrors, RejectFractionsForIntegers) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type == ParameterType::kNumber || info.type == ParameterType::kLevels) continue;
    const double value = info.minimum + 0.5;
    expect_rejected(info, value, number(value), {});
    if (info.type == ParameterType::kChoice) continue;
    expect_rejected(info, std::string_view("0.5"), "0.5", {});
  }
}

TEST(ParameterErrors, RejectWordsThatAreNotChoices) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type != ParameterType::kChoice) continue;
    const std::string word =
        std::string(info.choices).substr(0, std::string(info.choices).find('|'));
    for (const std::string& text : {std::string(info.choices), word + "|", "|" + word, word + " ",
                                    word.substr(1), word + word, std::string("0")}) {
      expect_rejected(info, std::string_view(text), text, {word + " or "});
    }
    std::string upper = word;
    upper[0] = static_cast<char>(std::toupper(upper[0]));
    expect_rejected(info, std::string_view(upper), upper, {word});
    const auto words = std::count(info.choices, info.choices + std::strlen(info.choices), '|') + 1;
    for (const double index : {-1.0, 1.0 * words, 0.5})
      expect_rejected(info, index, number(index), {word});
  }
}

TEST(ParameterErrors, RejectWordsOtherThanTrueAndFalse) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type != ParameterType::kBoolean) continue;
    for (const char* const text : {"yes", "no", "on", "True", "FALSE", "2", "-1", "t", "falsee"}) {
      expect_rejected(info, std::string_view(text), text, {"false or true"});
    }
    for (const double value : {-1.0, 2.0, 0.1}) expect_rejected(info, value, number(value), {});
  }
}

TEST(ParameterErrors, RejectInvalidLevels) {
  const ParameterInfo& info = parameter_info(Parameter::kNodeLevels);
  for (const char* const text : {"",
                                 ",",
                                 "0,",
                                 ",0",
                                 "1",
                                 "1,2",
                                 "0,1",
                                 "0,0",
                                 "2,2,0",
                                 "1,0,0",
                                 "1,,0",
                                 "1,0,",
                                 " 1,0",
                                 "1, 0",
                                 "1,0 ",
                                 "1;0",
                                 "1.0",
                                 "1.5,0",
                                 "-1,0",
                                 "1,-0.5",
                                 "a,0",
                                 "1,a",
                                 "64,0",
                                 "100,0",
                                 "99999999999,0",
                                 "8,7,6,5,4,3,2,1,0",
                                 "1,0\n",
                                 "+1,0",
                                 "0x1,0"}) {
    expect_rejected(info, std::string_view(text), "\"" + std::string(text) + "\"",
                    {"strictly descending", "8", "63", "1,0"});
  }
}

TEST(ParameterErrors, RejectANumberForLevels) {
  const ParameterInfo& info = parameter_info(Parameter::kNodeLevels);
  for (const double value : {0.0, 1.0, 2.0}) {
    expect_rejected(info, value, number(value), {"strictly descending"});
  }
}

TEST(ParameterErrors, RejectEvenKernels) {
  const ParameterInfo& info = parameter_info(Parameter::kCostKernelSize);
  for (int size = 2; size <= 40; size += 2) {
    expect_rejected(info, static_cast<double>(size), std::to_string(size), {"1 to 41", "odd"});
    const std::string text = std::to_string(size);
    expect_rejected(info, std::string_view(text), text, {"odd"});
  }
}

TEST(ParameterErrors, ListTheParametersForAnUnknownName) {
  Parameters parameters;
  for (const char* const name : {"", "max_disparity", "Mode", "mode\n", "no-such-thing"}) {
    EXPECT_TRUE(fails_with(parameters.set(std::string_view(name), "1"), kInvalid,
                           {std::string("\"") + name + "\"", "mode", "max-disparity", "subpixel"}));
  }
}

TEST(ParameterErrors, RejectFramesThatCannotBeMatched) {
  const Parameters parameters = test::parameters({{"max-disparity", "1"}});
  for (const auto& [width, height] : {std::pair{0, 1},
                                      {1, 0},
                                      {-1, 5},
                                      {5, -1},
                                      {16385, 1},
                                      {1, 16385},
                                      {1 << 30, 1 << 30},
                                      {-(1 << 30), -(1 << 30)}}) {
    EXPECT_TRUE(fails_with(parameters.check_frame(width, height), ErrorCode::kFrameDoesNotFit,
                           {std::to_string(width) + "x" + std::to_string(height), "1 to 16384"}));
  }
}

TEST(ParameterErrors, RejectAMaxDisparityAboveTheWidth) {
  const Parameters parameters = test::parameters({{"max-disparity", "128"}});
  EXPECT_TRUE(fails_with(parameters.check_frame(127, 400), ErrorCode::kFrameDoesNotFit,
                         {"max-disparity = 128", "127x400", "1 to 127"}));
  EXPECT_TRUE(parameters.check_frame(128, 400).ok());
  EXPECT_TRUE(fails_with(Parameters().check_frame(1, 1), ErrorCode::kFrameDoesNotFit,
                         {"max-disparity = 64", "1 to 1 px"}));
}

TEST(ParameterErrors, RejectNodeWidthsThatExcludeAllNodes) {
  const auto check = [](const char* narrowest, const char* widest) {
    return test::parameters({{"min-node-width", narrowest}, {"max-node-width", widest}})
        .check_frame(100, 50);
  };
  EXPECT_TRUE(
      fails_with(check("50", "0.5"), ErrorCode::kInvalidCombination,
                 {"min-node-width = 50", "max-node-width = 0.5", "100x50", "lower", "raise"}));
  EXPECT_TRUE(fails_with(check("49", "0.5"), ErrorCode::kInvalidCombination, {"min-node-width"}))
      << "a node would have to be wider than 49 px and narrower than 50 px";
  EXPECT_TRUE(check("48", "0.5").ok()) << "49 px is allowed";
  EXPECT_TRUE(fails_with(check("16384", "1"), ErrorCode::kInvalidCombination, {"16384"}));
}

TEST(ParameterErrors, RejectNodeWidthsThatExcludeAllNodesAtHalfResolution) {
  const auto check = [](const char* narrowest, int width) {
    return test::parameters({{"min-node-width", narrowest}, {"resolution", "half"}})
        .check_frame(width, 50);
  };
  EXPECT_TRUE(fails_with(check("60", 100), ErrorCode::kInvalidCombination,
                         {"min-node-width = 60", "is 50 px", "100x50", "half resolution"}));
  EXPECT_TRUE(fails_with(check("49", 100), ErrorCode::kInvalidCombination, {"min-node-width"}));
  EXPECT_TRUE(check("48", 100).ok()) << "49 of 50 px is allowed";
  EXPECT_TRUE(check("49", 101).ok()) << "an odd width has half a pixel more";
}

TEST(ParameterErrors, RejectScalesThatDoNotFitSixteenBits) {
  constexpr auto kCombination = ErrorCode::kInvalidCombination;
  const Parameters parameters = test::parameters({{"max-disparity", "256"}});
  EXPECT_TRUE(
      fails_with(parameters.check_scale16(256), kCombination,
                 {"max-disparity = 256", "disparity-scale = 256", "1 to 255", "at most 255"}));
  for (const int scale : {0, -1, -256, std::numeric_limits<int>::min()}) {
    EXPECT_TRUE(fails_with(parameters.check_scale16(scale), kCombination,
                           {"disparity-scale = " + std::to_string(scale), "1 to 255"}));
  }
  for (const int scale : {65536, std::numeric_limits<int>::max()}) {
    const Status status = test::parameters({{"max-disparity", "1"}}).check_scale16(scale);
    EXPECT_TRUE(fails_with(status, kCombination, {"1 to 65535"}));
    EXPECT_EQ(std::string::npos, status.error().message.find("at most 0"))
        << "the message suggests an impossible max-disparity: " << status.error().message;
  }
}

TEST(ParameterErrors, RejectIdsThatAreNotInTheTable) {
  Parameters parameters;
  for (const int id : {-1, static_cast<int>(parameter_table().size())}) {
    const Status number = parameters.set(static_cast<Parameter>(id), 1.0);
    const Status text = parameters.set(static_cast<Parameter>(id), "1");
    ASSERT_FALSE(number.ok());
    ASSERT_FALSE(text.ok());
    EXPECT_EQ(ErrorCode::kInvalidParameter, number.error().code);
    EXPECT_NE(std::string::npos, text.error().message.find(std::to_string(id)));
  }
}

}  // namespace
}  // namespace mtstereo::parameter_errors_test
