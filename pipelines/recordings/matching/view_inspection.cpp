// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/view_inspection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/median.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/clocks/frame_pairs.hpp"
#include "recordings/matching/map_files.hpp"
#include "recordings/matching/matching_run.hpp"
#include "recordings/matching/view_samples.hpp"

namespace mtstereo::run {
namespace {

constexpr std::int64_t kMostPairs = 12;

void add_findings(GstElement* matcher, ViewInspection& findings) {
  g_autofree gchar* field = nullptr;
  GstStructure* stats = nullptr;
  g_object_get(matcher, "alignment-field", &field, "stats", &stats, nullptr);
  gst_structure_get_double(stats, "left-blur", &findings.left_blur);
  gst_structure_get_double(stats, "right-blur", &findings.right_blur);
  gboolean trusted = FALSE;
  gst_structure_get_boolean(stats, "trust", &trusted);
  findings.trusted = trusted != FALSE;
  if (findings.trusted && field != nullptr) findings.field = field;
  const gchar* const problems = gst_structure_get_string(stats, "problem");
  findings.problems = problems != nullptr ? problems : "";
  gst_structure_free(stats);
}

// How many frames later the right view is than the left one, as far as their motion tells.
int frames_apart(const Work& work) {
  const std::optional<double> offset = find_offset(work.recording, work.left, work.right);
  if (!offset || work.right.period <= 0) return 0;
  return static_cast<int>(std::lround(*offset * 1e9 / static_cast<double>(work.right.period)));
}

ViewDiagnosis diagnose_with(const Work& work, const ViewInspection& inspection,
                            const std::vector<int>& shifts) {
  ViewSamples views = read_view_samples(work, shifts);
  views.rows_corrected = inspection.trusted;
  return views.samples.empty() ? ViewDiagnosis{} : diagnose(views);
}

// Whether frames that were not tried yet may match better.
bool may_be_farther_apart(const ViewDiagnosis& found) {
  constexpr int kTried = 3;  // frames
  return found.problem == ViewProblem::kUnknown ||
         (found.problem == ViewProblem::kOutOfStep && std::abs(found.frames) == kTried);
}

}  // namespace

bool ViewInspection::has(PairProblem problem) const {
  return ("," + problems + ",").find(std::string(",") + problem_name(problem) + ",") !=
         std::string::npos;
}

std::vector<std::int64_t> sample_pairs(std::int64_t pairs) {
  const std::int64_t count = std::min(pairs, kMostPairs);
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < count; ++i) numbers.push_back((2 * i + 1) * pairs / (2 * count));
  return numbers;
}

ViewInspection inspect_views(const Work& work) {
  Work inspected = work;
  inspected.options.products.clear();
  inspected.correction = {{"alignment", "correct"}, {"alignment-interval", "1"}};
  const auto pairs = static_cast<std::int64_t>(work.pairs.pairs.size());
  const Parameters parameters = matcher_parameters(work.options);
  const int least = parameters.integer(Parameter::kMinDisparity);
  const int most = parameters.integer(Parameter::kMaxDisparity);
  MatchingRun run(inspected, sample_pairs(pairs), map_pipeline(inspected), 1);
  ViewInspection findings;
  std::vector<double> ratios;  // of the sharpness
  int maps = 0;
  while (const std::optional<PairResult> result = run.next()) {
    FrameFigures figures;
    measure_map(result->map.get(), figures);
    findings.density += figures.density;
    findings.median += figures.median_disparity;
    findings.near_end += share_from(result->map.get(), most - 0.1 * (most - least));
    if (result->sharpness > 0) ratios.push_back(result->sharpness);
    ++maps;
  }
  if (maps == 0) throw UserError(work.recording.name + ": " + run.damage());
  for (double* sum : {&findings.density, &findings.median, &findings.near_end}) *sum /= maps;
  findings.sharpness = median(std::move(ratios));
  add_findings(run.matcher(), findings);
  return findings;
}

std::vector<std::pair<std::string, std::string>> correction_of(const ViewInspection& inspection) {
  return {{"alignment", "hold"},
          {"alignment-field", inspection.field},
          {"left-blur", outputs::format("%.9g", inspection.left_blur)},
          {"right-blur", outputs::format("%.9g", inspection.right_blur)}};
}

double RowExtremes::largest() const { return std::max(-least, most); }

RowExtremes rows_of(const ViewInspection& inspection, ViewSize size) {
  const Result<RowField> parsed = RowField::parse(inspection.field);
  const RowField field = parsed.ok() ? *parsed : RowField{};
  constexpr int kSteps = 4;
  RowExtremes extremes;
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      const double x = (size.width - 1.0) * column / kSteps;
      const double y = (size.height - 1.0) * row / kSteps;
      const double rows = field.displacement(x, y, size.width, size.height);
      const bool first = row == 0 && column == 0;
      extremes.least = first ? rows : std::min(extremes.least, rows);
      extremes.most = first ? rows : std::max(extremes.most, rows);
    }
  }
  return extremes;
}

std::string rows_text(const RowExtremes& rows) {
  const auto [least, most] = rows;
  const auto side = [](double value) { return value < 0 ? "higher" : "lower"; };
  constexpr double kEqual = 0.05;  // [px]
  if (most - least < kEqual) return outputs::format("%.1f px %s", std::abs(most), side(most));
  if (least * most < 0) return outputs::format("%.1f px higher to %.1f px lower", -least, most);
  const double a = std::abs(least), b = std::abs(most);
  return outputs::format("%.1f to %.1f px %s", std::min(a, b), std::max(a, b), side(least + most));
}

bool suggests_sync(const Work& work) {
  return work.recording.arrangement == Arrangement::kTwoSources && !work.clocks;
}

ViewDiagnosis diagnose_views(const Work& work, const ViewInspection& inspection) {
  ViewDiagnosis found = diagnose_with(work, inspection, {-3, -2, -1, 1, 2, 3});
  if (!suggests_sync(work) || !may_be_farther_apart(found)) return found;
  const int frames = frames_apart(work);
  const ViewDiagnosis farther = diagnose_with(work, inspection, {frames - 1, frames, frames + 1});
  const bool better = farther.problem == ViewProblem::kOutOfStep && farther.better > found.better;
  return better ? farther : found;
}

}  // namespace mtstereo::run
