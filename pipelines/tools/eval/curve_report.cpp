// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/curve_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "tools/eval/json_number.hpp"
#include "tools/eval/opencv_sweep.hpp"
#include "tools/eval/runner.hpp"
#include "tools/eval/text_table.hpp"

namespace mtstereo::eval {
namespace {

using nlohmann::json;

const std::string kThresholds = "1 .. " + std::to_string(kMostConfidence);

std::string own_settings(const ParameterTexts& parameters) {
  std::string text = "confidence >= " + kThresholds + ";";
  for (const auto& [name, value] : parameters) {
    text += (text.back() == ';' ? " " : ", ") + name + " " + value;
  }
  return text;
}

Curve own_curve(const MethodSweep& own, const ParameterTexts& parameters) {
  return {own.method, own_settings(parameters), 0, false, own.sweep};
}

void add_opencv(const MethodSweep& matcher, std::size_t method, CurveReport& report) {
  const std::string settings =
      "OpenCV, " + opencv_settings(*find_opencv(matcher.method), uniqueness_ratios_text());
  report.curves.push_back(
      {matcher.method, settings, method, false, at_threshold(matcher.sweep, 0)});
  report.curves.push_back({matcher.method + " + filters",
                           "the smallest error of " + matcher.method +
                               " as above, with and without the filters: " + report.filters +
                               ", >= " + kThresholds,
                           method, true, matcher.sweep});
}

const char* key_of(const CurveMeasure& measure) {
  return measure.value == kDAllMeasure.value ? "d_all" : measure.name;
}

json errors_at(const Sweep& sweep, double density) {
  json result{{"density", density}};
  for (const CurveMeasure& measure : kCurveMeasures) {
    result[key_of(measure)] = json_number(error_at(sweep, density, measure));
  }
  return result;
}

json densities_json(const Sweep& sweep) {
  json result = json::array();
  for (const double d_all : kCurveDAlls) {
    const double density = density_at(sweep, d_all, kDAllMeasure);
    result.push_back({{"d_all", d_all}, {"density", json_number(density)}});
  }
  return result;
}

json point_json(const CurvePoint& point) {
  json result{{"density", json_number(point.density)}};
  for (const CurveMeasure& measure : kCurveMeasures) {
    result[key_of(measure)] = json_number(point.*measure.value);
  }
  return result;
}

// An envelope has no points of its own: it is sampled at both ends and at every whole percent
// between them.
json envelope_points(const Sweep& sweep) {
  json points = json::array();
  const DensityRange range = density_range(sweep);
  for (double density = range.least; density < range.most; density = std::floor(density) + 1) {
    points.push_back(errors_at(sweep, density));
  }
  if (std::isfinite(range.most)) points.push_back(errors_at(sweep, range.most));
  return points;
}

json line_points(const Sweep& sweep) {
  json points = json::array();
  for (std::size_t i = 0; i < sweep.ratios.size(); ++i) {
    for (std::size_t j = 0; j < sweep.thresholds.size(); ++j) {
      json point = point_json(sweep.at(i, j));
      if (sweep.ratios.size() > 1) point["uniqueness_ratio"] = sweep.ratios[i];
      if (sweep.thresholds.size() > 1) point["threshold"] = sweep.thresholds[j];
      points.push_back(std::move(point));
    }
  }
  return points;
}

}  // namespace

CurveReport make_curves(const std::string& dataset, const ParameterTexts& parameters,
                        const FilterSettings& filters, const CurveMeans& means) {
  CurveReport report{dataset, {}, text_of(filters), means.pairs, means.left_out, {}};
  for (const auto& [name, value] : parameters) {
    if (name == "mode") report.mode = value;
  }
  for (std::size_t i = 0; i < means.methods.size(); ++i) {
    if (means.methods[i].method == kOwnMethod) {
      report.curves.push_back(own_curve(means.methods[i], parameters));
    } else {
      add_opencv(means.methods[i], i, report);
    }
  }
  return report;
}

namespace {

std::vector<TableRow> error_rows(const CurveReport& report) {
  std::vector<TableRow> rows{{"density %", ""}};
  for (const double density : kCurveDensities) rows[0].push_back(fixed(density, 0));
  for (const CurveMeasure& measure : kCurveMeasures) {
    for (const Curve& curve : report.curves) {
      TableRow row{std::string(measure.name) + " " + measure.unit, curve.name};
      for (const double density : kCurveDensities) {
        const int digits = std::string_view(measure.unit) == "px" ? 3 : 2;
        row.push_back(fixed(error_at(curve.sweep, density, measure), digits));
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<TableRow> density_rows(const CurveReport& report) {
  std::vector<TableRow> rows{{"D-all %", ""}};
  for (const double d_all : kCurveDAlls) rows[0].push_back(fixed(d_all, 1));
  for (const Curve& curve : report.curves) {
    TableRow row{"density %", curve.name};
    for (const double d_all : kCurveDAlls) {
      row.push_back(fixed(density_at(curve.sweep, d_all, kDAllMeasure), 1));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

void print_curves(std::ostream& out, const CurveReport& report) {
  out << "errors at equal density, " << report.dataset;
  if (report.kind != kCleanKind) out << ", " << report.kind;
  out << ", unweighted mean of " << report.pairs << " pairs, all pixels with ground truth\n";
  if (report.pairs > 0) {
    print_rows(out, error_rows(report));
    out << "densities at equal D-all, of the same\n";
    print_rows(out, density_rows(report));
  }
  for (const Problem& problem : report.left_out) {
    out << "left out: " << problem.pair << ": " << problem.reason << '\n';
  }
}

void print_curve_settings(std::ostream& out, const CurveReport& report) {
  for (const Curve& curve : report.curves) out << curve.name << ": " << curve.settings << '\n';
}

json curves_json(const CurveReport& report) {
  json result{{"dataset", report.dataset}, {"kind", report.kind},    {"mode", report.mode},
              {"filters", report.filters}, {"region", "all"},        {"pairs", report.pairs},
              {"left_out", json::array()}, {"curves", json::array()}};
  for (const Problem& problem : report.left_out) {
    result["left_out"].push_back({{"pair", problem.pair}, {"reason", problem.reason}});
  }
  for (const Curve& curve : report.curves) {
    json entry{
        {"name", curve.name},
        {"settings", curve.settings},
        {"method", curve.method},
        {"envelope", curve.envelope},
        {"at_density", json::array()},
        {"at_d_all", densities_json(curve.sweep)},
        {"points", curve.envelope ? envelope_points(curve.sweep) : line_points(curve.sweep)}};
    for (const double density : kCurveDensities) {
      entry["at_density"].push_back(errors_at(curve.sweep, density));
    }
    result["curves"].push_back(std::move(entry));
  }
  return result;
}

}  // namespace mtstereo::eval
