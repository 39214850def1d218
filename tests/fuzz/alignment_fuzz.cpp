// SPDX-License-Identifier: LGPL-2.1-or-later
// The alignment tracker with any sequence of pairs. What it reports must be consistent, and equal
// for equal sequences.
#include <cmath>
#include <string>

#include "fuzz_image.hpp"
#include "mtstereo/mtstereo.hpp"

namespace mtstereo::fuzz {
namespace {

bool is_share(double value) { return value >= 0 && value <= 1; }

void check_field(const RowField& field) {
  for (const double term : {field.offset, field.roll, field.stretch, field.product, field.square}) {
    require(std::isfinite(term), "the terms of a field are numbers");
    require(std::abs(term) <= kLargestFieldTerm, "the terms of a field are in range");
  }
  const Result<RowField> again = RowField::parse(field.to_text());
  require(again.ok() && *again == field, "a field is equal after it was stored as text");
}

void check_blur(float left, float right) {
  require(left >= 0 && left <= kLargestBlur, "the left blur is in range");
  require(right >= 0 && right <= kLargestBlur, "the right blur is in range");
  require(left == 0 || right == 0, "only one view is blurred");
}

void check_findings(const AlignmentTracker& tracker) {
  const PairFindings& findings = tracker.findings();
  require(findings.inliers >= 0 && findings.inliers <= findings.matches, "inliers are matches");
  require(findings.matches <= findings.candidates, "matches are candidates");
  require(is_share(findings.inlier_share), "the share of inliers is a share");
  require(is_share(findings.negative_share), "the share of negative disparities is a share");
  require(std::isfinite(findings.residual) && findings.residual >= 0, "the residual is a number");
  require(std::isfinite(findings.sharpness_ratio) && findings.sharpness_ratio >= 0,
          "the sharpness ratio is a number");
  check_blur(findings.left_blur, findings.right_blur);
  check_field(findings.field);
  if (findings.status != FieldStatus::kTrusted) {
    require(findings.field == RowField{}, "there is no field without trust");
  }
  require(std::string(field_status_text(findings.status)) != "", "a status has a text");
}

void check_tracker(const AlignmentTracker& tracker) {
  check_findings(tracker);
  check_field(tracker.correction().rows);
  check_blur(tracker.correction().left_blur, tracker.correction().right_blur);
  require(tracker.views() >= 0, "the number of views is not negative");
  const auto has = [&](PairProblem problem) { return tracker.has(problem); };
  if (has(PairProblem::kLeftBlank) || has(PairProblem::kRightBlank)) {
    require(!has(PairProblem::kOutOfStep) && !has(PairProblem::kSharpnessDiffers) &&
                !has(PairProblem::kNotAPair) && !has(PairProblem::kSwapped),
            "a blank view explains all other problems");
  }
}

/// A sequence of calls with one tracker. Returns the fields that it found.
std::string run(FuzzInput input) {
  Result<AlignmentTracker> made = AlignmentTracker::create();
  require(made.ok(), "a tracker can be created");
  AlignmentTracker& tracker = *made;
  std::string found;
  int width = 104;
  int height = 68;
  for (int step = 0; step < 4 && !input.empty(); ++step) {
    const int action = input.byte();
    if (action % 16 == 15) tracker.reset();
    if (action % 16 == 14) {
      const double term = (input.byte() - 128) / 1.1;
      require(tracker.restore({term, 0, 0, 0, 0}).ok() == (std::abs(term) <= kLargestFieldTerm),
              "a field is restored if its terms are in range");
    }
    if (action % 8 == 7) {
      width = input.between(1, 160);
      height = input.between(1, 100);
    }
    FuzzImage left(width, height, input.byte() % 20, input.byte() % 9);
    FuzzImage right(width, height, input.byte() % 20, input.byte() % 9);
    const int shift = input.between(-20, 40);
    const int down = input.between(-10, 10);
    left.paint(input);
    if (input.byte() % 4 != 0) {
      right.copy_moved(left, shift, down);
      right.disturb(input);
    } else {
      right.paint(input);
    }
    require(tracker.watch(left.view(), right.view()).ok(), "a pair can be watched");
    const int range = input.between(-1, 100);
    if (action % 4 != 0) {
      require(tracker.inspect(left.view(), right.view(), range).ok() == (range > 0),
              "a pair can be inspected if the range is positive");
    }
    check_tracker(tracker);
    found += tracker.findings().field.to_text() + ";" + tracker.correction().rows.to_text() + "\n";
  }
  return found;
}

}  // namespace
}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mtstereo::fuzz;
  const std::string first = run({data, size});
  if (size % 4 == 0) require(first == run({data, size}), "equal sequences give equal fields");
  return 0;
}
