// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/eval/json_number.hpp"

namespace mtstereo::eval {
namespace {

using nlohmann::json;

std::string bad_name(double threshold) {
  std::string text = std::to_string(threshold);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return "bad" + text;
}

json metrics_json(const Metrics& metrics) {
  json result{{"known_pixels", metrics.known},
              {"compared_pixels", metrics.compared},
              {"avgerr", json_number(metrics.avgerr)},
              {"rms", json_number(metrics.rms)},
              {"d_all", json_number(metrics.d_all)},
              {"known_density", json_number(metrics.known_density)}};
  for (std::size_t i = 0; i < kBadThresholds.size(); ++i) {
    result[bad_name(kBadThresholds[i])] = json_number(metrics.bad[i]);
  }
  return result;
}

json evaluation_json(const Evaluation& evaluation) {
  return {{"density", json_number(evaluation.density)},
          {"all", metrics_json(evaluation.all)},
          {"noc", evaluation.noc ? metrics_json(*evaluation.noc) : json(nullptr)},
          {"flat_answers", evaluation.flat_answers ? json(*evaluation.flat_answers) : json()}};
}

json flicker_json(const std::vector<MethodFlicker>& list) {
  json result = json::object();
  for (const auto& [method, flicker] : list) {
    result[method] = {{"density", json_number(flicker.density)},
                      {"come_and_go", json_number(flicker.come_and_go)},
                      {"spread", json_number(flicker.spread)},
                      {"d_all", json_number(flicker.d_all)},
                      {"avgerr", json_number(flicker.avgerr)},
                      {"edges", json_number(flicker.edges)}};
  }
  return result;
}

json pair_json(const PairReport& pair) {
  json result{{"name", pair.pair.name},
              {"kind", pair.kind},
              {"left", pair.pair.left.string()},
              {"right", pair.pair.right.string()},
              {"ground_truth", pair.pair.truth.string()},
              {"width", pair.size.width},
              {"height", pair.size.height},
              {"scale", pair.scale},
              {"max_disparity", pair.max_disparity},
              {"weight", pair.pair.weight},
              {"results", json::object()}};
  for (const MethodResult& method : pair.results) {
    json entry = evaluation_json(method.evaluation);
    entry["seconds"] = json_number(method.seconds);
    entry["seconds_per_megapixel"] = json_number(method.seconds_per_megapixel);
    result["results"][method.method] = std::move(entry);
  }
  if (!pair.flicker.empty()) result["flicker"] = flicker_json(pair.flicker);
  return result;
}

const MethodResult* result_of(const PairReport& pair, const std::string& method) {
  const auto found = std::find_if(pair.results.begin(), pair.results.end(),
                                  [&](const MethodResult& r) { return r.method == method; });
  return found == pair.results.end() ? nullptr : &*found;
}

Summary summarize_method(const Report& report, const std::string& kind, const std::string& method) {
  Summary summary;
  summary.method = method;
  std::vector<WeightedEvaluation> evaluations;
  double time = 0, ratio = 0;
  int both = 0;
  for (const PairReport& pair : report.pairs) {
    const MethodResult* result = pair.kind == kind ? result_of(pair, method) : nullptr;
    if (result == nullptr) continue;
    evaluations.push_back({&result->evaluation, pair.pair.weight});
    time += result->seconds_per_megapixel;
    const MethodResult* own = result_of(pair, kOwnMethod);
    if (own == nullptr || own->seconds <= 0) continue;
    ratio += result->seconds / own->seconds;
    ++both;
  }
  summary.pairs = static_cast<int>(evaluations.size());
  summary.evaluation = mean(evaluations);
  if (summary.pairs > 0) summary.seconds_per_megapixel = time / summary.pairs;
  if (both > 0) summary.time_ratio = ratio / both;
  return summary;
}

json means_json(const std::vector<Summary>& means) {
  json result = json::object();
  for (const Summary& summary : means) {
    json entry = evaluation_json(summary.evaluation);
    entry["pairs"] = summary.pairs;
    entry["seconds_per_megapixel"] = json_number(summary.seconds_per_megapixel);
    entry["time_ratio"] = json_number(summary.time_ratio);
    result[summary.method] = std::move(entry);
  }
  return result;
}

// The means of the degradations, and the curves of all kinds, which plot.py reads.
void add_kinds(const Report& report, json& result) {
  for (const std::string& kind : report.kinds) {
    if (kind == kCleanKind) continue;
    result["degraded"].push_back({{"kind", kind}, {"mean", means_json(summarize(report, kind))}});
  }
  for (const CurveReport& curve : report.curves) {
    if (curve.kind == kCleanKind) {
      result["curve"] = curves_json(curve);
      continue;
    }
    for (json& entry : result["degraded"]) {
      if (entry["kind"] == curve.kind) entry["curve"] = curves_json(curve);
    }
  }
}

}  // namespace

std::string parameter_text(const Report& report, const std::string& name) {
  for (const auto& [key, text] : report.parameters) {
    if (key == name) return text;
  }
  return {};
}

std::vector<Summary> summarize(const Report& report, const std::string& kind) {
  std::vector<Summary> summaries;
  for (const std::string& method : report.methods) {
    summaries.push_back(summarize_method(report, kind, method));
  }
  return summaries;
}

std::vector<MethodFlicker> summarize_flicker(const Report& report) {
  std::vector<MethodFlicker> result;
  for (const std::string& method : report.methods) {
    std::vector<Flicker> list;
    for (const PairReport& pair : report.pairs) {
      for (const MethodFlicker& entry : pair.flicker) {
        if (entry.method == method) list.push_back(entry.flicker);
      }
    }
    if (!list.empty()) result.push_back({method, mean(list)});
  }
  return result;
}

json to_json(const Report& report) {
  json result{{"dataset", report.dataset},
              {"folder", report.folder},
              {"library_version", version()},
              {"parameters", json::object()},
              {"warm_up", report.warm_up},
              {"repeat", report.repeat},
              {"compared_methods", json::object()},
              {"pairs", json::array()},
              {"mean", means_json(summarize(report))},
              {"failures", json::array()}};
  for (const auto& [name, text] : report.parameters) result["parameters"][name] = text;
  for (const auto& [name, text] : report.opencv_settings) result["compared_methods"][name] = text;
  for (const PairReport& pair : report.pairs) {
    if (!pair.results.empty()) result["pairs"].push_back(pair_json(pair));
  }
  if (report.flicker || report.stream) {
    result["flicker"] = {{"noise", report.flicker ? json(*report.flicker) : json()},
                         {"frames", kFlickerFrames},
                         {"mean", flicker_json(summarize_flicker(report))}};
  }
  add_kinds(report, result);
  for (const Problem& failure : report.failures) {
    result["failures"].push_back({{"pair", failure.pair}, {"reason", failure.reason}});
  }
  return result;
}

}  // namespace mtstereo::eval
