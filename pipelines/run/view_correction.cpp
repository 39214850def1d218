// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run/view_correction.hpp"

#include <cstdio>
#include <cstring>
#include <string>

#include "mtstereo/alignment.hpp"
#include "run/matching_run.hpp"
#include "run/run_error.hpp"
#include "run/work_options.hpp"

namespace mtstereo::run {
namespace {

constexpr std::int64_t kMostPairs = 12;

// Pairs that are spread evenly over the recording.
std::vector<std::int64_t> samples(std::int64_t pairs) {
  const std::int64_t count = std::min(pairs, kMostPairs);
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < count; ++i) numbers.push_back((2 * i + 1) * pairs / (2 * count));
  return numbers;
}

// What mtstereo has found.
struct Findings {
  std::string field;
  double offset = 0, left_blur = 0, right_blur = 0;
  bool trusted = false;
  std::string problems;
};

Findings findings_of(GstElement* matcher) {
  Findings findings;
  g_autofree gchar* field = nullptr;
  GstStructure* stats = nullptr;
  g_object_get(matcher, "alignment-field", &field, "stats", &stats, nullptr);
  findings.field = field != nullptr ? field : "";
  gst_structure_get_double(stats, "offset", &findings.offset);
  gst_structure_get_double(stats, "left-blur", &findings.left_blur);
  gst_structure_get_double(stats, "right-blur", &findings.right_blur);
  gboolean trusted = FALSE;
  gst_structure_get_boolean(stats, "trust", &trusted);
  findings.trusted = trusted != FALSE;
  const gchar* const problems = gst_structure_get_string(stats, "problem");
  findings.problems = problems != nullptr ? problems : "";
  gst_structure_free(stats);
  return findings;
}

Findings inspect(const Work& work) {
  Work inspected = work;
  inspected.options.products.clear();
  inspected.correction = {{"alignment", "correct"}, {"alignment-interval", "1"}};
  const auto pairs = static_cast<std::int64_t>(work.pairs.pairs.size());
  MatchingRun run(inspected, samples(pairs), map_pipeline(inspected), 1);
  bool any = false;
  while (run.next()) any = true;
  if (!any) throw RunError(work.recording.name + ": " + run.damage());
  return findings_of(run.matcher());
}

void note_problems(Work& work, const std::string& problems) {
  const std::string list = "," + problems + ",";
  for (int i = 0; i < kPairProblems; ++i) {
    const auto problem = static_cast<PairProblem>(i);
    const std::string name = std::string(",") + problem_name(problem) + ",";
    if (list.find(name) != std::string::npos) work.remarks.emplace_back(problem_text(problem));
  }
}

void note_correction(Work& work, const Findings& findings) {
  char text[160];
  const RowField field =
      RowField::parse(findings.field).ok() ? *RowField::parse(findings.field) : RowField{};
  if (!(field == RowField{})) {
    std::snprintf(
        text, sizeof text,
        "The rows of the right view are %.2f px %s at the center: corrected in all pairs.",
        std::abs(findings.offset), findings.offset < 0 ? "higher" : "lower");
    work.remarks.emplace_back(text);
  }
  const double blur = std::max(findings.left_blur, findings.right_blur);
  if (blur == 0) return;
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

void measure_correction(Work& work) {
  const std::string wanted = property_of(work.options, "alignment");
  const bool published = matcher_parameters(work.options).preset() == Preset::kPaper;
  if (wanted == "off" || (wanted.empty() && published)) {
    work.correction = {{"alignment", "off"}};
    return;
  }
  Findings findings = inspect(work);
  note_problems(work, findings.problems);
  if (!findings.trusted) findings.field.clear();
  note_correction(work, findings);
  work.correction = {{"alignment", "hold"},
                     {"alignment-field", findings.field},
                     {"left-blur", text_of(findings.left_blur)},
                     {"right-blur", text_of(findings.right_blur)}};
}

}  // namespace mtstereo::run
