// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// What a calibration file contains, whatever its syntax is: numbers and texts, in lists and maps.

namespace mtstereo::formats {

/// Why a file cannot be used: a sentence that names the file and the entry. It does not leave
/// read_calibration().
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A number or a text, a list, or a map.
struct Value {
  /// What a value is.
  enum class Kind { kScalar, kList, kMap };

  Kind kind = Kind::kScalar;
  std::string text;                ///< of a scalar; empty for a value that is null
  std::vector<std::string> names;  ///< of the entries of a map, one per item
  std::vector<Value> items;        ///< of a list or a map

  /// True if all are equal, in the same order.
  friend bool operator==(const Value&, const Value&) = default;
};

/// Text of a file as it can be printed: without control characters, and shortened.
std::string printable(std::string_view text);

/// What is between the values of a file.
inline constexpr std::string_view kBlanks = " \t\r\n";
/// The text without these characters at its start and end.
std::string_view trimmed(std::string_view text, std::string_view blanks = kBlanks);

/// The shortest text that parses to the same number.
std::string number_text(double value);

/// Parses a whole text as a number. Infinity and NaN are numbers here.
std::optional<double> parse_number(std::string_view text);

/// A value of a file, with what an error message needs to name it.
class Entry {
 public:
  /// The value must exist longer than the entry. `name` is empty for the whole file.
  Entry(const Value& value, std::string file, std::string name);

  /// Throws a FileError: "FILE: NAME WHAT".
  [[noreturn]] void fail(const std::string& what) const;

  const Value& value() const { return *value_; }
  const std::string& file() const { return file_; }
  const std::string& name() const { return name_; }
  bool is_scalar() const { return value_->kind == Value::Kind::kScalar; }
  bool is_list() const { return value_->kind == Value::Kind::kList; }
  bool is_map() const { return value_->kind == Value::Kind::kMap; }

  /// The entry of a map with this name. An error if it appears twice.
  std::optional<Entry> find(std::string_view name) const;
  /// The same, but upper and lower case are equal.
  std::optional<Entry> find_any_case(std::string_view name) const;
  /// The first of these names that is there.
  std::optional<Entry> find_any(std::initializer_list<std::string_view> names) const;
  /// The entry with this name. `meaning` explains it in the message of a missing one.
  Entry at(std::string_view name, std::string_view meaning = {}) const;
  /// The entries of a list.
  std::vector<Entry> list() const;

  /// A finite number.
  double number() const;
  /// An integer of this range.
  int integer(int least, int most) const;
  /// A text, without the quotation marks that some syntaxes keep.
  std::string text() const;
  /// Finite numbers: of a list, also of lists in it; of a text with blanks, commas, semicolons or
  /// brackets between them; or of the entry `data` of a matrix.
  std::vector<double> numbers() const;
  /// The same for a fixed count. `shape` explains the count: "a 3x3 matrix".
  std::vector<double> numbers(std::size_t count, std::string_view shape) const;

 private:
  using Matches = bool (*)(std::string_view, std::string_view);
  std::optional<Entry> find_by(std::string_view name, Matches matches) const;
  void append_numbers(std::vector<double>& numbers) const;
  double finite(std::string_view text) const;

  const Value* value_;
  std::string file_;
  std::string name_;
};

}  // namespace mtstereo::formats
