// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/match_properties.hpp"

#include "matcher/parameter_properties.hpp"

namespace mtstereo::plugin {
namespace {

using Lock = std::lock_guard<std::mutex>;
using Row = Property<MatchSettings>;

GType alignment_type() {
  static const GType type = enum_type<Alignment>(
      "GstMtStereoAlignment",
      {{Alignment::kOff, "Do not inspect the views", "off"},
       {Alignment::kMonitor, "Inspect the views and report the findings", "monitor"},
       {Alignment::kCorrect, "Inspect the views and correct them before matching", "correct"},
       {Alignment::kHold,
        "Correct the views by alignment-field, left-blur and right-blur without inspection",
        "hold"}});
  return type;
}

GType sharpness_type() {
  static const GType type = enum_type<Sharpness>(
      "GstMtStereoSharpness",
      {{Sharpness::kKeep, "Match the views unchanged", "keep"},
       {Sharpness::kMatch, "Blur the sharper view to match the other", "match"}});
  return type;
}

/// A choice whose default depends on the preset.
template <typename Enum>
Row preset_choice(const char* name, std::optional<Enum> AlignmentSettings::*field,
                  Enum (AlignmentSettings::*effective)(Preset) const, GType type,
                  const char* blurb) {
  const auto usual = static_cast<gint>((AlignmentSettings().*effective)(Preset::kDefault));
  return {g_param_spec_enum(name, name, blurb, type, usual, kWhilePlaying),
          [field](MatchSettings& settings, const GValue& value) {
            settings.alignment.*field = static_cast<Enum>(g_value_get_enum(&value));
            return Status();
          },
          [effective](const MatchSettings& settings, GValue& value) {
            const Preset preset = settings.parameters.preset();
            g_value_set_enum(&value, static_cast<gint>((settings.alignment.*effective)(preset)));
          }};
}

Status set_field(MatchSettings& settings, const GValue& value) {
  const gchar* text = g_value_get_string(&value);
  std::optional<RowField> field;
  if (text != nullptr && *text != '\0') {
    const Result<RowField> parsed = RowField::parse(text);
    if (!parsed) return parsed.error();
    field = *parsed;
  }
  settings.alignment.field = field;
  ++settings.alignment.field_revision;
  return {};
}

void get_field(const MatchSettings& settings, GValue& value) {
  const std::optional<RowField>& field = settings.alignment.field;
  g_value_set_string(&value, field ? field->to_text().c_str() : "");
}

Status set_scale(MatchSettings& settings, const GValue& value) {
  settings.disparity_scale = g_value_get_int(&value);
  settings.scale_is_set = true;
  return {};
}

void get_scale(const MatchSettings& settings, GValue& value) {
  g_value_set_int(&value, settings.disparity_scale);
}

std::vector<Row> own_rows() {
  return {
      preset_choice("alignment", &AlignmentSettings::alignment,
                    &AlignmentSettings::effective_alignment, alignment_type(),
                    "Correction of misaligned rows of the right view, as after a shock or with an "
                    "inexact calibration (default: correct; preset paper: off)"),
      Row("alignment-interval", {&MatchSettings::alignment, &AlignmentSettings::interval}, 0,
          1000000,
          "Number of pairs between inspections of the views; the first pairs are inspected until "
          "their alignment is known (0: 30, or more for small frames, search ranges and preset "
          "fast, "
          "so that inspections take at most 3 % of the time)"),
      {g_param_spec_string("alignment-field", "alignment-field",
                           "Row displacement of the right view: five numbers in px, separated by "
                           "commas; empty if unknown. Store the value read here and set it at the "
                           "next start",
                           "", kWhilePlaying),
       set_field, get_field},
      preset_choice("sharpness", &AlignmentSettings::sharpness,
                    &AlignmentSettings::effective_sharpness, sharpness_type(),
                    "Handling of views of different sharpness; needs alignment=correct "
                    "(default: match; preset paper: keep)"),
      Row("left-blur", {&MatchSettings::alignment, &AlignmentSettings::left_blur}, 0, kLargestBlur,
          "With alignment=hold, sigma of the blur of the left view in px (0: none)"),
      Row("right-blur", {&MatchSettings::alignment, &AlignmentSettings::right_blur}, 0,
          kLargestBlur, "With alignment=hold, sigma of the blur of the right view in px (0: none)"),
      {g_param_spec_int(
           "disparity-scale", "disparity-scale",
           "Steps per px of the output: disparity in px = value / disparity-scale, 0 "
           "= unknown; plus min-disparity if that is negative; the number of disparities "
           "times this value must fit in 16 bits (256: KITTI, 16: OpenCV). If it is "
           "not set and 256 does not fit: the next of 128, 64, ... that does",
           1, 65535, MatchSettings().disparity_scale, kWhilePlaying),
       set_scale, get_scale},
      {"confidence-map", &MatchSettings::confidence_map,
       "Attach a confidence map to each disparity map: field \"confidence\" of the meta "
       "MtStereoConfidenceMeta, a GRAY8 sample with values from 1 (lowest) to 255 (highest), 0 = "
       "no disparity"},
  };
}

}  // namespace

const PropertyTable<MatchSettings>& match_properties() {
  static const PropertyTable<MatchSettings> table(parameter_rows(), own_rows());
  return table;
}

Status MatchProperties::set(guint id, const GValue& value) {
  const Lock lock(mutex_);
  const Status status = match_properties().row(id).set(current_, value);
  if (!status && started_) return status;
  current_.fit_scale();
  ++current_.revision;
  if (!status) {
    current_.problem = status.error().message;
    current_.problem_property = id;
  } else if (current_.problem_property == id) {
    current_.problem.clear();
    current_.problem_property = 0;
  }
  return {};
}

void MatchProperties::get(guint id, const AlignmentReport& report, GValue& value) const {
  MatchSettings shown = current();
  if (const auto found = report.current_field(shown.alignment)) shown.alignment.field = found;
  match_properties().get(shown, id, value);
}

void MatchProperties::commit() {
  const Lock lock(mutex_);
  if (committed_.revision != current_.revision) committed_ = current_;
}

MatchSettings MatchProperties::committed() const {
  const Lock lock(mutex_);
  return committed_;
}

guint64 MatchProperties::committed_revision() const {
  const Lock lock(mutex_);
  return committed_.revision;
}

MatchSettings MatchProperties::current() const {
  const Lock lock(mutex_);
  return current_;
}

std::optional<MatchSettings> MatchProperties::restore(const MatchSettings& refused,
                                                      const MatchSettings& last) {
  const Lock lock(mutex_);
  if (current_.revision != refused.revision) return std::nullopt;
  current_.parameters = last.parameters;
  current_.disparity_scale = last.disparity_scale;
  current_.scale_is_set = last.scale_is_set;
  committed_ = current_;
  return current_;
}

void MatchProperties::set_started(bool started) {
  const Lock lock(mutex_);
  started_ = started;
}

bool MatchProperties::started() const {
  const Lock lock(mutex_);
  return started_;
}

}  // namespace mtstereo::plugin
