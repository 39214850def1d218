// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

constexpr std::string_view kLineBlanks = " \t\r\f\v";

/// Adds the entry that a line states to a map.
void add_entry(Value& map, std::string_view line, char separator, int number,
               const std::string& file) {
  const std::size_t at = line.find(separator);
  if (at == std::string_view::npos || at == 0) {
    throw FileError(file + ": line " + std::to_string(number) + " is '" + printable(line) +
                    "', NAME" + separator + " VALUE is needed");
  }
  if (map.items.size() >= kMostValues) {
    throw FileError(file + ": there are too many lines for a calibration");
  }
  map.names.emplace_back(trimmed(line.substr(0, at), kLineBlanks));
  map.items.emplace_back();
  map.items.back().text = trimmed(line.substr(at + 1), kLineBlanks);
}

bool is_comment(std::string_view line) {
  return line.empty() || line.front() == '#' || line.front() == ';';
}

}  // namespace

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = trimmed(text.substr(0, end), kLineBlanks);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

Value parse_lines(std::string_view text, char separator, const std::string& file) {
  Value map;
  map.kind = Value::Kind::kMap;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = take_line(text);
    if (!is_comment(line)) add_entry(map, line, separator, number, file);
  }
  return map;
}

Value parse_sections(std::string_view text, const std::string& file) {
  Value sections;
  sections.kind = Value::Kind::kMap;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = take_line(text);
    if (is_comment(line)) continue;
    if (line.front() != '[') {
      if (sections.items.empty()) {
        throw FileError(file + ": line " + std::to_string(number) + " is before any [SECTION]");
      }
      add_entry(sections.items.back(), line, '=', number, file);
      continue;
    }
    if (line.back() != ']') {
      throw FileError(file + ": line " + std::to_string(number) + " is '" + printable(line) +
                      "', [SECTION] is needed");
    }
    sections.names.emplace_back(line.substr(1, line.size() - 2));
    sections.items.emplace_back();
    sections.items.back().kind = Value::Kind::kMap;
  }
  return sections;
}

Value parse_number_lines(std::string_view text) {
  Value list;
  list.kind = Value::Kind::kList;
  while (!text.empty()) {
    const std::string_view line = take_line(text);
    if (is_comment(line)) continue;
    list.items.emplace_back();
    list.items.back().text = line;
  }
  return list;
}

}  // namespace mtstereo::formats
