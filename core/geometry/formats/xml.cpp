// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <utility>

#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.' || c == ':';
}

/// Reads elements one after the other. An element with elements in it is a list if all of them
/// are called "_", and otherwise a map; one without is a scalar.
class Reader {
 public:
  Reader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  Value read() {
    skip_prolog();
    const std::string_view root = start_tag();
    if (root != "opencv_storage") {
      fail("the first element is <" + printable(root) +
           ">, <opencv_storage> is needed: write its cameras to a YAML file with the names M1, D1, "
           "M2, D2, R, T");
    }
    Value value = content(root, 0);
    if (value.kind == Value::Kind::kScalar) {
      value = {};
      value.kind = Value::Kind::kMap;
    }
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const std::string_view before = text_.substr(0, at_);
    throw FileError(file_ + ": line " +
                    std::to_string(std::count(before.begin(), before.end(), '\n') + 1) + ": " +
                    what);
  }
  bool next_is(std::string_view word) const { return text_.substr(at_, word.size()) == word; }
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
  /// Moves to the position after `end`.
  void skip_past(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) fail("the file is truncated");
    at_ = found + end.size();
  }
  void skip_prolog() {
    for (skip_blanks();; skip_blanks()) {
      if (next_is("<?")) {
        skip_past("?>");
      } else if (next_is("<!--")) {
        skip_past("-->");
      } else {
        return;
      }
    }
  }
  std::string_view name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
    if (at_ == begin) fail("the name of an element is needed");
    return text_.substr(begin, at_ - begin);
  }
  /// "<NAME ATTRIBUTES>"; `empty_` says whether it was "<NAME/>".
  std::string_view start_tag() {
    if (!next_is("<")) fail(at_ == text_.size() ? "the file is truncated" : "an element is needed");
    ++at_;
    const std::string_view tag = name();
    const std::size_t end = text_.find('>', at_);
    if (end == std::string_view::npos) fail("the file is truncated");
    empty_ = text_[end - 1] == '/';
    at_ = end + 1;
    return tag;
  }

  /// What is between the tags of an element, whose start tag is read.
  Value content(std::string_view tag, std::size_t depth) {
    Value value;
    if (empty_) return value;
    if (depth >= kDeepestNesting) fail("elements are nested too deep for a calibration");
    if (++values_ > kMostValues) fail("there are more values than any calibration has");
    while (true) {
      append_text(value.text);
      if (next_is("</")) break;
      if (next_is("<!--")) {
        skip_past("-->");
        continue;
      }
      const std::string_view child = start_tag();
      value.names.emplace_back(child);
      value.items.push_back(content(child, depth + 1));
    }
    at_ += 2;
    if (name() != tag) fail("</" + printable(tag) + "> is needed");
    skip_past(">");
    empty_ = false;
    set_kind(value);
    return value;
  }
  static void set_kind(Value& value) {
    if (value.items.empty()) return;
    value.text.clear();
    value.kind = Value::Kind::kMap;
    if (std::any_of(value.names.begin(), value.names.end(),
                    [](const std::string& child) { return child != "_"; })) {
      return;
    }
    value.kind = Value::Kind::kList;
    value.names.clear();
  }
  /// The text up to the next tag, with its entities replaced.
  void append_text(std::string& out) {
    const std::size_t end = text_.find('<', at_);
    if (end == std::string_view::npos) fail("the file is truncated");
    while (at_ < end) {
      if (text_[at_] != '&') {
        out += text_[at_++];
        continue;
      }
      append_entity(out);
    }
  }
  void append_entity(std::string& out) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
        {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}}};
    for (const auto& [entity, character] : kEntities) {
      if (!next_is(entity)) continue;
      out += character;
      at_ += entity.size();
      return;
    }
    fail("an entity is not known: " + printable(text_.substr(at_, 8)));
  }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::size_t values_ = 0;
  bool empty_ = false;
};

}  // namespace

Value parse_xml(std::string_view text, const std::string& file) {
  return Reader(text, file).read();
}

}  // namespace mtstereo::formats
