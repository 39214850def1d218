// SPDX-License-Identifier: LGPL-2.1-or-later
// The public class AlignmentTracker, and the texts of its enums.
#include <algorithm>
#include <memory>
#include <new>
#include <string>

#include "alignment/correction_policy.hpp"
#include "alignment/pair_inspection.hpp"
#include "alignment/pair_watch.hpp"
#include "alignment/row_field.hpp"
#include "base/check_views.hpp"
#include "base/guard.hpp"
#include "base/limits.hpp"
#include "mtstereo/alignment.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo {

const char* field_status_text(FieldStatus status) noexcept {
  switch (status) {
    case FieldStatus::kNotInspected:
      return "not inspected yet";
    case FieldStatus::kTrusted:
      return "trusted";
    case FieldStatus::kImageTooSmall:
      return "the images are too small";
    case FieldStatus::kTooFewCorners:
      return "too little texture";
    case FieldStatus::kTooFewMatches:
      return "too few matches";
    case FieldStatus::kRepeatedPattern:
      return "the texture repeats itself";
    case FieldStatus::kTooFewInliers:
      return "the matches disagree with each other";
    case FieldStatus::kTooScattered:
      return "the matches scatter too much";
    case FieldStatus::kTooConcentrated:
      return "the matches cover too small a part of the image";
    case FieldStatus::kTooUncertain:
      return "the matches do not determine the field";
    case FieldStatus::kSwapped:
      return "the views are swapped";
  }
  return "";
}

const char* problem_name(PairProblem problem) noexcept {
  switch (problem) {
    case PairProblem::kSwapped:
      return "swapped";
    case PairProblem::kNotAPair:
      return "not-a-pair";
    case PairProblem::kOutOfStep:
      return "out-of-step";
    case PairProblem::kSharpnessDiffers:
      return "sharpness-differs";
    case PairProblem::kLeftBlank:
      return "left-blank";
    case PairProblem::kRightBlank:
      return "right-blank";
    case PairProblem::kLeftFrozen:
      return "left-frozen";
    case PairProblem::kRightFrozen:
      return "right-frozen";
  }
  return "";
}

const char* problem_text(PairProblem problem) noexcept {
  switch (problem) {
    case PairProblem::kSwapped:
      return "The left and the right view are swapped: exchange the two streams.";
    case PairProblem::kNotAPair:
      return "Few points of the left view are found in the right one. Possible causes: streams of "
             "different cameras, a view that is upside down or mirrored, cameras above each other, "
             "views that are not rectified or rectified for other cameras, a search range that is "
             "too small.";
    case PairProblem::kOutOfStep:
      return "Points of the two views disagree about the rows. Possible causes: views that were "
             "not taken at the same time, that are not rectified or rectified for other cameras, "
             "cameras above each other, a search range that is too small.";
    case PairProblem::kSharpnessDiffers:
      return "One view is less sharp than the other: clean and focus its lens.";
    case PairProblem::kLeftBlank:
      return "The left view shows nothing: check whether its lens is covered, or its values use "
             "few of 16 bits.";
    case PairProblem::kRightBlank:
      return "The right view shows nothing: check whether its lens is covered, or its values use "
             "few of 16 bits.";
    case PairProblem::kLeftFrozen:
      return "The left view repeats itself while the right one changes: check its stream.";
    case PairProblem::kRightFrozen:
      return "The right view repeats itself while the left one changes: check its stream.";
  }
  return "";
}

/// The state of the public class. Hidden, since it would otherwise be exported together with that
/// class.
struct __attribute__((visibility("hidden"))) AlignmentTracker::State {
  PairInspector inspector;
  std::unique_ptr<PairInspector> exchanged;  ///< created when views look swapped
  PairFindings findings;
  CorrectionPolicy policy;
  PairWatch watch;

  void test_order(GrayView left, GrayView right, int max_disparity, int min_disparity);
  bool shows(PairProblem problem) const;
  bool explained(PairProblem problem) const;
};

AlignmentTracker::AlignmentTracker(std::unique_ptr<State> state) noexcept
    : state_(std::move(state)) {}
AlignmentTracker::AlignmentTracker(AlignmentTracker&&) noexcept = default;
AlignmentTracker& AlignmentTracker::operator=(AlignmentTracker&&) noexcept = default;
AlignmentTracker::~AlignmentTracker() = default;

Result<AlignmentTracker> AlignmentTracker::create() noexcept {
  return guarded([&]() -> Result<AlignmentTracker> {
    try {
      return AlignmentTracker(std::make_unique<State>());
    } catch (const std::bad_alloc&) {
      return Error{ErrorCode::kOutOfMemory, "not enough memory for an alignment tracker"};
    }
  });
}

Status AlignmentTracker::watch(GrayView left, GrayView right) noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_pair(left, right); !status) return status;
    state_->watch.watch(left, right);
    return {};
  });
}

Status AlignmentTracker::inspect(GrayView left, GrayView right, int max_disparity) noexcept {
  return inspect(left, right, max_disparity, 0);
}

Status AlignmentTracker::inspect(GrayView left, GrayView right, int max_disparity,
                                 int min_disparity) noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_pair(left, right); !status) return status;
    if (max_disparity < 1 || max_disparity > kLargestMaxDisparity) {
      return Error{ErrorCode::kInvalidParameter,
                   "max-disparity = " + std::to_string(max_disparity) +
                       " is invalid: the range is 1 to " + std::to_string(kLargestMaxDisparity)};
    }
    if (min_disparity < -kLargestMinDisparity || min_disparity >= max_disparity) {
      return Error{ErrorCode::kInvalidParameter,
                   "min-disparity = " + std::to_string(min_disparity) +
                       " is invalid: the range is " + std::to_string(-kLargestMinDisparity) +
                       " to " + std::to_string(max_disparity - 1)};
    }
    state_->inspector.inspect(left, right, max_disparity, std::min(min_disparity, 0));
    state_->findings = state_->inspector.findings();
    if (state_->findings.status == FieldStatus::kSwapped) {
      state_->test_order(left, right, max_disparity, std::min(min_disparity, 0));
    }
    state_->policy.add(state_->findings, state_->inspector.matches(), left.width, left.height);
    return {};
  });
}

const PairFindings& AlignmentTracker::findings() const noexcept { return state_->findings; }

const ViewCorrection& AlignmentTracker::correction() const noexcept {
  return state_->policy.correction();
}

bool AlignmentTracker::trusted() const noexcept { return state_->policy.trusted(); }

int AlignmentTracker::views() const noexcept { return state_->policy.views(); }

/// Views are swapped only if they are aligned in the other order. The disparities of views that are
/// not rectified can have either sign, but their rows differ over the image.
void AlignmentTracker::State::test_order(GrayView left, GrayView right, int max_disparity,
                                         int min_disparity) {
  if (!exchanged) exchanged = std::make_unique<PairInspector>();
  exchanged->inspect(right, left, max_disparity, min_disparity);
  const PairFindings& other = exchanged->findings();
  double least = 0, most = 0;
  for_extreme_points(left.width, left.height, [&](double x, double y) {
    const double rows =
        other.field.displacement(x, y, left.width, left.height) - other.field.offset;
    least = std::min(least, rows);
    most = std::max(most, rows);
  });
  constexpr double kRows = 0.008;  // of the width
  if (other.status == FieldStatus::kTrusted && most - least <= kRows * left.width) return;
  findings.status = FieldStatus::kTooScattered;
}

bool AlignmentTracker::State::shows(PairProblem problem) const {
  switch (problem) {
    case PairProblem::kSwapped:
      return policy.swapped();
    case PairProblem::kNotAPair:
      return policy.not_a_pair();
    case PairProblem::kOutOfStep:
      return policy.out_of_step();
    case PairProblem::kSharpnessDiffers:
      return policy.sharpness_differs();
    case PairProblem::kLeftBlank:
      return watch.blank(0);
    case PairProblem::kRightBlank:
      return watch.blank(1);
    case PairProblem::kLeftFrozen:
      return watch.frozen(0);
    case PairProblem::kRightFrozen:
      return watch.frozen(1);
  }
  return false;
}

/// Whether the problem follows from another one that the streams have.
bool AlignmentTracker::State::explained(PairProblem problem) const {
  if (problem == PairProblem::kLeftBlank || problem == PairProblem::kRightBlank) return false;
  if (watch.blank(0) || watch.blank(1)) return true;
  if (problem == PairProblem::kLeftFrozen || problem == PairProblem::kRightFrozen) return false;
  if (watch.frozen(0) || watch.frozen(1)) return true;
  // Views of a moving camera at different times can have negative disparities.
  return problem == PairProblem::kSwapped && policy.out_of_step();
}

bool AlignmentTracker::has(PairProblem problem) const noexcept {
  return state_->shows(problem) && !state_->explained(problem);
}

Status AlignmentTracker::restore(const RowField& field) noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_field(field); !status) return status;
    reset();
    state_->policy.restore(field);
    return {};
  });
}

void AlignmentTracker::reset() noexcept {
  state_->findings = {};
  state_->policy.reset();
  state_->watch.reset();
}

}  // namespace mtstereo
