// SPDX-License-Identifier: LGPL-2.1-or-later

// The report as a table on the terminal.

#include <cmath>
#include <ostream>

#include "tools/eval/report.hpp"
#include "tools/eval/text_table.hpp"

namespace mtstereo::eval {
namespace {

using Row = TableRow;

Row header() {
  return {"pair", "method", "range", "avgerr", "D-all",   "bad0.5",
          "bad1", "bad2",   "bad4",  "rms",    "density", "s/MP"};
}

Row row_of(const std::string& pair, const std::string& method, const std::string& range,
           const Metrics& metrics, double density, double seconds_per_megapixel) {
  Row row{pair, method, range, fixed(metrics.avgerr, 3), fixed(metrics.d_all, 2)};
  for (const double bad : metrics.bad) row.push_back(fixed(bad, 2));
  row.push_back(fixed(metrics.rms, 3));
  row.push_back(fixed(density, 1));
  row.push_back(fixed(seconds_per_megapixel, 3));
  return row;
}

const Metrics* region_of(const Evaluation& evaluation, bool noc) {
  if (!noc) return &evaluation.all;
  return evaluation.noc ? &*evaluation.noc : nullptr;
}

// The header and the lines of one region; only the header if no pair has the region.
std::vector<Row> rows_of(const Report& report, const std::vector<Summary>& means, bool noc) {
  std::vector<Row> rows{header()};
  for (const PairReport& pair : report.pairs) {
    if (pair.kind != kCleanKind) continue;
    for (const MethodResult& result : pair.results) {
      if (const Metrics* metrics = region_of(result.evaluation, noc)) {
        rows.push_back(row_of(pair.pair.name, result.method, std::to_string(pair.max_disparity),
                              *metrics, result.evaluation.density, result.seconds_per_megapixel));
      }
    }
  }
  for (const Summary& mean : means) {
    const Metrics* metrics = region_of(mean.evaluation, noc);
    if (metrics == nullptr || mean.pairs == 0) continue;
    rows.push_back(row_of("mean of " + std::to_string(mean.pairs), mean.method, "", *metrics,
                          mean.evaluation.density, mean.seconds_per_megapixel));
  }
  return rows;
}

}  // namespace

void print_table(std::ostream& out, const Report& report) {
  const std::vector<Summary> means = summarize(report);
  out << report.dataset << " in " << report.folder << ", mode " << parameter_text(report, "mode")
      << "; time: median of " << report.repeat << " frames after " << report.warm_up
      << " warm-up frames\n";
  out << "range px, avgerr px, D-all %, bad %, rms px, density % of all pixels, s per "
         "megapixel\n\n";
  const std::vector<Row> all = rows_of(report, means, false);
  if (all.size() == 1) {
    out << "no pair could be evaluated\n";
    return;
  }
  out << "all pixels with ground truth\n";
  print_rows(out, all);
  if (const std::vector<Row> noc = rows_of(report, means, true); noc.size() > 1) {
    out << "\npixels with ground truth that are visible in both views\n";
    print_rows(out, noc);
  }
  for (const auto& [method, settings] : report.opencv_settings) {
    out << '\n' << method << ": OpenCV, " << settings;
    for (const Summary& mean : means) {
      if (mean.method == method && std::isfinite(mean.time_ratio)) {
        out << "; takes " << fixed(mean.time_ratio, 2) << " times as long as mtstereo";
      }
    }
  }
  if (!report.opencv_settings.empty()) out << '\n';
}

}  // namespace mtstereo::eval
