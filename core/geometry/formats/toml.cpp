// SPDX-License-Identifier: LGPL-2.1-or-later
// TOML as tables of values that YAML has, too: numbers, texts, arrays, inline tables.

#include <algorithm>

#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

constexpr int kMostTables = 100;

bool is_header(std::string_view line) {
  return line.size() > 2 && line.front() == '[' && line.back() == ']' &&
         line.find_first_of(",= ") == std::string_view::npos;
}

/// The entry of a map, which is added if it is missing.
Value& entry_of(Value& map, std::string_view name) {
  map.kind = Value::Kind::kMap;
  const auto found = std::find(map.names.begin(), map.names.end(), name);
  if (found != map.names.end()) return map.items[found - map.names.begin()];
  map.names.emplace_back(name);
  return map.items.emplace_back();
}

/// The table that a header names: [left], [stereo.left], or the next one of [[cameras]].
Value& table_of(Value& root, std::string_view header, const std::string& file) {
  if (std::count(header.begin(), header.end(), '.') > 5) {
    throw FileError(file + ": " + printable(header) + " is nested too deeply for a calibration");
  }
  const bool element = header.substr(0, 2) == "[[";
  std::string_view path = trimmed(header, "[]");
  Value* table = &root;
  while (!path.empty()) {
    const std::string_view name = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(name.size() + 1, path.size()));
    if (table->kind == Value::Kind::kList && !table->items.empty()) table = &table->items.back();
    table = &entry_of(*table, trimmed(name, "\"'"));
  }
  if (!element) return *table;
  table->kind = Value::Kind::kList;
  return table->items.emplace_back();
}

/// The line of a table as a line of YAML.
std::string as_yaml(std::string_view line, bool starts) {
  std::string text(line);
  const std::size_t equals = starts ? text.find('=') : std::string::npos;
  if (equals != std::string::npos) text.replace(equals, 1, ": ");
  if (text.find('{') == std::string::npos) return (starts ? "" : " ") + text + "\n";
  for (std::size_t at = 0; (at = text.find('=', at)) != std::string::npos;) {
    text.replace(at, 1, ": ");
  }
  return text + "\n";
}

}  // namespace

bool is_toml(std::string_view text, std::string_view file) {
  if (file.ends_with(".toml")) return true;
  bool header = false;
  // The INI of ROS follows what cameracalibrator prints in Python.
  const bool array = text.find("= [") != std::string_view::npos &&
                     text.find("# oST version") == std::string_view::npos;
  while (array && !header && !text.empty()) header = is_header(take_line(text));
  return header;
}

Value parse_toml(std::string_view text, const std::string& file) {
  Value root;
  root.kind = Value::Kind::kMap;
  std::string header, body;
  int number = 0, first = 0, open = 0, tables = 0;
  const auto finish = [&] {
    if (++tables > kMostTables) throw FileError(file + ": has too many tables for a calibration");
    // Empty lines in front keep the numbers of the lines in errors.
    const Value entries = parse_yaml(std::string(first, '\n') + body, file);
    if (entries.kind != Value::Kind::kMap && entries != Value()) {
      throw FileError(file + ": line " + std::to_string(first + 1) + ": NAME = VALUE is needed");
    }
    Value& table = header.empty() ? root : table_of(root, header, file);
    table.kind = Value::Kind::kMap;
    for (std::size_t i = 0; i < entries.names.size(); ++i) {
      table.names.push_back(entries.names[i]);
      table.items.push_back(entries.items[i]);
    }
  };
  while (!text.empty()) {
    const std::string_view line = take_line(text);
    ++number;
    if (open == 0 && is_header(line)) {
      finish();
      header = line;
      body.clear();
      first = number;
      continue;
    }
    body += as_yaml(line, open == 0);
    open += static_cast<int>(std::count(line.begin(), line.end(), '[') -
                             std::count(line.begin(), line.end(), ']'));
  }
  finish();
  return root;
}

}  // namespace mtstereo::formats
