// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/options/two_numbers.hpp"

#include <charconv>

namespace mtstereo::options {
namespace {

std::optional<int> number(std::string_view text) {
  constexpr std::size_t kMostDigits = 5;
  const bool digits = text.find_first_not_of("0123456789") == std::string_view::npos;
  if (text.empty() || text.size() > kMostDigits || !digits) return std::nullopt;
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::optional<std::pair<int, int>> two_numbers(std::string_view text) {
  const std::size_t mark = text.find('x');
  if (mark == std::string_view::npos) return std::nullopt;
  const std::optional<int> first = number(text.substr(0, mark));
  const std::optional<int> second = number(text.substr(mark + 1));
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

}  // namespace mtstereo::options
