// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/outputs/printable.hpp"

#include <glib.h>

#include <array>
#include <charconv>
#include <cstdio>

namespace mtstereo::outputs {
namespace {

constexpr std::size_t kEscape = 4;  // bytes of "\xHH"

void append_bytes(std::string_view bytes, std::string& text) {
  for (const char byte : bytes) {
    std::array<char, kEscape + 1> escape{};
    std::snprintf(escape.data(), escape.size(), "\\x%02x", static_cast<unsigned char>(byte));
    text += escape.data();
  }
}

// The length of the valid character at the beginning; 0 if there is none.
std::size_t character_length(std::string_view text) {
  const gunichar character =
      g_utf8_get_char_validated(text.data(), static_cast<gssize>(text.size()));
  constexpr auto kInvalid = static_cast<gunichar>(-2);
  if (character >= kInvalid) return 0;
  return static_cast<std::size_t>(g_unichar_to_utf8(character, nullptr));
}

bool is_control(std::string_view character) {
  return g_unichar_iscntrl(g_utf8_get_char(character.data())) != FALSE;
}

std::string with_escapes(std::string_view text, char kept, char also) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = text.front() == '\0' ? 0 : character_length(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    const bool plain = length > 0 && !is_control(character) && text.front() != also;
    if (plain || (kept != '\0' && text.front() == kept)) {
      result += character;
    } else {
      append_bytes(character, result);
    }
    text.remove_prefix(character.size());
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) { return with_escapes(text, '\0', '\0'); }

std::string printable_lines(std::string_view text) { return with_escapes(text, '\n', '\0'); }

std::string escaped(std::string_view name) { return with_escapes(name, '\0', '\\'); }

std::string unescaped(std::string_view text) {
  std::string name;
  while (!text.empty()) {
    unsigned char byte = 0;
    const std::string_view escape = text.substr(0, kEscape);
    const char* const end = escape.data() + escape.size();
    if (escape.size() == kEscape && escape.starts_with("\\x") &&
        std::from_chars(escape.data() + 2, end, byte, 16).ptr == end) {
      name += static_cast<char>(byte);
      text.remove_prefix(kEscape);
    } else {
      name += text.front();
      text.remove_prefix(1);
    }
  }
  return name;
}

}  // namespace mtstereo::outputs
