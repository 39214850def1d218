// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/alignment_reports.hpp"

#include <cstdio>

namespace mtstereo::plugin {
namespace {

/// Shortest time between two messages of an element [us], wall clock.
constexpr gint64 kMessageInterval = G_USEC_PER_SEC;

const char* name_of(int problem) {
  return problem == kOneImage ? "one-image" : problem_name(static_cast<PairProblem>(problem));
}

const char* text_of(int problem) {
  return problem == kOneImage
             ? "Both views are the same image: link the left camera to sink_left and the right one "
               "to sink_right."
             : problem_text(static_cast<PairProblem>(problem));
}

std::string problem_names(std::uint32_t problems) {
  std::string names;
  for (int i = 0; i <= kOneImage; ++i) {
    if ((problems >> i & 1) == 0) continue;
    if (!names.empty()) names += ",";
    names += name_of(i);
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

void AlignmentReports::warn(std::uint32_t problems, const AlignmentReport& report) {
  for (int i = 0; i <= kOneImage; ++i) {
    if ((problems >> i & 1) == 0) continue;
    messages_.warning(text_of(i), findings_text(report.findings));
  }
}

void AlignmentReports::announce(const AlignmentReport& report) {
  if (report.applied == announced_) return;
  const gint64 now = g_get_monotonic_time();
  if (time_ && now - *time_ < kMessageInterval) return;
  announced_ = report.applied;
  time_ = now;
  GstStructure* structure = gst_structure_new_empty("mtstereo-alignment");
  add_alignment_fields(structure, report);
  gst_element_post_message(
      messages_.element(),
      gst_message_new_element(GST_OBJECT_CAST(messages_.element()), structure));
}

}  // namespace mtstereo::plugin
