// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/cloud_location.hpp"

#include <glib.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace mtstereo::plugin {
namespace {

constexpr int kMostDigits = 20;

Error refusal(const std::string& pattern, const char* reason) {
  return {ErrorCode::kInvalidParameter, "location=" + pattern + " " + reason};
}

std::optional<CloudFormat> format_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  std::string extension(path.substr(dot + 1));
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (extension == "ply") return CloudFormat::kPly;
  if (extension == "pcd") return CloudFormat::kPcd;
  return std::nullopt;
}

/// A number of a pattern, such as 05d; the percent sign precedes it.
struct Number {
  int digits = 0;
  char fill = ' ';
  std::size_t length = 0;  ///< of its text
};

std::optional<Number> number_in(std::string_view text) {
  Number number;
  if (!text.empty() && text[0] == '0') number.fill = '0';
  while (number.length < text.size() && text[number.length] >= '0' && text[number.length] <= '9') {
    number.digits = number.digits * 10 + (text[number.length++] - '0');
    if (number.digits > kMostDigits) return std::nullopt;
  }
  if (number.length == text.size() || text[number.length] != 'd') return std::nullopt;
  ++number.length;
  return number;
}

}  // namespace

Result<CloudLocation> CloudLocation::parse(const std::string& pattern,
                                           std::optional<CloudFormat> format) {
  if (pattern.empty()) {
    return Error{ErrorCode::kInvalidParameter,
                 "location is not set: set it to the path of the files, such as cloud-%05d.ply"};
  }
  CloudLocation location;
  const std::string_view text = pattern;
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string& part = location.digits_ ? location.after_ : location.before_;
    if (text[at] != '%') {
      part += text[at];
    } else if (at + 1 < text.size() && text[at + 1] == '%') {
      part += text[at++];
    } else {
      const std::optional<Number> number = number_in(text.substr(at + 1));
      if (!number || location.digits_) {
        return refusal(pattern,
                       "is not valid: it may have one number of at most 20 digits, such as %d or "
                       "%05d, and %% for a percent sign");
      }
      location.digits_ = number->digits;
      location.fill_ = number->fill;
      at += number->length;
    }
  }
  if (!format) format = format_of(location.after_.empty() ? location.before_ : location.after_);
  if (!format) return refusal(pattern, "ends neither in .ply nor in .pcd: set the property format");
  location.format_ = *format;
  return location;
}

std::string CloudLocation::path(std::uint64_t number) const {
  if (!digits_) return before_;
  std::string text = std::to_string(number);
  const auto digits = static_cast<std::size_t>(*digits_);
  if (text.size() < digits) text.insert(0, digits - text.size(), fill_);
  return before_ + text + after_;
}

std::string utf8_path(const std::string& path) {
  if (g_utf8_validate(path.c_str(), -1, nullptr)) return path;
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const char* position = path.c_str(); *position != '\0';) {
    const char* end = position;
    g_utf8_validate(position, -1, &end);
    for (; position < end; ++position) {
      text += *position == '\\' ? std::string("\\x5c") : std::string(1, *position);
    }
    if (*position == '\0') break;
    const auto byte = static_cast<unsigned char>(*position++);
    text += std::string("\\x") + kDigits[byte / 16] + kDigits[byte % 16];
  }
  return text;
}

}  // namespace mtstereo::plugin
