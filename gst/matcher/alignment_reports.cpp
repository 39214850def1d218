// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/alignment_reports.hpp"

#include <cstdio>

#include "shared/ownership.hpp"

namespace mtstereo::plugin {
namespace {

/// Shortest time between two messages of an element [us], wall clock.
constexpr gint64 kMessageInterval = G_USEC_PER_SEC;

std::string problem_names(std::uint32_t problems) {
  std::string names;
  for (int i = 0; i < kPairProblems; ++i) {
    if ((problems >> i & 1) == 0) continue;
    if (!names.empty()) names += ",";
    names += problem_name(static_cast<PairProblem>(i));
  }
  return names;
}

std::string findings_text(const PairFindings& findings) {
  char text[200];
  std::snprintf(text, sizeof text,
                "last inspection: %s, %d of %d corners found, %d agree, residual %.2f px, "
                "sharpness left / right %.2f",
                field_status_text(findings.status), findings.matches, findings.candidates,
                findings.inliers, findings.residual, findings.sharpness_ratio);
  return text;
}

void warn_of_problems(ElementState& state, const AlignmentReport& report) {
  const std::uint32_t news = state.alignment.new_problems();
  for (int i = 0; i < kPairProblems; ++i) {
    if ((news >> i & 1) == 0) continue;
    post_warning(state, problem_text(static_cast<PairProblem>(i)),
                 findings_text(report.findings) + "; " + state.streams_text());
  }
}

/// Announces a change of the correction. A change soon after another one is announced later, unless
/// it was undone.
void announce_correction(ElementState& state, const AlignmentReport& report) {
  AnnouncedCorrection& last = state.announced;
  if (report.applied == last.correction) return;
  const gint64 now = g_get_monotonic_time();
  if (last.time && now - *last.time < kMessageInterval) return;
  last.correction = report.applied;
  last.time = now;
  GstStructure* structure = gst_structure_new_empty("mtstereo-alignment");
  add_alignment_fields(structure, report);
  gst_element_post_message(GST_ELEMENT_CAST(state.element),
                           gst_message_new_element(GST_OBJECT_CAST(state.element), structure));
}

}  // namespace

void add_alignment_fields(GstStructure* structure, const AlignmentReport& report) {
  const RowField field = report.field.value_or(RowField{});
  gst_structure_set(structure, "offset", G_TYPE_DOUBLE, field.offset, "roll", G_TYPE_DOUBLE,
                    report.roll_degrees, "residual", G_TYPE_DOUBLE, report.findings.residual,
                    "trust", G_TYPE_BOOLEAN, report.trusted, "applied", G_TYPE_BOOLEAN,
                    !(report.applied == ViewCorrection{}), "inspections", G_TYPE_UINT64,
                    static_cast<guint64>(report.inspections), "sharpness", G_TYPE_DOUBLE,
                    report.findings.sharpness_ratio, "left-blur", G_TYPE_DOUBLE,
                    static_cast<double>(report.applied.left_blur), "right-blur", G_TYPE_DOUBLE,
                    static_cast<double>(report.applied.right_blur), "problem", G_TYPE_STRING,
                    problem_names(report.problems).c_str(), nullptr);
}

void publish_alignment(ElementState& state) {
  const AlignmentReport& report = state.alignment.report();
  bool field_changed = false;
  {
    const ObjectLock lock(state.element);
    // A field that was set in the meantime is not overwritten by the one of the last pair.
    const bool current =
        state.settings.alignment.field_revision == state.active.alignment.field_revision;
    const std::optional<RowField> before = state.alignment_report.field;
    state.alignment_report = report;
    if (!current) state.alignment_report.field = before;
    field_changed = state.alignment_report.field != before;
  }
  if (field_changed) g_object_notify(G_OBJECT(state.element), "alignment-field");
  warn_of_problems(state, report);
  announce_correction(state, report);
}

}  // namespace mtstereo::plugin
