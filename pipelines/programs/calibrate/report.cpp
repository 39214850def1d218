// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/outputs/json_text.hpp"
#include "lib/outputs/texts.hpp"
#include "mtstereo/geometry/rig.hpp"

namespace mtstereo::calibrate {
namespace {

using nlohmann::ordered_json;
using outputs::decimal;

constexpr double kDegrees = 180 / M_PI;

Eigen::Vector3d rotation_degrees(const Rig& rig) {
  const Eigen::AngleAxisd turn(rig.right_from_left.rotation);
  return kDegrees * turn.angle() * turn.axis();
}

// A deviation of 0 is unknown.
std::string with_deviation(double value, double deviation, int decimals) {
  std::string text = decimal(value, decimals);
  if (deviation > 0) text += " ± " + decimal(deviation, decimals);
  return text;
}

std::string length(double meters) {
  if (meters >= 1) return decimal(meters, 2) + " m";
  return meters >= 0.01 ? decimal(100 * meters, 1) + " cm" : decimal(1000 * meters, 1) + " mm";
}

void print_cameras(std::ostream& out, const Report& report) {
  const Rig& rig = report.calibrated->solution.rig;
  const Uncertainty known = report.quality->uncertainty.value_or(Uncertainty());
  const auto line = [&](const char* title, const Camera& camera, double deviation) {
    out << "  " << title << "  " << camera.width << "x" << camera.height << ", focal length "
        << with_deviation(camera.focal(), deviation, 2) << " px, principal point "
        << decimal(camera.values[2], 1) << ", " << decimal(camera.values[3], 1) << " px\n";
  };
  line("left camera   ", rig.left, known.left_focal);
  line("right camera  ", rig.right, known.right_focal);
  const Eigen::Vector3d turn = rotation_degrees(rig);
  out << "  baseline        " << with_deviation(1000 * rig.baseline(), 1000 * known.baseline, 2)
      << " mm; the right camera is turned by " << decimal(turn.norm(), 2) << " degrees\n"
      << "  rectified       " << rig_text(rig_figures(report.calibrated->rectification)) << '\n';
}

void print_fit(std::ostream& out, const Report& report) {
  const Calibrated& calibrated = *report.calibrated;
  const BundleResult& result = calibrated.solution.result;
  out << "  reprojection    " << decimal(result.rms, 3) << " px (root mean square of "
      << result.observations << " corners in " << calibrated.solution.views.size() << " pairs)\n";
  const Fit& fit = calibrated.held_out ? calibrated.held_out->fit : calibrated.fit;
  out << "  rows            median " << decimal(quantile(fit.rows, 0.5), 3) << " px, 95 % below "
      << decimal(quantile(fit.rows, 0.95), 3) << " px ("
      << (calibrated.held_out
              ? std::to_string(fit.views) +
                    " pairs that were held out; the calibration that is written uses them too)\n"
              : "the pairs in use: too few to hold some out)\n");
  if (!calibrated.solution.removed.empty()) {
    out << "  removed         ";
    for (std::size_t i = 0; i < calibrated.solution.removed.size(); ++i) {
      out << (i > 0 ? ", " : "") << report.names[calibrated.solution.removed[i]];
    }
    out << " (contradict the other pairs)\n";
  }
  for (const ModelTrial& trial : calibrated.trials) {
    out << "  model           " << model_name(trial.model) << ": "
        << (trial.failure.empty()
                ? "90 % of the held-out corners within " + decimal(trial.distance, 3) + " px"
                : trial.failure)
        << '\n';
  }
}

void print_depths(std::ostream& out, const Quality& quality) {
  out << "  depth error     ";
  for (std::size_t i = 0; i < quality.depths.size(); ++i) {
    const DepthError& each = quality.depths[i];
    out << (i > 0 ? ", " : "") << length(each.total()) << " at " << decimal(each.depth, 0) << " m";
  }
  out << "\n                  (standard deviation, for disparities that are off by "
      << decimal(kDisparityError, 1) << " px)\n";
}

ordered_json json_of(const Camera& camera, const std::optional<double>& deviation) {
  const auto begin = camera.values.begin();
  ordered_json json{{"width", camera.width},
                    {"height", camera.height},
                    {"focal_x", camera.values[0]},
                    {"focal_y", camera.values[1]},
                    {"center_x", camera.values[2]},
                    {"center_y", camera.values[3]},
                    {"coefficients", std::vector<double>(begin + kPinholeParameters,
                                                         begin + parameter_count(camera.model))}};
  if (deviation) json["focal_deviation"] = *deviation;
  return json;
}

ordered_json json_of(const Calibrated& calibrated) {
  const Fit& fit = calibrated.held_out ? calibrated.held_out->fit : calibrated.fit;
  ordered_json json{{"held_out", calibrated.held_out.has_value()},
                    {"views", fit.views},
                    {"row_median", quantile(fit.rows, 0.5)},
                    {"row_95", quantile(fit.rows, 0.95)},
                    {"distance_median", quantile(fit.distances, 0.5)},
                    {"distance_95", quantile(fit.distances, 0.95)}};
  if (calibrated.held_out) {
    json["focal_length_change"] = calibrated.held_out->focal_length_change;
    json["baseline_change"] = calibrated.held_out->baseline_change;
  }
  return json;
}

ordered_json json_of(const Quality& quality) {
  ordered_json depths = ordered_json::array();
  for (const DepthError& each : quality.depths) {
    ordered_json depth{{"depth", each.depth}, {"error", each.total()}, {"matching", each.matching}};
    if (each.calibration) depth["calibration"] = *each.calibration;
    depths.push_back(depth);
  }
  ordered_json warnings = ordered_json::array();
  for (const Warning& each : quality.warnings) {
    warnings.push_back({{"name", each.name}, {"text", each.text}});
  }
  ordered_json json{{"grade", grade_name(quality.grade)},
                    {"disparity_error", kDisparityError},
                    {"depth_errors", depths},
                    {"warnings", warnings}};
  if (quality.offset) {
    json["time_offset"] = {{"seconds", quality.offset->seconds},
                           {"deviation", quality.offset->deviation},
                           {"pairs", quality.offset->pairs}};
  }
  return json;
}

}  // namespace

void PairCounts::count(Verdict verdict, const CornerPair& corners) {
  ++pairs;
  if (verdict == Verdict::kNoBoard) {
    ++without_board;
    if (corners.left.markers > 1 || corners.right.markers > 1) ++with_markers;
  }
  if (verdict == Verdict::kMoving) ++moving;
  if (verdict == Verdict::kSimilar) ++similar;
}

std::string Report::source(bool left) const {
  const SourceOptions& sources = options->source;
  if (sources.arrangement == Arrangement::kTwoSources) {
    return left != calibrated->swapped ? sources.left : sources.right;
  }
  const bool across = sources.arrangement == Arrangement::kSideBySide;
  const bool first = left != calibrated->swapped;
  return std::string(first ? (across ? "left" : "upper") : (across ? "right" : "lower")) +
         " half of " + sources.left;
}

void print_report(std::ostream& out, const Report& report) {
  const Calibrated& calibrated = *report.calibrated;
  out << (report.options->out / "calibration.yml").string() << ": "
      << grade_name(report.quality->grade) << ", " << calibrated.solution.views.size()
      << " pairs of views, lens model " << model_name(calibrated.model) << '\n';
  print_cameras(out, report);
  print_fit(out, report);
  print_depths(out, *report.quality);
  out << "  The left camera is " << report.source(true) << ", the right one is "
      << report.source(false) << ".\n";
  for (const Warning& each : report.quality->warnings) {
    out << "warning: " << each.name << ": " << each.text << ".\n";
  }
}

std::string json_of(const Report& report) {
  const Calibrated& calibrated = *report.calibrated;
  const Rig& rig = calibrated.solution.rig;
  const auto& known = report.quality->uncertainty;
  const Eigen::Vector3d turn = rotation_degrees(rig);
  const Eigen::Vector3d& shift = rig.right_from_left.translation;
  ordered_json removed = ordered_json::array();
  for (const std::size_t index : calibrated.solution.removed) {
    removed.push_back(report.names[index]);
  }
  ordered_json json{
      {"date", report.date},
      {"board", describe(report.options->board)},
      {"sources", {{"left", report.source(true)}, {"right", report.source(false)}}},
      {"swapped", calibrated.swapped},
      {"model", model_name(calibrated.model)},
      {"left", json_of(rig.left, known ? std::optional(known->left_focal) : std::nullopt)},
      {"right", json_of(rig.right, known ? std::optional(known->right_focal) : std::nullopt)},
      {"baseline", rig.baseline()},
      {"translation", {shift.x(), shift.y(), shift.z()}},
      {"rotation_degrees", {turn.x(), turn.y(), turn.z()}},
      {"reprojection_rms", calibrated.solution.result.rms},
      {"fit", json_of(calibrated)},
      {"pairs",
       {{"seen", report.counts.pairs},
        {"without_board", report.counts.without_board},
        {"moving", report.counts.moving},
        {"similar", report.counts.similar},
        {"taken", report.names.size()},
        {"removed", removed}}},
      {"quality", json_of(*report.quality)}};
  if (known) json["baseline_deviation"] = known->baseline;
  return outputs::text_of(std::move(json), 2) + "\n";
}

std::string too_few_views(const PairCounts& counts, std::size_t views, const BoardOptions& board,
                          bool video) {
  if (counts.pairs == 0) return "the sources gave no pair of images";
  if (counts.without_board == counts.pairs) {
    std::string text = "no board was found in " + std::to_string(counts.pairs) +
                       " pairs of images. Is it a " + describe(board) + "?";
    if (board.kind == BoardKind::kCheckerboard) {
      const std::string counted_as =
          std::to_string(board.columns) + "x" + std::to_string(board.rows);
      const std::string squares =
          std::to_string(board.columns + 1) + "x" + std::to_string(board.rows + 1);
      return text + " All of it must be visible in both images, with a white margin. --squares " +
             "counts squares: if " + counted_as +
             " are its inner corners, as OpenCV counts them, " + "set --squares " + squares;
    }
    text += counts.with_markers > 0
                ? " Its markers were seen in " + std::to_string(counts.with_markers) +
                      " pairs, but not in the order of this board: see --squares"
                : " No marker of this dictionary was seen: see --dictionary and --pattern, and "
                  "hold the board closer";
    return text;
  }
  std::string text = "only " + outputs::counted(views, "different view") + " of the board in " +
                     std::to_string(counts.pairs) + " pairs of images (" +
                     std::to_string(counts.without_board) + " without the board in both";
  if (video) text += ", " + std::to_string(counts.moving) + " with a board in motion";
  text += ", " + std::to_string(counts.similar) +
          " similar to others); at least 5 are needed, "
          "and 20 to 40 give a good calibration";
  if (video && counts.moving > counts.similar) {
    text +=
        ". Hold the board still for half a second in each place, or use --stills if each "
        "frame shows another place";
  }
  return text;
}

}  // namespace mtstereo::calibrate
