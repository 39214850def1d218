// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/parameter_properties.hpp"

#include <gst/gst.h>

#include <algorithm>
#include <cctype>
#include <deque>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace mtstereo::plugin {
namespace {

/// The strings and values to which the type system keeps pointers until the program ends.
struct EnumType {
  std::string type_name;
  std::deque<std::string> words, help;
  std::vector<GEnumValue> values;  // terminated by an entry of zeros
};

// "cost-volume" -> "GstMtStereoCostVolume"
std::string enum_type_name(std::string_view parameter) {
  std::string name = "GstMtStereo";
  bool upper = true;
  for (const char c : parameter) {
    if (c == '-') {
      upper = true;
      continue;
    }
    name += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = false;
  }
  return name;
}

/// Others rarely need a change. gst-inspect-1.0 lists properties by their names, so it cannot list
/// those for experts last.
bool is_for_experts(Parameter id) {
  constexpr Parameter kMain[] = {
      Parameter::kPreset,       Parameter::kMode,        Parameter::kMaxDisparity,
      Parameter::kMinDisparity, Parameter::kResolution,  Parameter::kThreads,
      Parameter::kNoiseFilter,  Parameter::kSpeckleSize, Parameter::kMinConfidence,
      Parameter::kThinObjects,  Parameter::kMaxGap,      Parameter::kTemporal};
  return std::find(std::begin(kMain), std::end(kMain), id) == std::end(kMain);
}

/// The text with a capital as its first letter.
std::string sentence(std::string text) {
  if (!text.empty()) text.front() = g_ascii_toupper(text.front());
  return text;
}

/// Registers the enumeration of a parameter: the nick of a value is its word, the name its
/// description.
GType choice_type(const ParameterInfo& info) {
  // Never freed, because types exist until the program ends.
  static auto* const types = new std::deque<EnumType>;
  EnumType* made = &types->emplace_back();
  made->type_name = enum_type_name(info.name);
  std::string_view rest = info.choices;
  while (!rest.empty()) {
    const std::size_t bar = rest.find('|');
    made->words.emplace_back(rest.substr(0, bar));
    rest = bar == std::string_view::npos ? std::string_view() : rest.substr(bar + 1);
  }
  for (std::size_t i = 0; i < made->words.size(); ++i) {
    made->help.push_back(sentence(info.choice_help[i]));
    made->values.push_back(
        {static_cast<gint>(i), made->help.back().c_str(), made->words[i].c_str()});
  }
  made->values.push_back({0, nullptr, nullptr});
  const GType type = g_enum_register_static(made->type_name.c_str(), made->values.data());
  gst_type_mark_as_plugin_api(type, static_cast<GstPluginAPIFlags>(0));
  return type;
}

std::string blurb_of(const ParameterInfo& info) {
  std::string text =
      is_for_experts(info.id) ? std::string("Expert: ") + info.help : sentence(info.help);
  if (*info.unit != '\0') text += std::string(". Unit: ") + info.unit;
  const std::string defaults = parameter_defaults_text(info.id);
  if (defaults != Parameters().text(info.id)) text += ". Default: " + defaults;
  if (*info.symbol != '\0') text += std::string(". Symbol in the paper: ") + info.symbol;
  return text;
}

GParamSpec* make_property(const ParameterInfo& info) {
  const Parameters defaults;
  const std::string blurb = blurb_of(info);
  const auto flags = static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_NAME |
                                              G_PARAM_STATIC_NICK | GST_PARAM_MUTABLE_PLAYING);
  const auto controllable = static_cast<GParamFlags>(flags | GST_PARAM_CONTROLLABLE);
  switch (info.type) {
    case ParameterType::kInteger:
      return g_param_spec_int(info.name, info.name, blurb.c_str(), static_cast<gint>(info.minimum),
                              static_cast<gint>(info.maximum),
                              static_cast<gint>(defaults.get(info.id)), controllable);
    case ParameterType::kNumber:
      return g_param_spec_double(info.name, info.name, blurb.c_str(), info.minimum, info.maximum,
                                 defaults.get(info.id), controllable);
    case ParameterType::kBoolean:
      return g_param_spec_boolean(info.name, info.name, blurb.c_str(), defaults.get(info.id) != 0,
                                  controllable);
    case ParameterType::kChoice:
      return g_param_spec_enum(info.name, info.name, blurb.c_str(), choice_type(info),
                               static_cast<gint>(defaults.get(info.id)), flags);
    case ParameterType::kLevels:
      break;
  }
  return g_param_spec_string(info.name, info.name, blurb.c_str(), defaults.text(info.id).c_str(),
                             flags);
}

Status set_parameter(Parameters& parameters, const ParameterInfo& info, const GValue& value) {
  switch (info.type) {
    case ParameterType::kInteger:
      return parameters.set(info.id, static_cast<double>(g_value_get_int(&value)));
    case ParameterType::kNumber:
      return parameters.set(info.id, g_value_get_double(&value));
    case ParameterType::kBoolean:
      return parameters.set(info.id, g_value_get_boolean(&value) ? 1.0 : 0.0);
    case ParameterType::kChoice:
      return parameters.set(info.id, static_cast<double>(g_value_get_enum(&value)));
    case ParameterType::kLevels:
      break;
  }
  const gchar* text = g_value_get_string(&value);
  return parameters.set(info.id, std::string_view(text != nullptr ? text : ""));
}

void get_parameter(const Parameters& parameters, const ParameterInfo& info, GValue& value) {
  switch (info.type) {
    case ParameterType::kInteger:
      g_value_set_int(&value, parameters.integer(info.id));
      return;
    case ParameterType::kNumber:
      g_value_set_double(&value, parameters.get(info.id));
      return;
    case ParameterType::kBoolean:
      g_value_set_boolean(&value, parameters.get(info.id) != 0);
      return;
    case ParameterType::kChoice:
      g_value_set_enum(&value, static_cast<gint>(parameters.get(info.id)));
      return;
    case ParameterType::kLevels:
      break;
  }
  g_value_set_string(&value, parameters.text(info.id).c_str());
}

}  // namespace

std::vector<Property<MatchSettings>> parameter_rows() {
  std::vector<Property<MatchSettings>> rows;
  for (const ParameterInfo& info : parameter_table()) {
    rows.emplace_back(
        make_property(info),
        [&info](MatchSettings& settings, const GValue& value) {
          return set_parameter(settings.parameters, info, value);
        },
        [&info](const MatchSettings& settings, GValue& value) {
          get_parameter(settings.parameters, info, value);
        });
  }
  return rows;
}

}  // namespace mtstereo::plugin
