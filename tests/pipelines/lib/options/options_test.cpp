// SPDX-License-Identifier: LGPL-2.1-or-later
// What the programs say about a mistyped option, and which numbers they accept.
#include <gtest/gtest.h>

#include <filesystem>

#include "lib/options/failure_message.hpp"
#include "lib/options/finite_range.hpp"
#include "lib/options/nearest_name.hpp"
#include "lib/options/parse.hpp"
#include "lib/options/two_numbers.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::options::options_test {
namespace {

const std::vector<std::string> kNames{"max-disparity", "min-disparity", "mode", "out", "what"};

TEST(TypingErrors, AreCounted) {
  EXPECT_EQ(typing_errors("", ""), 0u);
  EXPECT_EQ(typing_errors("mode", "mode"), 0u);
  EXPECT_EQ(typing_errors("", "mode"), 4u);
  EXPECT_EQ(typing_errors("mode", ""), 4u);
  EXPECT_EQ(typing_errors("mde", "mode"), 1u);    // a letter is missing
  EXPECT_EQ(typing_errors("moode", "mode"), 1u);  // one too many
  EXPECT_EQ(typing_errors("mods", "mode"), 1u);   // another one
  EXPECT_EQ(typing_errors("moed", "mode"), 1u);   // two exchanged
  EXPECT_EQ(typing_errors("what", "mode"), 4u);
}

TEST(TwoNumbers, AreReadFromATextOfDigitsOnly) {
  EXPECT_EQ(two_numbers("640x480"), std::pair(640, 480));
  EXPECT_EQ(two_numbers("00009x0"), std::pair(9, 0));
  for (const char* const text :
       {"", "x", "640", "640x", "x480", "640x480x3", "640x480 ", " 640x480", "+640x480", "640x-480",
        "6.4x480", "640X480", "123456x1", "1x99999999999"}) {
    EXPECT_FALSE(two_numbers(text)) << text;
  }
}

TEST(NearestName, IsThatWithTheFewestErrors) {
  EXPECT_EQ(nearest_name("max-disparty", kNames), "max-disparity");
  EXPECT_EQ(nearest_name("min-disparties", kNames), "min-disparity");
  EXPECT_EQ(nearest_name("moed", kNames), "mode");
  EXPECT_EQ(nearest_name("waht", kNames), "what");
}

TEST(NearestName, IsNoneForAnotherWord) {
  for (const char* const word : {"", "x", "no-such-option", "calibration", "disparity"}) {
    EXPECT_EQ(nearest_name(word, kNames), "") << word;
  }
  EXPECT_EQ(nearest_name("mode", {}), "");
}

std::string message_of(const std::vector<std::string>& arguments) {
  CLI::App app;
  int number = 0;
  app.add_option("--max-disparity,-d", number);
  app.failure_message(failure_message);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, text;
    app.exit(error, out, text);
    return text.str();
  }
  return "";
}

// CLI11 reads [a,b] as a list.
TEST(Parsing, KeepsTheBracketsOfAPathThatExists) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "[1,2]");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  CLI::App app;
  std::vector<std::string> inputs;
  app.add_option("INPUT", inputs);
  const std::vector<const char*> arguments = {"program", "[1,2]", "[3,4]"};
  EXPECT_EQ(parse(app, static_cast<int>(arguments.size()), arguments.data(), [] {}), std::nullopt);
  std::filesystem::current_path(before);
  EXPECT_EQ(inputs, (std::vector<std::string>{"./[1,2]", "3", "4"}));
}

TEST(FailureMessage, NamesTheNearestOption) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--max-disparty", "64"}, {"--max-disparty=64"}}) {
    const std::string message = message_of(arguments);
    EXPECT_NE(message.find("Did you mean --max-disparity by --max-disparty?"), std::string::npos)
        << message;
    EXPECT_NE(message.find("--help"), std::string::npos) << message;
  }
}

TEST(FailureMessage, NamesTheNearestOptionIfItsValueIsAnInputTooMany) {
  CLI::App app;
  std::vector<std::string> inputs;
  std::string out;
  app.add_option("INPUT", inputs)->expected(1, 2);
  app.add_option("--out", out);
  app.failure_message(failure_message);
  try {
    app.parse("left right --otu folder");
    FAIL() << "not refused";
  } catch (const CLI::ParseError& error) {
    EXPECT_NE(failure_message(&app, error).find("Did you mean --out"), std::string::npos);
  }
}

TEST(FailureMessage, DoesNotGuess) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--no-such-option"},
                                                    {"file"},
                                                    {"--max-disparity", "x"},
                                                    {"--"},
                                                    {"--=3", "-x"}}) {
    EXPECT_EQ(message_of(arguments).find("Did you mean"), std::string::npos) << arguments[0];
  }
  EXPECT_EQ(message_of({"--max-disparity", "64"}), "");
}

TEST(FiniteRange, AcceptsNumbersOnly) {
  for (const char* text : {"nan", "-nan", "inf", "-inf", "NaN", "1e400", "", "1x", "0.5", "11"}) {
    CLI::App app;
    double value = 0;
    app.add_option("--value", value)->check(finite_range(1, 10));
    EXPECT_THROW(app.parse(std::string("--value=") + text), CLI::ParseError) << text;
  }
  for (const char* text : {"nan", "inf", "-inf"}) {
    CLI::App app;
    double value = 0;
    app.add_option("--value", value)->check(finite());
    EXPECT_THROW(app.parse(std::string("--value=") + text), CLI::ParseError) << text;
  }
  CLI::App app;
  double value = 0;
  app.add_option("--value", value)->check(finite_range(1, 10))->check(finite());
  app.parse("--value 10");
  EXPECT_EQ(value, 10);
}

}  // namespace
}  // namespace mtstereo::options::options_test
