// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/help_format.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace mtstereo::run {
namespace {

constexpr std::size_t kLine = 100;
constexpr std::size_t kNames = 36;  // of options, before their descriptions

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    // The indentation is kept.
    std::size_t length = std::min(line.find_first_not_of(' '), line.size());
    if (!result.empty()) result += '\n';
    result.append(length, ' ');
    bool first = true;
    for (std::string word; words >> word;) {
      const bool fits = length + 1 + word.size() <= width;
      if (!first) result += fits ? ' ' : '\n';
      length = first ? length + word.size() : fits ? length + 1 + word.size() : word.size();
      first = false;
      result += word;
    }
  }
  return result;
}

HelpFormatter::HelpFormatter(std::string usage) : usage_(std::move(usage)) { column_width(kNames); }

std::string HelpFormatter::make_usage(const CLI::App* /*app*/, std::string /*name*/) const {
  return "Usage: " + usage_ + "\n";
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), kLine) + "\n";
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  return wrapped(app->get_footer(), kLine) + "\n";
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description(), kLine - kNames);
}

}  // namespace mtstereo::run
