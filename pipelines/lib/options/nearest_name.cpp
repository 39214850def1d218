// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/options/nearest_name.hpp"

#include <algorithm>

namespace mtstereo::options {

std::size_t typing_errors(std::string_view first, std::string_view second) {
  const std::size_t columns = second.size() + 1;
  // The rows of the table for the letters of the first word: two ago, the last one, this one.
  std::vector<std::size_t> before(columns), last(columns), row(columns);
  for (std::size_t j = 0; j < columns; ++j) last[j] = j;
  for (std::size_t i = 1; i <= first.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j < columns; ++j) {
      const bool equal = first[i - 1] == second[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (equal ? 0 : 1)});
      const bool exchanged =
          i > 1 && j > 1 && first[i - 1] == second[j - 2] && first[i - 2] == second[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last.back();
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = word.size() / 3 + 1;
  for (const std::string& name : names) {
    const std::size_t errors = typing_errors(word, name);
    if (errors >= least) continue;
    least = errors;
    nearest = name;
  }
  return nearest;
}

}  // namespace mtstereo::options
