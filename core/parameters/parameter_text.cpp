// SPDX-License-Identifier: LGPL-2.1-or-later
#include "parameters/parameter_text.hpp"

#include <charconv>

#include "base/limits.hpp"

namespace mtstereo {

std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

std::string range_text(const ParameterInfo& info) {
  const std::string unit = *info.unit != '\0' ? std::string(" ") + info.unit : "";
  switch (info.type) {
    case ParameterType::kBoolean:
      return "false or true";
    case ParameterType::kChoice: {
      std::string words = info.choices;
      for (size_t at = 0; (at = words.find('|', at)) != std::string::npos; at += 4) {
        words.replace(at, 1, " or ");
      }
      return words;
    }
    case ParameterType::kLevels:
      return "up to " + std::to_string(kMostNodeLevels) +
             " integers in strictly descending order, the first at most " +
             number_text(info.maximum) + " and the last 0, as in \"1,0\"";
    case ParameterType::kInteger:
    case ParameterType::kNumber:
      break;
  }
  std::string text = number_text(info.minimum) + " to " + number_text(info.maximum) + unit;
  if (is_odd_only(info.id)) text += ", odd";
  return text;
}

bool parse_number(std::string_view text, double& value) {
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  return end.ec == std::errc() && end.ptr == text.data() + text.size();
}

int choice_index(std::string_view choices, std::string_view word) {
  for (int index = 0;; ++index) {
    const size_t bar = choices.find('|');
    if (choices.substr(0, bar) == word) return index;
    if (bar == std::string_view::npos) return -1;
    choices.remove_prefix(bar + 1);
  }
}

std::string_view choice_word(std::string_view choices, int index) {
  for (; index > 0; --index) choices.remove_prefix(choices.find('|') + 1);
  return choices.substr(0, choices.find('|'));
}

bool parse_levels(std::string_view text, Parameters::Levels& levels) {
  Parameters::Levels parsed;
  while (true) {
    const size_t comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    int level = 0;
    const auto end = std::from_chars(item.data(), item.data() + item.size(), level);
    if (end.ec != std::errc() || end.ptr != item.data() + item.size()) return false;
    if (level < 0 || level > kLargestNodeLevel) return false;
    if (parsed.count == static_cast<int>(parsed.level.size())) return false;
    if (parsed.count > 0 && level >= parsed.level[parsed.count - 1]) return false;
    parsed.level[parsed.count++] = level;
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (parsed.level[parsed.count - 1] != 0) return false;
  levels = parsed;
  return true;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

namespace {

/// The defaults of one preset: of mode semi-dense, and in parentheses of the modes that differ.
std::string preset_defaults_text(Parameter id, Preset preset) {
  const std::string main = parameter_default(id, preset, Mode::kSemiDense);
  std::string others;
  for (const Mode mode : {Mode::kSparse, Mode::kDense, Mode::kFull}) {
    const std::string other = parameter_default(id, preset, mode);
    if (other == main) continue;
    const auto word = static_cast<int>(mode);
    others += others.empty() ? "" : ", ";
    others += choice_word(parameter_info(Parameter::kMode).choices, word);
    others += " " + other;
  }
  return others.empty() ? main : main + " (" + others + ")";
}

}  // namespace

std::string parameter_defaults_text(Parameter id) {
  if (id == Parameter::kPreset || id == Parameter::kMode) return Parameters().text(id);
  const std::string standard = preset_defaults_text(id, Preset::kDefault);
  std::string text = standard;
  for (int preset = 1; preset < kPresets; ++preset) {
    const std::string other = preset_defaults_text(id, static_cast<Preset>(preset));
    if (other == standard) continue;
    const std::string_view name = choice_word(parameter_info(Parameter::kPreset).choices, preset);
    text += "; preset " + std::string(name) + ": " + other;
  }
  return text;
}

}  // namespace mtstereo
