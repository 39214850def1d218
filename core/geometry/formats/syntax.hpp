// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/formats/value.hpp"

// The syntaxes of calibration files. Each parser throws a FileError that names `file` and, where
// the syntax is wrong, the line.

namespace mtstereo::formats {

/// The deepest nesting, and the most values, that a file may have. No calibration comes near.
inline constexpr std::size_t kDeepestNesting = 50;
inline constexpr std::size_t kMostValues = 200'000;

/// Makes a Value of the events of a parser: scalars, starts and ends. In a map every first one of
/// two values is the name of the second.
class TreeBuilder {
 public:
  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}

  void add(Value value);
  /// Adds a scalar.
  void add_text(std::string text);
  void begin(Value::Kind kind);
  /// Ends the list or map that began last and returns a copy of it only if `copy` is true.
  Value end(bool copy = false);
  /// Counts the values and texts of a copy, so that copies of copies cannot use up the memory.
  void count(const Value& value);
  /// Whether a list or map is still open.
  bool open() const { return !open_.empty(); }
  /// The finished value.
  Value take() { return std::move(root_); }

 private:
  struct Level {
    Value value;
    bool has_name = false;
  };
  void count_one(std::size_t cost = 1);

  std::string file_;
  std::vector<Level> open_;
  Value root_;
  std::size_t values_ = 0;
};

/// YAML, and the YAML that OpenCV writes, whose first line is "%YAML:1.0". Of several documents the
/// one with this number from 1 on; null if there is none.
Value parse_yaml(const std::string& text, const std::string& file, std::size_t number = 1);
/// The first documents of YAML, at most so many.
std::vector<Value> parse_yaml_documents(const std::string& text, const std::string& file,
                                        std::size_t most);
/// JSON, also with the comments of C++.
Value parse_json(const std::string& text, const std::string& file);
/// The XML that OpenCV writes: elements and text, without document types.
Value parse_xml(std::string_view text, const std::string& file);
/// Lines of NAME SEPARATOR VALUE, as a map of texts.
Value parse_lines(std::string_view text, char separator, const std::string& file);
/// Lines of NAME=VALUE below lines of [SECTION], as a map of maps.
Value parse_sections(std::string_view text, const std::string& file);
/// Whether this is TOML, by the name of the file, or by a [TABLE] and an array.
bool is_toml(std::string_view text, std::string_view file);
/// TOML, whose tables become maps.
Value parse_toml(std::string_view text, const std::string& file);
/// The INI of ROS: names, and the lines of numbers after each. A map with the names of the YAML
/// files of ROS, or a list of maps where there are several cameras.
Value parse_camera_ini(std::string_view text, const std::string& file);
/// A Python literal as mrcal writes it.
Value parse_mrcal(std::string text, const std::string& file);
/// Lines of numbers, as a list of texts.
Value parse_number_lines(std::string_view text);

/// Removes the first line from a text and returns it, without blanks at its ends.
std::string_view take_line(std::string_view& text);

}  // namespace mtstereo::formats
