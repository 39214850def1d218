// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "eval/json_number.hpp"

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
          {"noc", evaluation.noc ? metrics_json(*evaluation.noc) : json(nullptr)}};
}

json pair_json(const PairReport& pair) {
  json result{{"name", pair.pair.name},
              {"left", pair.pair.left.string()},
              {"right", pair.pair.right.string()},
              {"ground_truth", pair.pair.truth.string()},
              {"width", pair.size.width},
              {"height", pair.size.height},
              {"max_disparity", pair.max_disparity},
              {"weight", pair.pair.weight},
              {"results", json::object()}};
  for (const MethodResult& method : pair.results) {
    json entry = evaluation_json(method.evaluation);
    entry["seconds"] = json_number(method.seconds);
    entry["seconds_per_megapixel"] = json_number(method.seconds_per_megapixel);
    result["results"][method.method] = std::move(entry);
  }
  return result;
}

const MethodResult* result_of(const PairReport& pair, const std::string& method) {
  const auto found = std::find_if(pair.results.begin(), pair.results.end(),
                                  [&](const MethodResult& r) { return r.method == method; });
  return found == pair.results.end() ? nullptr : &*found;
}

Summary summarize_method(const Report& report, const std::string& method) {
  Summary summary;
  summary.method = method;
  std::vector<WeightedEvaluation> evaluations;
  double time = 0, ratio = 0;
  int both = 0;
  for (const PairReport& pair : report.pairs) {
    const MethodResult* result = result_of(pair, method);
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

}  // namespace

std::vector<Summary> summarize(const Report& report) {
  std::vector<Summary> summaries;
  for (const std::string& method : report.methods) {
    summaries.push_back(summarize_method(report, method));
  }
  return summaries;
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
              {"mean", json::object()},
              {"failures", json::array()}};
  for (const auto& [name, text] : report.parameters) result["parameters"][name] = text;
  for (const auto& [name, text] : report.rival_settings) result["compared_methods"][name] = text;
  for (const PairReport& pair : report.pairs) {
    if (!pair.results.empty()) result["pairs"].push_back(pair_json(pair));
  }
  for (const Summary& summary : summarize(report)) {
    json entry = evaluation_json(summary.evaluation);
    entry["pairs"] = summary.pairs;
    entry["seconds_per_megapixel"] = json_number(summary.seconds_per_megapixel);
    entry["time_ratio"] = json_number(summary.time_ratio);
    result["mean"][summary.method] = std::move(entry);
  }
  if (report.curve) result["curve"] = curves_json(*report.curve);
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
  std::string pair, method, width, height, max_disparity, weight;
  const Evaluation* evaluation;
  double seconds, seconds_per_megapixel;
};

std::string csv_line(const CsvLine& line, const char* region, const Metrics& metrics) {
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
  std::string text;
  for (const std::string& field : fields) text += (text.empty() ? "" : ",") + field;
  return text + "\n";
}

std::string csv_lines(const CsvLine& line) {
  std::string text = csv_line(line, "all", line.evaluation->all);
  if (line.evaluation->noc) text += csv_line(line, "noc", *line.evaluation->noc);
  return text;
}

}  // namespace

std::string to_csv(const Report& report) {
  std::string text =
      "pair,method,region,width,height,max_disparity,weight,known_pixels,compared_pixels,avgerr,"
      "rms,"
      "d_all";
  for (const double threshold : kBadThresholds) text += "," + bad_name(threshold);
  text += ",density,known_density,seconds,seconds_per_megapixel\n";
  for (const PairReport& pair : report.pairs) {
    for (const MethodResult& result : pair.results) {
      text += csv_lines({pair.pair.name, result.method, std::to_string(pair.size.width),
                         std::to_string(pair.size.height), std::to_string(pair.max_disparity),
                         csv_number(pair.pair.weight), &result.evaluation, result.seconds,
                         result.seconds_per_megapixel});
    }
  }
  for (const Summary& summary : summarize(report)) {
    text += csv_lines({"mean", summary.method, "", "", "", "", &summary.evaluation, kNone,
                       summary.seconds_per_megapixel});
  }
  return text;
}

}  // namespace mtstereo::eval
