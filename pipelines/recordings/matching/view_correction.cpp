// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/view_correction.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "lib/outputs/user_error.hpp"
#include "mtstereo/alignment.hpp"
#include "recordings/clocks/frame_pairs.hpp"
#include "recordings/matching/map_files.hpp"
#include "recordings/matching/matching_run.hpp"
#include "recordings/matching/view_geometry.hpp"
#include "recordings/matching/view_samples.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

constexpr std::int64_t kMostPairs = 12;

// What mtstereo has found on the samples.
struct Findings {
  std::string field;
  double left_blur = 0, right_blur = 0;
  bool trusted = false;
  std::string problems;
  double density = 0, median = 0;  // mean of the maps; [px]
  double near_end = 0;             // share of the disparities in the last tenth of the range

  bool has(PairProblem problem) const {
    return ("," + problems + ",").find(std::string(",") + problem_name(problem) + ",") !=
           std::string::npos;
  }
};

void add_findings(GstElement* matcher, Findings& findings) {
  g_autofree gchar* field = nullptr;
  GstStructure* stats = nullptr;
  g_object_get(matcher, "alignment-field", &field, "stats", &stats, nullptr);
  findings.field = field != nullptr ? field : "";
  gst_structure_get_double(stats, "left-blur", &findings.left_blur);
  gst_structure_get_double(stats, "right-blur", &findings.right_blur);
  gboolean trusted = FALSE;
  gst_structure_get_boolean(stats, "trust", &trusted);
  findings.trusted = trusted != FALSE;
  const gchar* const problems = gst_structure_get_string(stats, "problem");
  findings.problems = problems != nullptr ? problems : "";
  gst_structure_free(stats);
}

Findings inspect(const Work& work) {
  Work inspected = work;
  inspected.options.products.clear();
  inspected.correction = {{"alignment", "correct"}, {"alignment-interval", "1"}};
  const auto pairs = static_cast<std::int64_t>(work.pairs.pairs.size());
  const Parameters parameters = matcher_parameters(work.options);
  const int least = parameters.integer(Parameter::kMinDisparity);
  const int most = parameters.integer(Parameter::kMaxDisparity);
  MatchingRun run(inspected, sample_pairs(pairs), map_pipeline(inspected), 1);
  Findings findings;
  int maps = 0;
  while (const std::optional<PairResult> result = run.next()) {
    FrameFigures figures;
    measure_map(result->map.get(), figures);
    findings.density += figures.density;
    findings.median += figures.median_disparity;
    findings.near_end += share_from(result->map.get(), most - 0.1 * (most - least));
    ++maps;
  }
  if (maps == 0) throw UserError(work.recording.name + ": " + run.damage());
  for (double* sum : {&findings.density, &findings.median, &findings.near_end}) *sum /= maps;
  add_findings(run.matcher(), findings);
  return findings;
}

// What was seen in the views directly.
void note_seen(Work& work, const Findings& findings) {
  for (const PairProblem problem :
       {PairProblem::kSharpnessDiffers, PairProblem::kLeftBlank, PairProblem::kRightBlank,
        PairProblem::kLeftFrozen, PairProblem::kRightFrozen}) {
    if (findings.has(problem)) work.remarks.emplace_back(problem_text(problem));
  }
}

bool is_suspicious(const Findings& findings) {
  constexpr double kLowDensity = 0.3;
  constexpr double kPile = 0.02;  // of the disparities
  constexpr double kFar = 0.5;    // [px]
  const bool blank =
      findings.has(PairProblem::kLeftBlank) || findings.has(PairProblem::kRightBlank);
  return !blank && (findings.has(PairProblem::kSwapped) || findings.has(PairProblem::kNotAPair) ||
                    findings.has(PairProblem::kOutOfStep) || findings.density < kLowDensity ||
                    findings.near_end >= kPile || std::abs(findings.median) < kFar);
}

// How many frames later the right view is than the left one, as far as their motion tells.
int frames_apart(const Work& work) {
  const std::optional<double> offset = find_offset(work.recording, work.left, work.right);
  if (!offset || work.right.period <= 0) return 0;
  return static_cast<int>(std::lround(*offset * 1e9 / static_cast<double>(work.right.period)));
}

ViewDiagnosis diagnose_with(const Work& work, const Findings& findings,
                            const std::vector<int>& shifts) {
  ViewSamples views = read_view_samples(work, shifts);
  views.rows_corrected = findings.trusted;
  return views.samples.empty() ? ViewDiagnosis{} : diagnose(views);
}

// Whether frames that were not tried yet may match better.
bool may_be_farther_apart(const ViewDiagnosis& found) {
  constexpr int kTried = 3;  // frames
  return found.problem == ViewProblem::kUnknown ||
         (found.problem == ViewProblem::kOutOfStep && std::abs(found.frames) == kTried);
}

// Tests what is wrong with the views, if the maps of the samples are a reason to.
void note_diagnosis(Work& work, const Findings& findings) {
  if (!is_suspicious(findings)) return;
  // If the clocks were compared already, do not suggest it.
  const bool two = work.recording.arrangement == Arrangement::kTwoSources && !work.clocks;
  ViewDiagnosis found = diagnose_with(work, findings, {-3, -2, -1, 1, 2, 3});
  if (two && may_be_farther_apart(found)) {
    const int frames = frames_apart(work);
    const ViewDiagnosis farther = diagnose_with(work, findings, {frames - 1, frames, frames + 1});
    if (farther.problem == ViewProblem::kOutOfStep && farther.better > found.better) {
      found = farther;
    }
  }
  std::string text = diagnosis_text(found, work.recording.calibration, two);
  if (text.empty() && findings.has(PairProblem::kOutOfStep)) {
    text = problem_text(PairProblem::kOutOfStep);
  }
  if (text.empty()) return;
  work.remarks.push_back(text);
  if (found.worthless()) work.doubt = text;
}

// "0.9 px higher", "0.9 to 2.8 px higher", "0.9 px higher to 2.8 px lower"
std::string rows_text(double least, double most) {
  const auto side = [](double rows) { return rows < 0 ? "higher" : "lower"; };
  constexpr double kEqual = 0.05;  // [px]
  char text[100];
  if (most - least < kEqual) {
    std::snprintf(text, sizeof text, "%.1f px %s", std::abs(most), side(most));
  } else if (least * most < 0) {
    std::snprintf(text, sizeof text, "%.1f px higher to %.1f px lower", -least, most);
  } else {
    const double a = std::abs(least), b = std::abs(most);
    std::snprintf(text, sizeof text, "%.1f to %.1f px %s", std::min(a, b), std::max(a, b),
                  side(least + most));
  }
  return text;
}

// The extreme displacements of the rows of a view.
std::string field_text(const RowField& field, ViewSize size) {
  constexpr int kPoints = 5;
  double least = 0, most = 0;
  for (int i = 0; i < kPoints * kPoints; ++i) {
    const double rows = field.displacement((size.width - 1.0) * (i % kPoints) / (kPoints - 1),
                                           (size.height - 1.0) * (i / kPoints) / (kPoints - 1),
                                           size.width, size.height);
    least = i == 0 ? rows : std::min(least, rows);
    most = i == 0 ? rows : std::max(most, rows);
  }
  constexpr double kVisible = 0.1;  // [px]
  if (std::max(-least, most) < kVisible) return "";
  return "The rows of the right view are " + rows_text(least, most) +
         (rows_text(least, most).find(" to ") != std::string::npos ? " over the image" : "") +
         ": corrected in all pairs.";
}

void note_correction(Work& work, const Findings& findings) {
  const RowField field =
      RowField::parse(findings.field).ok() ? *RowField::parse(findings.field) : RowField{};
  const std::string rows = field_text(field, view_size(work));
  if (!rows.empty()) work.remarks.push_back(rows);
  const double blur = std::max(findings.left_blur, findings.right_blur);
  if (blur == 0) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "The %s view is sharper: blurred like the other one (sigma %.2f px) in all pairs.",
                findings.left_blur > 0 ? "left" : "right", blur);
  work.remarks.emplace_back(text);
}

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

}  // namespace

std::vector<std::int64_t> sample_pairs(std::int64_t pairs) {
  const std::int64_t count = std::min(pairs, kMostPairs);
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < count; ++i) numbers.push_back((2 * i + 1) * pairs / (2 * count));
  return numbers;
}

void measure_correction(Work& work) {
  const std::string wanted = property_of(work.options, "alignment");
  const bool published = matcher_parameters(work.options).preset() == Preset::kPaper;
  if (wanted == "off" || (wanted.empty() && published)) {
    work.correction = {{"alignment", "off"}};
    return;
  }
  Findings findings = inspect(work);
  note_seen(work, findings);
  note_diagnosis(work, findings);
  if (!findings.trusted) findings.field.clear();
  note_correction(work, findings);
  work.correction = {{"alignment", "hold"},
                     {"alignment-field", findings.field},
                     {"left-blur", text_of(findings.left_blur)},
                     {"right-blur", text_of(findings.right_blur)}};
}

}  // namespace mtstereo::run
