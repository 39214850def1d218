// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/calibrating.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::calibrate {
namespace {

// From the simplest model to the one with the most freedom.
constexpr std::array kModels{Model::kPlumbBob, Model::kFisheye, Model::kRational};
constexpr double kClearlyBetter = 0.95;  // of the error of a simpler model
constexpr double kTrialPart = 0.9;
constexpr double kOnePlace = 1e-4;  // distance of two lenses, which is impossible [m]

void require_side_by_side(const Rig& rig) {
  const Eigen::Vector3d center = rig.right_from_left.inverse().translation;
  if (center.norm() < kOnePlace) {
    throw UserError("both sides show the images of one camera: give the sources of two cameras");
  }
  if (std::abs(center.x()) >= center.norm() / 2) return;
  const bool vertical = std::abs(center.y()) > std::abs(center.z());
  throw UserError(std::string("the cameras are not side by side: one is ") +
                  (vertical ? "above" : "in front of") +
                  " the other. mtstereo needs a left and a right camera; turn cameras that "
                  "are one above the other by 90 degrees, or their videos (videoflip)");
}

bool is_swapped(const Rig& rig) { return rig.right_from_left.inverse().translation.x() < 0; }

void swap_sides(std::vector<BoardView>& views) {
  for (BoardView& view : views) std::swap(view.left, view.right);
}

Rectification rectification_of(const Rig& rig) {
  const StereoCalibration calibration = calibration_of(rig);
  if (const Status status = check_calibration(calibration); !status) {
    throw UserError("the solution makes no sense: " + status.error().message +
                    " (is the square size, in mm, right?)");
  }
  Result<Rectification> result = rectify(calibration);
  if (!result) {
    throw UserError(result.error().message +
                    " If they are, the views are too few, too similar or blurred.");
  }
  return *result;
}

// Whether a lens model that was found turns back within the image.
bool is_wild(const Rig& rig, const Rectification& rectification) {
  const auto remarks = rectification_remarks(calibration_of(rig), rectification);
  return remarks && std::any_of(remarks->begin(), remarks->end(),
                                [](const RectificationRemark& each) { return each.lens_limit; });
}

double relative_change(double before, double after) { return std::abs(after - before) / after; }

// The first model that fits at all, if none is given.
Solution first_solution(std::optional<Model>& model, cv::Size left, cv::Size right,
                        const std::vector<BoardView>& views) {
  if (model) return solve(*model, left, right, views);
  for (const Model each : kModels) {
    try {
      Solution solution = solve(each, left, right, views);
      model = each;
      return solution;
    } catch (const UserError&) {
      if (each == kModels.back()) throw;
    }
  }
  return {};
}

struct Trial {
  Solution solution;
  Fit fit;
};

Trial try_model(Model model, const Calibrated& sizes, const Division& division) {
  Trial trial{solve(model, sizes.left_size, sizes.right_size, division.used), {}};
  trial.fit = fit_of(trial.solution.rig, rectification_of(trial.solution.rig), division.held_out);
  return trial;
}

// The simplest model that no other one is clearly better than.
Model choose_model(Calibrated& calibrated, const Division& division) {
  double best = std::numeric_limits<double>::infinity();
  Model choice = kModels.front();
  std::string failure;
  for (const Model model : kModels) {
    ModelTrial trial{model, 0, {}};
    try {
      trial.distance = quantile(try_model(model, calibrated, division).fit.distances, kTrialPart);
      if (trial.distance < kClearlyBetter * best) {
        best = trial.distance;
        choice = model;
      }
    } catch (const UserError& error) {
      trial.failure = error.what();
      if (failure.empty()) failure = error.what();
    }
    calibrated.trials.push_back(trial);
  }
  if (!std::isfinite(best)) throw UserError(failure);
  return choice;
}

}  // namespace

Calibrated calibrate(std::optional<Model> model, cv::Size left, cv::Size right,
                     std::vector<BoardView> views) {
  Calibrated result;
  result.left_size = left;
  result.right_size = right;
  std::optional<Model> first = model;
  result.solution = first_solution(first, left, right, views);
  result.model = *first;
  require_side_by_side(result.solution.rig);
  result.swapped = is_swapped(result.solution.rig);
  if (result.swapped) {
    swap_sides(views);
    std::swap(result.left_size, result.right_size);
  }
  const Division division = divide(views);
  if (!model && !division.held_out.empty()) result.model = choose_model(result, division);
  if (result.swapped || result.model != *first) {
    result.solution = solve(result.model, result.left_size, result.right_size, views);
  }
  const Solution& all = result.solution;
  result.rectification = rectification_of(all.rig);
  result.wild = is_wild(all.rig, result.rectification);
  result.fit = fit_of(all.rig, result.rectification, all.views);
  if (!division.held_out.empty()) {
    const Trial trial = try_model(result.model, result, division);
    result.held_out = Calibrated::HeldOut{
        trial.fit,
        std::max(relative_change(trial.solution.rig.left.focal(), all.rig.left.focal()),
                 relative_change(trial.solution.rig.right.focal(), all.rig.right.focal())),
        relative_change(trial.solution.rig.baseline(), all.rig.baseline())};
  }
  return result;
}

}  // namespace mtstereo::calibrate
