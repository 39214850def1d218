// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/solving.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/calibrate/start_values.hpp"

namespace mtstereo::calibrate {
namespace {

constexpr double kLeastScale = 0.02;  // of residuals, even of perfect corners [px]
constexpr double kWrongCorner = 5;    // distance of a corner that does not fit, in scales
constexpr double kBadCorners = 0.3;   // part of a view's corners: more, and the view is removed
constexpr int kRounds = 3;
constexpr double kLargestError = 4;           // of a solution [px], for images of this width
constexpr double kWidthOfLargestError = 640;  // [px]

// Sets the weights of the corners of one camera; returns the number of those that fit.
std::size_t weigh(const Camera& camera, const Pose& pose, double limit,
                  std::vector<Observation>& seen) {
  const std::vector<Eigen::Vector2d> rest = residuals(camera, pose, seen);
  std::size_t good = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i].weight = rest[i].norm() <= limit ? 1 : 0;
    good += rest[i].norm() <= limit ? 1U : 0U;
  }
  return good;
}

bool fits(std::size_t good, std::size_t all) {
  return good >= kFewestCorners &&
         static_cast<double>(all - good) <= kBadCorners * static_cast<double>(all);
}

constexpr const char* kWhatToCheck =
    ": are --squares, --pattern and --dictionary those of the board, is it flat, does --model fit "
    "the lenses, do both images show the same moment, is none of them upside down or mirrored?";

void require_views(std::size_t count, std::size_t removed) {
  if (count >= kFewestViews && removed <= count) return;
  std::string text = "only " + outputs::counted(count, "view") + " of the board can be used";
  if (removed > 0) text += ", " + outputs::counted(removed, "other") + " do not fit" + kWhatToCheck;
  throw UserError(text + (removed > 0 ? " At" : "; at") + " least " + std::to_string(kFewestViews) +
                  " are needed, and 20 to 40 give a good calibration");
}

void require_fit(const Solution& solution) {
  const double limit =
      kLargestError * std::max(1.0, solution.rig.left.width / kWidthOfLargestError);
  if (solution.result.rms <= limit) return;
  throw UserError("the views of the board do not fit together, with an error of " +
                  outputs::decimal(solution.result.rms, 1) + " px" + kWhatToCheck);
}

// Removes the views with many corners that do not fit, and marks such corners of the others.
void remove_outliers(double limit, Solution& solution) {
  std::vector<BoardView> kept;
  std::vector<std::size_t> indices;
  solution.removed_corners = 0;
  for (std::size_t i = 0; i < solution.views.size(); ++i) {
    BoardView& view = solution.views[i];
    const Rig& rig = solution.rig;
    const std::size_t left = weigh(rig.left, view.pose, limit, view.left);
    const std::size_t right = weigh(rig.right, rig.right_from_left * view.pose, limit, view.right);
    if (!fits(left, view.left.size()) || !fits(right, view.right.size())) {
      solution.removed.push_back(solution.indices[i]);
      continue;
    }
    solution.removed_corners += view.left.size() - left + view.right.size() - right;
    kept.push_back(std::move(view));
    indices.push_back(solution.indices[i]);
  }
  solution.views = std::move(kept);
  solution.indices = std::move(indices);
}

void set_weights(double weight, std::vector<BoardView>& views) {
  for (BoardView& view : views) {
    for (Observation& each : view.left) each.weight = weight;
    for (Observation& each : view.right) each.weight = weight;
  }
}

}  // namespace

Solution solve(Model model, cv::Size left, cv::Size right, const std::vector<BoardView>& views) {
  require_views(views.size(), 0);
  Solution solution;
  solution.views = views;
  for (std::size_t i = 0; i < views.size(); ++i) solution.indices.push_back(i);
  set_weights(1, solution.views);
  solution.rig = fit_start(model, left, right, solution.views);
  solution.options.free = all_parameters();
  for (int round = 0; round < kRounds; ++round) {
    solution.options.robust_scale = 2 * robust_scale(solution.rig, solution.views, kLeastScale);
    adjust(solution.rig, solution.views, solution.options);
    const double scale = robust_scale(solution.rig, solution.views, kLeastScale);
    remove_outliers(kWrongCorner * scale, solution);
    require_views(solution.views.size(), solution.removed.size());
  }
  solution.options.robust_scale = 0;
  solution.result = adjust(solution.rig, solution.views, solution.options);
  require_fit(solution);
  std::sort(solution.removed.begin(), solution.removed.end());
  return solution;
}

}  // namespace mtstereo::calibrate
