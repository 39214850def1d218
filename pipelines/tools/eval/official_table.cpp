// SPDX-License-Identifier: LGPL-2.1-or-later

// The official measures as tables on the terminal.

#include <algorithm>
#include <ostream>

#include "tools/eval/official_report.hpp"
#include "tools/eval/text_table.hpp"

namespace mtstereo::eval {
namespace {

bool is_kitti(Benchmark benchmark) { return benchmark == Benchmark::kKitti2015; }

std::string bad_text(Benchmark benchmark) { return "bad" + fixed(wrong_threshold(benchmark), 1); }

TableRow header(Benchmark benchmark) {
  if (is_kitti(benchmark)) {
    return {"pair", "method", "region", "size", "D1-bg", "D1-fg", "D1-all", "D1-est", "density"};
  }
  const std::string bad = bad_text(benchmark);
  return {"pair", "method", "region", "size", bad, bad + "-est", "avgerr", "density"};
}

TableRow row_of(Benchmark benchmark, TableRow row, const OfficialFigures& figures) {
  if (is_kitti(benchmark)) {
    row.push_back(fixed(figures.background, 2));
    row.push_back(fixed(figures.foreground, 2));
  }
  row.push_back(fixed(figures.wrong, 2));
  row.push_back(fixed(figures.answered_wrong, 2));
  if (!is_kitti(benchmark)) row.push_back(fixed(figures.avgerr, 3));
  row.push_back(fixed(figures.density, 1));
  return row;
}

void add_result(const PairReport& pair, const MethodResult& result, std::vector<TableRow>& rows) {
  const OfficialCounts& counts = *result.official;
  const std::string size = std::to_string(pair.size.width) + "x" + std::to_string(pair.size.height);
  if (counts.noc) {
    rows.push_back(row_of(counts.benchmark, {pair.pair.name, result.method, "noc", size},
                          figures_of(*counts.noc)));
  }
  if (counts.all) {
    rows.push_back(row_of(counts.benchmark, {pair.pair.name, result.method, "all", size},
                          figures_of(*counts.all)));
  }
}

void add_mean(const OfficialSummary& mean, std::vector<TableRow>& rows) {
  if (mean.noc) {
    rows.push_back(row_of(mean.benchmark,
                          {"mean of " + std::to_string(mean.noc_pairs), mean.method, "noc", ""},
                          *mean.noc));
  }
  if (mean.all) {
    rows.push_back(row_of(mean.benchmark,
                          {"mean of " + std::to_string(mean.all_pairs), mean.method, "all", ""},
                          *mean.all));
  }
}

void print_legend(std::ostream& out, Benchmark benchmark) {
  out << "official measures of " << benchmark_name(benchmark) << ": ";
  if (is_kitti(benchmark)) {
    out << "D1, error > 3 px and > 5 % of the truth, %;\npixels without a disparity are filled "
           "from the background, D1-est: of the others; mean over all pixels;\n";
  } else {
    out << bad_text(benchmark) << ", error > " << fixed(wrong_threshold(benchmark), 0)
        << " px at this size or no disparity, %;\n"
        << bad_text(benchmark) << "-est and avgerr px: of the pixels with a disparity;\n";
  }
  out << "noc: visible in both views; density % of the pixels with ground truth\n";
}

void print_benchmark(std::ostream& out, const Report& report, Benchmark benchmark,
                     const std::vector<OfficialSummary>& means) {
  std::vector<TableRow> rows{header(benchmark)};
  for (const PairReport& pair : report.pairs) {
    if (pair.kind != kCleanKind) continue;
    for (const MethodResult& result : pair.results) {
      if (result.official && result.official->benchmark == benchmark) {
        add_result(pair, result, rows);
      }
    }
  }
  for (const OfficialSummary& mean : means) {
    if (mean.benchmark == benchmark) add_mean(mean, rows);
  }
  print_legend(out, benchmark);
  print_rows(out, rows);
  for (const std::string& note : official_notes(report, benchmark)) out << "note: " << note << '\n';
}

}  // namespace

void print_official(std::ostream& out, const Report& report) {
  const std::vector<OfficialSummary> means = summarize_official(report);
  bool first = true;
  for (const Benchmark benchmark : kBenchmarks) {
    const bool has = std::any_of(means.begin(), means.end(), [&](const OfficialSummary& mean) {
      return mean.benchmark == benchmark;
    });
    if (!has) continue;
    if (!first) out << '\n';
    first = false;
    print_benchmark(out, report, benchmark, means);
  }
  const auto others =
      std::count_if(report.pairs.begin(), report.pairs.end(), [](const PairReport& pair) {
        return pair.kind == kCleanKind && !pair.results.empty() && !benchmark_of(pair.pair.layout);
      });
  if (others > 0) {
    out << (first ? "" : "\n") << "note: " << others
        << " pairs are of data sets without official measures here\n";
  }
}

}  // namespace mtstereo::eval
