// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <ostream>
#include <string>
#include <utility>

#include "mtstereo/matcher.hpp"
#include "support/plane.hpp"

namespace mtstereo {

inline const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidParameter:
      return "kInvalidParameter";
    case ErrorCode::kInvalidCombination:
      return "kInvalidCombination";
    case ErrorCode::kInvalidImage:
      return "kInvalidImage";
    case ErrorCode::kSizeMismatch:
      return "kSizeMismatch";
    case ErrorCode::kFrameDoesNotFit:
      return "kFrameDoesNotFit";
    case ErrorCode::kOutOfMemory:
      return "kOutOfMemory";
    case ErrorCode::kSystem:
      return "kSystem";
    case ErrorCode::kInvalidCalibration:
      return "kInvalidCalibration";
  }
  return "an unknown code";
}

/// Prints a code in a failed expectation.
inline void PrintTo(ErrorCode code, std::ostream* out) { *out << name_of(code); }

namespace test {

/// Sets values by name; a rejected value is a test failure.
inline void set_all(Parameters& parameters,
                    std::initializer_list<std::pair<const char*, std::string>> values) {
  for (const auto& [name, text] : values) {
    const Status status = parameters.set(std::string_view(name), text);
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  }
}

inline Parameters parameters(std::initializer_list<std::pair<const char*, std::string>> values) {
  Parameters set;
  set_all(set, values);
  return set;
}

inline Matcher matcher(std::initializer_list<std::pair<const char*, std::string>> values) {
  return std::move(Matcher::create(parameters(values)).value());
}

/// A copy of the result of one pair.
struct Matched {
  DisparityPlane map;
  GrayPlane confidence;
  FrameStatistics statistics;
};

/// The result of one pair; on an error empty planes and a test failure.
inline Matched match(Matcher& matcher, const GrayPlane& left, const GrayPlane& right) {
  const Result<FrameResult> result = matcher.compute(left.view(), right.view());
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  if (!result.ok()) return {};
  return {copy_of(result->disparity), copy_of(result->confidence), result->statistics};
}

/// The disparities of one pair.
inline DisparityPlane compute(Matcher& matcher, const GrayPlane& left, const GrayPlane& right) {
  return match(matcher, left, right).map;
}

/// Number of pixels that have a disparity.
inline long known(const DisparityPlane& map) {
  return static_cast<long>(map.pixels.size()) -
         std::count(map.pixels.begin(), map.pixels.end(), kNoDisparity);
}

/// Succeeds if a call failed with this code and its message contains all of these words.
template <typename Outcome>
::testing::AssertionResult fails_with(const Outcome& outcome, ErrorCode code,
                                      std::initializer_list<std::string> words) {
  if (outcome.ok()) return ::testing::AssertionFailure() << "it did not fail";
  const Error& error = outcome.error();
  if (error.code != code) {
    return ::testing::AssertionFailure()
           << "it failed with " << ::testing::PrintToString(error.code) << ": " << error.message;
  }
  for (const std::string& word : words) {
    if (error.message.find(word) != std::string::npos) continue;
    return ::testing::AssertionFailure()
           << "\"" << word << "\" is missing in the message: " << error.message;
  }
  return ::testing::AssertionSuccess();
}

}  // namespace test
}  // namespace mtstereo
