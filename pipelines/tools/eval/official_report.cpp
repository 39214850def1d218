// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/official_report.hpp"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "tools/eval/json_number.hpp"

namespace mtstereo::eval {
namespace {

using nlohmann::json;
using Region = std::optional<RegionCounts> OfficialCounts::*;

std::vector<WeightedCounts> counts_of(const Report& report, Benchmark benchmark,
                                      const std::string& method, Region region) {
  std::vector<WeightedCounts> list;
  for (const PairReport& pair : report.pairs) {
    if (pair.kind != kCleanKind) continue;
    for (const MethodResult& result : pair.results) {
      if (result.method != method || !result.official) continue;
      if (result.official->benchmark != benchmark || !((*result.official).*region)) continue;
      list.push_back({&*((*result.official).*region), pair.pair.weight});
    }
  }
  return list;
}

OfficialSummary summarize(const Report& report, Benchmark benchmark, const std::string& method) {
  OfficialSummary summary;
  summary.benchmark = benchmark;
  summary.method = method;
  const std::vector<WeightedCounts> all =
      counts_of(report, benchmark, method, &OfficialCounts::all);
  const std::vector<WeightedCounts> noc =
      counts_of(report, benchmark, method, &OfficialCounts::noc);
  summary.all_pairs = static_cast<int>(all.size());
  summary.noc_pairs = static_cast<int>(noc.size());
  if (!all.empty()) summary.all = official_mean(benchmark, all);
  if (!noc.empty()) summary.noc = official_mean(benchmark, noc);
  return summary;
}

json figures_json(const std::optional<OfficialFigures>& figures) {
  if (!figures) return nullptr;
  return {{"wrong", json_number(figures->wrong)},
          {"wrong_est", json_number(figures->answered_wrong)},
          {"wrong_bg", json_number(figures->background)},
          {"wrong_fg", json_number(figures->foreground)},
          {"avgerr", json_number(figures->avgerr)},
          {"density", json_number(figures->density)},
          {"pixels", figures->pixels}};
}

json region_json(const std::optional<RegionCounts>& counts) {
  return counts ? figures_json(figures_of(*counts)) : json(nullptr);
}

// "3 of 4 pairs" with this property, or an empty text if there is none.
std::string share(const std::vector<const StereoPair*>& pairs,
                  const std::function<bool(const StereoPair&)>& has) {
  const auto count =
      std::count_if(pairs.begin(), pairs.end(), [&](const StereoPair* pair) { return has(*pair); });
  if (count == 0) return {};
  return std::to_string(count) + " of " + std::to_string(pairs.size()) + " pairs";
}

std::vector<const StereoPair*> pairs_of(const Report& report, Benchmark benchmark) {
  std::vector<const StereoPair*> pairs;
  for (const PairReport& pair : report.pairs) {
    const bool has_result = !pair.results.empty() && pair.kind == kCleanKind;
    if (has_result && benchmark_of(pair.pair.layout) == benchmark) pairs.push_back(&pair.pair);
  }
  return pairs;
}

std::vector<std::string> kitti_notes(const std::vector<const StereoPair*>& pairs) {
  std::vector<std::string> notes;
  const std::string objects =
      share(pairs, [](const StereoPair& pair) { return pair.object_map.empty(); });
  if (!objects.empty()) {
    notes.push_back("no object map (obj_map) for " + objects + ": they have only D1-all");
  }
  const std::string only_noc = share(pairs, [](const StereoPair& p) { return p.truth_is_visible; });
  if (!only_noc.empty()) {
    notes.push_back("no disp_occ for " + only_noc + ": they have only the region noc");
  }
  const std::string only_all = share(
      pairs, [](const StereoPair& p) { return !p.truth_is_visible && p.visible_truth.empty(); });
  if (!only_all.empty()) {
    notes.push_back("no disp_noc for " + only_all + ": they have only the region all");
  }
  return notes;
}

std::vector<std::string> mask_notes(const std::vector<const StereoPair*>& pairs) {
  const std::string missing =
      share(pairs, [](const StereoPair& pair) { return pair.visible_mask.empty(); });
  if (missing.empty()) return {};
  return {"no mask0nocc.png for " + missing + ": they have only the region all"};
}

}  // namespace

std::vector<OfficialSummary> summarize_official(const Report& report) {
  std::vector<OfficialSummary> list;
  for (const Benchmark benchmark : kBenchmarks) {
    for (const std::string& method : report.methods) {
      const OfficialSummary summary = summarize(report, benchmark, method);
      if (summary.all || summary.noc) list.push_back(summary);
    }
  }
  return list;
}

std::vector<std::string> official_notes(const Report& report, Benchmark benchmark) {
  const std::vector<const StereoPair*> pairs = pairs_of(report, benchmark);
  return benchmark == Benchmark::kKitti2015 ? kitti_notes(pairs) : mask_notes(pairs);
}

json official_json(const OfficialCounts& counts) {
  return {{"benchmark", benchmark_name(counts.benchmark)},
          {"threshold", wrong_threshold(counts.benchmark)},
          {"all", region_json(counts.all)},
          {"noc", region_json(counts.noc)}};
}

json official_means_json(const Report& report) {
  json result = json::object();
  for (const OfficialSummary& summary : summarize_official(report)) {
    json& entry = result[std::string(benchmark_name(summary.benchmark))];
    entry["threshold"] = wrong_threshold(summary.benchmark);
    entry["notes"] = official_notes(report, summary.benchmark);
    entry["mean"][summary.method] = {{"all_pairs", summary.all_pairs},
                                     {"noc_pairs", summary.noc_pairs},
                                     {"all", figures_json(summary.all)},
                                     {"noc", figures_json(summary.noc)}};
  }
  return result;
}

}  // namespace mtstereo::eval
