// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/formats/value.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace mtstereo::formats {
namespace {

/// What may be between numbers of a text: also the brackets of Middlebury's matrices.
constexpr std::string_view kSeparators = " \t\r\n,;[]";

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

bool equal(std::string_view a, std::string_view b) { return a == b; }

bool equal_any_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

std::string_view trimmed(std::string_view text, std::string_view blanks) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out;
  for (const char byte : text.substr(0, kLongest)) out += byte >= ' ' && byte <= '~' ? byte : '?';
  return text.size() > kLongest ? out + "..." : out;
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::optional<double> parse_number(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  // YAML's words.
  std::string_view word = text;
  const bool negative = !word.empty() && word.front() == '-';
  if (negative) word.remove_prefix(1);
  if (equal_any_case(word, ".nan")) return std::numeric_limits<double>::quiet_NaN();
  if (equal_any_case(word, ".inf")) {
    return negative ? -std::numeric_limits<double>::infinity()
                    : std::numeric_limits<double>::infinity();
  }
  double value = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ptr != end || text.empty()) return std::nullopt;
  if (result.ec == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  if (result.ec != std::errc()) return std::nullopt;
  return value;
}

Entry::Entry(const Value& value, std::string file, std::string name)
    : value_(&value), file_(std::move(file)), name_(std::move(name)) {}

void Entry::fail(const std::string& what) const {
  throw FileError(file_ + ": " + (name_.empty() ? "" : name_ + " ") + what);
}

std::optional<Entry> Entry::find_by(std::string_view name, Matches matches) const {
  std::optional<Entry> found;
  if (!is_map()) return found;
  for (std::size_t i = 0; i < value_->items.size(); ++i) {
    if (!matches(value_->names[i], name)) continue;
    std::string path = name_.empty() ? "" : name_ + ".";
    path += printable(value_->names[i]);
    if (found) found->fail("appears twice; remove one of them");
    found.emplace(value_->items[i], file_, std::move(path));
  }
  return found;
}

std::optional<Entry> Entry::find(std::string_view name) const { return find_by(name, equal); }

std::optional<Entry> Entry::find_any_case(std::string_view name) const {
  return find_by(name, equal_any_case);
}

std::optional<Entry> Entry::find_any(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) {
    if (std::optional<Entry> entry = find(name)) return entry;
  }
  return std::nullopt;
}

Entry Entry::at(std::string_view name, std::string_view meaning) const {
  if (std::optional<Entry> entry = find(name)) return *std::move(entry);
  std::string what = name_.empty() ? "there is no entry " : "has no entry ";
  what += name;
  if (!meaning.empty()) what += " (" + std::string(meaning) + ")";
  fail(what);
}

std::vector<Entry> Entry::list() const {
  if (!is_list()) fail("is not a list");
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < value_->items.size(); ++i) {
    entries.emplace_back(value_->items[i], file_, name_ + "[" + std::to_string(i) + "]");
  }
  return entries;
}

double Entry::finite(std::string_view text) const {
  const std::optional<double> value = parse_number(text);
  if (!value && text.substr(0, 8) == "$base64$") {
    fail("is stored as base64, which is not read; write the file without it");
  }
  if (!value) fail("is '" + printable(text) + "', a number is needed");
  if (!std::isfinite(*value)) fail("is " + printable(trimmed(text)) + ", which is not finite");
  return *value;
}

double Entry::number() const {
  if (!is_scalar()) fail("is not a number");
  return finite(value_->text);
}

int Entry::integer(int least, int most) const {
  const double value = number();
  if (value != std::floor(value) || value < least || value > most) {
    fail("is " + number_text(value) + ", an integer from " + std::to_string(least) + " to " +
         std::to_string(most) + " is needed");
  }
  return static_cast<int>(value);
}

std::string Entry::text() const {
  if (!is_scalar()) fail("is not a text");
  std::string_view text = trimmed(value_->text);
  if (text.size() >= 2 && text.front() == text.back() && (text[0] == '"' || text[0] == '\'')) {
    text = text.substr(1, text.size() - 2);
  }
  return std::string(text);
}

void Entry::append_numbers(std::vector<double>& numbers) const {
  if (is_scalar()) {
    std::string_view rest = value_->text;
    while (true) {
      rest.remove_prefix(std::min(rest.find_first_not_of(kSeparators), rest.size()));
      if (rest.empty()) return;
      const std::string_view word = rest.substr(0, rest.find_first_of(kSeparators));
      numbers.push_back(finite(word));
      rest.remove_prefix(word.size());
    }
  }
  if (is_map()) fail("is not a list of numbers");
  for (const Value& item : value_->items) Entry(item, file_, name_).append_numbers(numbers);
}

std::vector<double> Entry::numbers() const {
  std::vector<double> numbers;
  if (!is_map()) {
    append_numbers(numbers);
    return numbers;
  }
  const Entry data = at("data");
  data.append_numbers(numbers);
  constexpr int kMost = 1 << 20;
  const std::optional<Entry> rows = find("rows");
  const std::optional<Entry> columns = find("cols");
  if (rows && columns) {
    const int row_count = rows->integer(0, kMost);
    const int column_count = columns->integer(0, kMost);
    if (static_cast<double>(row_count) * column_count != static_cast<double>(numbers.size())) {
      fail("has " + std::to_string(numbers.size()) + " values, but states " +
           std::to_string(row_count) + "x" + std::to_string(column_count));
    }
  }
  return numbers;
}

std::vector<double> Entry::numbers(std::size_t count, std::string_view shape) const {
  std::vector<double> values = numbers();
  if (values.size() != count) {
    fail("has " + std::to_string(values.size()) + " values, " + std::to_string(count) +
         " are needed: " + std::string(shape));
  }
  return values;
}

}  // namespace mtstereo::formats
