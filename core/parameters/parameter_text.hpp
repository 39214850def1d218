// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>

#include "mtstereo/parameters.hpp"

namespace mtstereo {

/// Values of parameters as text, and back.

/// Whether the parameter allows odd numbers only.
constexpr bool is_odd_only(Parameter id) {
  return id == Parameter::kCostKernelSize || id == Parameter::kCensusKernelSize ||
         id == Parameter::kNodeEndWidth;
}

/// The shortest text that parses to the same number.
std::string number_text(double value);

/// The values that a parameter allows, for an error message: "1 to 41 px, odd".
std::string range_text(const ParameterInfo& info);

/// "640x480".
std::string size_text(int width, int height);

/// Parses the whole text as a number. Returns false if it is not one.
bool parse_number(std::string_view text, double& value);

/// Parses a value of Parameter::kNodeLevels, as in "1,0". Returns false if it is invalid.
bool parse_levels(std::string_view text, Parameters::Levels& levels);

/// The index of `word` among the words of `choices` ("a|b|c"), or -1.
int choice_index(std::string_view choices, std::string_view word);

/// The word with this index, which must be valid.
std::string_view choice_word(std::string_view choices, int index);

}  // namespace mtstereo
