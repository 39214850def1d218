// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>

#include "mtstereo/parameters.hpp"

namespace mtstereo {

/// Values of parameters as text, and back.

/// Whether the parameter takes odd numbers only.
constexpr bool is_odd_only(Parameter id) {
  return id == Parameter::kCostKernelSize || id == Parameter::kCensusKernelSize ||
         id == Parameter::kNodeEndWidth;
}

/// The shortest text that reads as the same number.
std::string number_text(double value);

/// The values that a parameter takes, for an error message: "1 to 41 px, odd".
std::string range_text(const ParameterInfo& info);

/// "640x480".
std::string size_text(int width, int height);

/// Reads a whole text as a number. False where it is none.
bool parse_number(std::string_view text, double& value);

/// Reads the levels of Parameter::kNodeLevels: "1,0". False where they are none.
bool parse_levels(std::string_view text, Parameters::Levels& levels);

/// The index of `word` among the words of `choices` ("a|b|c"), or -1.
int choice_index(std::string_view choices, std::string_view word);

/// The word with this index; the index has to be one of a word.
std::string_view choice_word(std::string_view choices, int index);

}  // namespace mtstereo
