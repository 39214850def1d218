// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/view_correction.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/outputs/texts.hpp"
#include "recordings/matching/view_checks.hpp"
#include "recordings/matching/view_inspection.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

// What was seen in the views directly.
void note_seen(Work& work, const ViewInspection& findings) {
  for (const PairProblem problem :
       {PairProblem::kSharpnessDiffers, PairProblem::kLeftBlank, PairProblem::kRightBlank,
        PairProblem::kLeftFrozen, PairProblem::kRightFrozen}) {
    if (findings.has(problem)) work.remarks.emplace_back(problem_text(problem));
  }
}

bool is_suspicious(const ViewInspection& findings) {
  constexpr double kLowDensity = 0.3;
  constexpr double kPile = 0.02;  // of the disparities
  constexpr double kFar = 0.5;    // [px]
  const bool blank =
      findings.has(PairProblem::kLeftBlank) || findings.has(PairProblem::kRightBlank);
  return !blank && (findings.has(PairProblem::kSwapped) || findings.has(PairProblem::kNotAPair) ||
                    findings.has(PairProblem::kOutOfStep) || findings.density < kLowDensity ||
                    findings.near_end >= kPile || std::abs(findings.median) < kFar);
}

// Tests what is wrong with the views, if the maps of the samples are a reason to.
void note_diagnosis(Work& work, const ViewInspection& findings) {
  if (!is_suspicious(findings)) return;
  const ViewDiagnosis found = diagnose_views(work, findings);
  std::string text = diagnosis_text(found, work.recording.calibration, suggests_sync(work));
  if (text.empty() && findings.has(PairProblem::kOutOfStep)) {
    text = problem_text(PairProblem::kOutOfStep);
  }
  if (text.empty()) return;
  work.remarks.push_back(text);
  if (found.worthless()) work.doubt = text;
}

// The extreme displacements of the rows of a view.
std::string field_text(const RowExtremes& rows) {
  if (rows.largest() < kVisibleRows) return "";
  const std::string text = rows_text(rows);
  return "The rows of the right view are " + text +
         (text.find(" to ") != std::string::npos ? " over the image" : "") +
         ": corrected in all pairs.";
}

void note_correction(Work& work, const ViewInspection& findings) {
  const std::string rows = field_text(rows_of(findings, view_size(work)));
  if (!rows.empty()) work.remarks.push_back(rows);
  const double blur = std::max(findings.left_blur, findings.right_blur);
  if (blur == 0) return;
  work.remarks.push_back(outputs::format(
      "The %s view is sharper: blurred like the other one (sigma %.2f px) in all pairs.",
      findings.left_blur > 0 ? "left" : "right", blur));
}

}  // namespace

bool is_corrected(const WorkOptions& options) {
  const std::string wanted = property_of(options, "alignment");
  const bool published = matcher_parameters(options).preset() == Preset::kPaper;
  return wanted != "off" && !(wanted.empty() && published);
}

void measure_correction(Work& work) {
  if (!is_corrected(work.options)) {
    work.correction = {{"alignment", "off"}};
    return;
  }
  const ViewInspection findings = inspect_views(work);
  note_seen(work, findings);
  note_diagnosis(work, findings);
  note_correction(work, findings);
  work.correction = correction_of(findings);
}

}  // namespace mtstereo::run
