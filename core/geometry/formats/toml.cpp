// SPDX-License-Identifier: LGPL-2.1-or-later
#include <stdexcept>

namespace mtstereo::formats {

/// toml++ asserts what a file can contradict, such as the first letter of the name of a table. That
/// must not end the program.
constexpr void expect_in_toml(bool expected) {
  if (!expected) throw std::domain_error("unexpected character");
}

}  // namespace mtstereo::formats

#undef NDEBUG  // with it, toml++ takes that for granted
#define TOML_ASSERT(expression) mtstereo::formats::expect_in_toml(static_cast<bool>(expression))
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#define TOML_ENABLE_WINDOWS_COMPAT 0
#include <toml++/toml.h>

#include <cstdint>

#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

bool is_header(std::string_view line) {
  return line.size() > 2 && line.front() == '[' && line.back() == ']' &&
         line.find_first_of(",= ") == std::string_view::npos;
}

/// Dates and times become empty: no calibration needs them.
std::string text_of(const toml::node& scalar) {
  if (const auto number = scalar.value_exact<double>()) return number_text(*number);
  if (const auto number = scalar.value_exact<std::int64_t>()) return std::to_string(*number);
  if (const auto truth = scalar.value_exact<bool>()) return *truth ? "true" : "false";
  return scalar.value_or(std::string());
}

void build(TreeBuilder& builder, const toml::node& node) {
  if (const toml::table* table = node.as_table()) {
    builder.begin(Value::Kind::kMap);
    for (const auto& [name, entry] : *table) {
      builder.add_text(std::string(name.str()));
      build(builder, entry);
    }
    builder.end();
  } else if (const toml::array* list = node.as_array()) {
    builder.begin(Value::Kind::kList);
    for (const toml::node& item : *list) build(builder, item);
    builder.end();
  } else {
    builder.add_text(text_of(node));
  }
}

}  // namespace

bool is_toml(std::string_view text, std::string_view file) {
  if (file.ends_with(".toml")) return true;
  // The INI of ROS follows what cameracalibrator prints in Python.
  const bool array = text.find("= [") != std::string_view::npos &&
                     text.find("# oST version") == std::string_view::npos;
  bool header = false;
  while (array && !header && !text.empty()) header = is_header(take_line(text));
  return header;
}

Value parse_toml(std::string_view text, const std::string& file) {
  try {
    TreeBuilder builder(file);
    build(builder, toml::parse(text));
    return builder.take();
  } catch (const toml::parse_error& error) {
    throw FileError(file + ": line " + std::to_string(error.source().begin.line) +
                    " is not valid TOML: " + printable(error.description()));
  } catch (const std::domain_error& error) {
    throw FileError(file + ": is not valid TOML: " + error.what());
  }
}

}  // namespace mtstereo::formats
