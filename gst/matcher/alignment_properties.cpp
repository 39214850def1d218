// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/alignment_properties.hpp"

#include <gst/gst.h>

#include <string_view>

namespace mtstereo::plugin {
namespace {

GType registered(const char* name, const GEnumValue* values) {
  const GType type = g_enum_register_static(name, values);
  gst_type_mark_as_plugin_api(type, static_cast<GstPluginAPIFlags>(0));
  return type;
}

GType alignment_type() {
  static const GEnumValue values[] = {
      {static_cast<gint>(Alignment::kOff), "The views are not inspected", "off"},
      {static_cast<gint>(Alignment::kMonitor),
       "The views are inspected, and the findings are reported", "monitor"},
      {static_cast<gint>(Alignment::kCorrect),
       "The views are inspected, and corrected before they are matched", "correct"},
      {static_cast<gint>(Alignment::kHold),
       "The views are not inspected, and corrected by alignment-field, left-blur and right-blur",
       "hold"},
      {0, nullptr, nullptr}};
  static const GType type = registered("GstMtStereoAlignment", values);
  return type;
}

GType sharpness_type() {
  static const GEnumValue values[] = {
      {static_cast<gint>(Sharpness::kKeep), "The views are matched as they are", "keep"},
      {static_cast<gint>(Sharpness::kMatch), "The sharper view is blurred like the other one",
       "match"},
      {0, nullptr, nullptr}};
  static const GType type = registered("GstMtStereoSharpness", values);
  return type;
}

Status set_field(AlignmentSettings& settings, const gchar* text) {
  std::optional<RowField> field;
  if (text != nullptr && *text != '\0') {
    const Result<RowField> parsed = RowField::parse(text);
    if (!parsed) return parsed.error();
    field = *parsed;
  }
  settings.field = field;
  ++settings.field_revision;
  return {};
}

constexpr auto kFlags = static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS |
                                                 GST_PARAM_MUTABLE_PLAYING);

void install_blur(GObjectClass* object_class, guint id, const char* name, const char* blurb) {
  g_object_class_install_property(
      object_class, id, g_param_spec_double(name, name, blurb, 0, kLargestBlur, 0, kFlags));
}

}  // namespace

void install_alignment_properties(GObjectClass* object_class) noexcept {
  g_object_class_install_property(
      object_class, kAlignment,
      g_param_spec_enum("alignment", "alignment",
                        "What to do about rows of the right view that are out of place, as after "
                        "a shock or with an inexact calibration (default: correct; preset paper: "
                        "off)",
                        alignment_type(), static_cast<gint>(Alignment::kCorrect), kFlags));
  g_object_class_install_property(
      object_class, kAlignmentInterval,
      g_param_spec_int("alignment-interval", "alignment-interval",
                       "Pairs from one inspection of the views to the next; the first pairs are "
                       "inspected until their alignment is known (0: 30, or more for small frames, "
                       "search ranges and preset fast, so that inspections take at most 3 % of "
                       "the time)",
                       0, 1000000, 0, kFlags));
  g_object_class_install_property(
      object_class, kAlignmentField,
      g_param_spec_string("alignment-field", "alignment-field",
                          "Row displacement of the right view: five numbers in px, separated by "
                          "commas; empty if it is unknown. Store the value that is read, and set "
                          "it to start with it the next time",
                          "", kFlags));
  g_object_class_install_property(
      object_class, kSharpness,
      g_param_spec_enum("sharpness", "sharpness",
                        "What to do if one view is sharper than the other; needs "
                        "alignment=correct (default: match; preset paper: keep)",
                        sharpness_type(), static_cast<gint>(Sharpness::kMatch), kFlags));
  install_blur(object_class, kLeftBlur, "left-blur",
               "With alignment=hold, sigma of the blur of the left view in px (0: none)");
  install_blur(object_class, kRightBlur, "right-blur",
               "With alignment=hold, sigma of the blur of the right view in px (0: none)");
}

bool is_alignment_property(guint id) { return id >= kAlignment && id <= kRightBlur; }

Status set_alignment_from_value(AlignmentSettings& settings, guint id, const GValue& value) {
  switch (id) {
    case kAlignment:
      settings.alignment = static_cast<Alignment>(g_value_get_enum(&value));
      return {};
    case kAlignmentInterval:
      settings.interval = g_value_get_int(&value);
      return {};
    case kSharpness:
      settings.sharpness = static_cast<Sharpness>(g_value_get_enum(&value));
      return {};
    case kLeftBlur:
      settings.left_blur = static_cast<float>(g_value_get_double(&value));
      return {};
    case kRightBlur:
      settings.right_blur = static_cast<float>(g_value_get_double(&value));
      return {};
    default:
      return set_field(settings, g_value_get_string(&value));
  }
}

void alignment_to_value(const AlignmentSettings& settings, Preset preset,
                        const std::optional<RowField>& known, guint id, GValue& value) {
  switch (id) {
    case kAlignment:
      g_value_set_enum(&value, static_cast<gint>(settings.effective_alignment(preset)));
      return;
    case kAlignmentInterval:
      g_value_set_int(&value, settings.interval);
      return;
    case kSharpness:
      g_value_set_enum(&value, static_cast<gint>(settings.effective_sharpness(preset)));
      return;
    case kLeftBlur:
      g_value_set_double(&value, static_cast<double>(settings.left_blur));
      return;
    case kRightBlur:
      g_value_set_double(&value, static_cast<double>(settings.right_blur));
      return;
    default:
      break;
  }
  const std::optional<RowField>& field = known ? known : settings.field;
  g_value_set_string(&value, field ? field->to_text().c_str() : "");
}

}  // namespace mtstereo::plugin
