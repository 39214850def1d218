// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/eval/exponential_filter.hpp"
#include "tools/eval/json_number.hpp"
#include "tools/eval/official_report.hpp"

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
                      {"tepe", json_number(flicker.tepe)},
                      {"tepe1", json_number(flicker.tepe1)},
                      {"tepe3", json_number(flicker.tepe3)},
                      {"edges", json_number(flicker.edges.wrong)},
                      {"stale", json_number(flicker.edges.stale)},
                      {"age", json_number(flicker.edges.age)}};
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
    if (method.official) entry["official"] = official_json(*method.official);
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
  const auto add_mean = [&](const std::string& method) {
    std::vector<Flicker> list;
    for (const PairReport& pair : report.pairs) {
      for (const MethodFlicker& entry : pair.flicker) {
        if (entry.method == method) list.push_back(entry.flicker);
      }
    }
    if (!list.empty()) result.push_back({method, mean(list)});
  };
  for (const std::string& method : report.methods) {
    add_mean(method);
    add_mean(filtered_name(method));
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
  if (report.official) result["official"] = official_means_json(report);
  add_kinds(report, result);
  for (const Problem& failure : report.failures) {
    result["failures"].push_back({{"pair", failure.pair}, {"reason", failure.reason}});
  }
  return result;
}

namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string csv_number(double value) {
  return std::isfinite(value) ? json(value).dump() : std::string();
}

// The fields that the lines of one pair and method share.
struct CsvLine {
  std::string kind, pair, method, width, height, max_disparity, weight;
  const Evaluation* evaluation;
  double seconds, seconds_per_megapixel;
  std::string official_all, official_noc;  // the columns of --official, each with its comma
};

std::string csv_line(const CsvLine& line, const char* region, const Metrics& metrics,
                     const std::string& official) {
  std::vector<std::string> fields{csv_field(line.pair),
                                  csv_field(line.method),
                                  region,
                                  line.width,
                                  line.height,
                                  line.max_disparity,
                                  line.weight,
                                  std::to_string(metrics.known),
                                  std::to_string(metrics.compared),
                                  csv_number(metrics.avgerr),
                                  csv_number(metrics.rms),
                                  csv_number(metrics.d_all)};
  for (const double bad : metrics.bad) fields.push_back(csv_number(bad));
  fields.push_back(csv_number(line.evaluation->density));
  fields.push_back(csv_number(metrics.known_density));
  fields.push_back(csv_number(line.seconds));
  fields.push_back(csv_number(line.seconds_per_megapixel));
  const std::optional<std::int64_t>& flat = line.evaluation->flat_answers;
  fields.push_back(flat ? std::to_string(*flat) : "");
  fields.push_back(csv_field(line.kind));
  std::string text;
  for (const std::string& field : fields) text += (text.empty() ? "" : ",") + field;
  return text + official + "\n";
}

std::string csv_lines(const CsvLine& line) {
  std::string text = csv_line(line, "all", line.evaluation->all, line.official_all);
  if (line.evaluation->noc) {
    text += csv_line(line, "noc", *line.evaluation->noc, line.official_noc);
  }
  return text;
}

// The official columns of the line `all`, which has the pixels of the ground truth, and of `noc`.
void add_official(const MethodResult& result, CsvLine& line) {
  line.official_all = line.official_noc = no_official_csv_fields();
  if (!result.official) return;
  const OfficialCounts& counts = *result.official;
  const auto fields = [&](const RegionCounts& region) {
    return official_csv_fields(counts.benchmark, figures_of(region));
  };
  if (counts.noc) line.official_noc = fields(*counts.noc);
  line.official_all = counts.all ? fields(*counts.all) : line.official_noc;
}

// A line whose figures are only the official ones.
std::string csv_official_line(const OfficialSummary& summary, const char* region,
                              const OfficialFigures& figures) {
  Evaluation evaluation;
  evaluation.all.known = figures.pixels;
  evaluation.all.compared = figures.answered;
  evaluation.all.avgerr = figures.avgerr;
  evaluation.all.known_density = figures.density;
  const CsvLine line{kCleanKind,
                     "mean of " + std::string(benchmark_name(summary.benchmark)),
                     summary.method,
                     "",
                     "",
                     "",
                     "",
                     &evaluation,
                     kNone,
                     kNone,
                     "",
                     ""};
  return csv_line(line, region, evaluation.all, official_csv_fields(summary.benchmark, figures));
}

std::string csv_official_means(const Report& report) {
  std::string text;
  for (const OfficialSummary& summary : summarize_official(report)) {
    if (summary.all) text += csv_official_line(summary, "all", *summary.all);
    if (summary.noc) text += csv_official_line(summary, "noc", *summary.noc);
  }
  return text;
}

std::string csv_means(const Report& report, const std::string& kind) {
  const std::string official = report.official ? no_official_csv_fields() : "";
  std::string text;
  for (const Summary& summary : summarize(report, kind)) {
    text += csv_lines({kind, "mean", summary.method, "", "", "", "", &summary.evaluation, kNone,
                       summary.seconds_per_megapixel, official, official});
  }
  return text;
}

}  // namespace

std::string to_csv(const Report& report) {
  std::string text =
      "pair,method,region,width,height,max_disparity,weight,known_pixels,compared_pixels,avgerr,"
      "rms,"
      "d_all";
  for (const double threshold : kBadThresholds) text += "," + bad_name(threshold);
  text += ",density,known_density,seconds,seconds_per_megapixel,flat_answers,kind";
  text += (report.official ? official_csv_header() : "") + "\n";
  for (const PairReport& pair : report.pairs) {
    for (const MethodResult& result : pair.results) {
      CsvLine line{pair.kind,
                   pair.pair.name,
                   result.method,
                   std::to_string(pair.size.width),
                   std::to_string(pair.size.height),
                   std::to_string(pair.max_disparity),
                   csv_number(pair.pair.weight),
                   &result.evaluation,
                   result.seconds,
                   result.seconds_per_megapixel,
                   "",
                   ""};
      if (report.official) add_official(result, line);
      text += csv_lines(line);
    }
  }
  for (const std::string& kind : report.kinds) text += csv_means(report, kind);
  if (report.official) text += csv_official_means(report);
  return text;
}

}  // namespace mtstereo::eval
