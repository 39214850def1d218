// SPDX-License-Identifier: LGPL-2.1-or-later

// The means of degraded images and the flicker as tables on the terminal.

#include <ostream>

#include "tools/eval/report.hpp"
#include "tools/eval/text_table.hpp"

namespace mtstereo::eval {
namespace {

TableRow kind_row(const std::string& kind, const Summary& mean, double clean_density) {
  const Evaluation& e = mean.evaluation;
  static_assert(kBadThresholds[1] == 1);
  return {kind,
          mean.method,
          std::to_string(mean.pairs),
          fixed(e.all.avgerr, 3),
          fixed(e.all.d_all, 2),
          fixed(e.all.bad[1], 2),
          fixed(e.density, 1),
          fixed(100 * e.density / clean_density, 0),
          e.flat_answers ? std::to_string(*e.flat_answers) : "-"};
}

TableRow flicker_row(const std::string& pair, const MethodFlicker& entry) {
  const Flicker& flicker = entry.flicker;
  return {pair,
          entry.method,
          fixed(flicker.density, 1),
          fixed(flicker.come_and_go, 1),
          fixed(flicker.spread, 3),
          fixed(flicker.d_all, 2),
          fixed(flicker.avgerr, 3),
          fixed(flicker.edges, 2)};
}

}  // namespace

void print_kinds(std::ostream& out, const Report& report) {
  const std::vector<Summary> clean = summarize(report);
  std::vector<TableRow> rows{
      {"images", "method", "pairs", "avgerr", "D-all", "bad1", "density", "kept", "flat"}};
  for (const std::string& kind : report.kinds) {
    const std::vector<Summary> means = summarize(report, kind);
    for (std::size_t i = 0; i < means.size(); ++i) {
      if (means[i].pairs == 0) continue;
      rows.push_back(kind_row(kind, means[i], clean[i].evaluation.density));
    }
  }
  out << "degraded images, mean of all pixels with ground truth; kept: density as a share of the "
         "clean one, %;\nflat: pixels with a disparity in areas that are constant in both views, "
         "all pairs; errors of enlarged images in px of the original\n";
  print_rows(out, rows);
}

void print_flicker(std::ostream& out, const Report& report) {
  std::vector<TableRow> rows{
      {"pair", "method", "density", "come and go", "spread", "D-all", "avgerr", "edges"}};
  for (const PairReport& pair : report.pairs) {
    for (const MethodFlicker& entry : pair.flicker) {
      rows.push_back(flicker_row(pair.pair.name, entry));
    }
  }
  for (const MethodFlicker& entry : summarize_flicker(report)) {
    rows.push_back(flicker_row("mean", entry));
  }
  out << "flicker, " << kFlickerFrames;
  if (report.flicker) {
    out << " frames with fresh noise of standard deviation " << *report.flicker;
  } else {
    out << " frames of the stream up to each";
  }
  out << "; come and go: of the pixels with a disparity in\nany frame, those without one in "
         "another, %; spread: standard deviation of the other pixels, px; edges: wrong pixels "
         "(> 3 px) of the known ones\nwithin 5 px of jumps, %\n";
  print_rows(out, rows);
}

}  // namespace mtstereo::eval
