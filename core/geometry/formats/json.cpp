// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <nlohmann/json.hpp>

#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

/// Builds the tree. Numbers stay the text of the file, so that nothing is rounded twice.
class JsonHandler : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonHandler(std::string_view text, const std::string& file)
      : builder_(file), text_(text), file_(file) {}

  Value take() { return builder_.take(); }

  bool null() override { return add(""); }
  bool boolean(bool value) override { return add(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return add(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { return add(std::to_string(value)); }
  bool number_float(number_float_t /*value*/, const string_t& text) override { return add(text); }
  bool string(string_t& text) override { return add(text); }
  bool binary(binary_t& /*bytes*/) override { return false; }
  bool start_object(std::size_t /*elements*/) override {
    builder_.begin(Value::Kind::kMap);
    return true;
  }
  bool key(string_t& name) override { return add(name); }
  bool end_object() override {
    builder_.end();
    return true;
  }
  bool start_array(std::size_t /*elements*/) override {
    builder_.begin(Value::Kind::kList);
    return true;
  }
  bool end_array() override { return end_object(); }
  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::detail::exception& /*error*/) override {
    const std::string_view before = text_.substr(0, position);
    throw FileError(file_ + ": line " +
                    std::to_string(std::count(before.begin(), before.end(), '\n') + 1) +
                    " is not valid JSON, or the file is truncated");
  }

 private:
  bool add(const std::string& text) {
    builder_.add_text(text);
    return true;
  }

  TreeBuilder builder_;
  std::string_view text_;
  std::string file_;
};

}  // namespace

Value parse_json(const std::string& text, const std::string& file) {
  JsonHandler handler(text, file);
  constexpr bool kStrict = true, kComments = true;
  nlohmann::json::sax_parse(text, &handler, nlohmann::json::input_format_t::json, kStrict,
                            kComments);
  return handler.take();
}

}  // namespace mtstereo::formats
