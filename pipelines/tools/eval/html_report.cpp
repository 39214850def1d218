// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/html_report.hpp"

#include <array>
#include <map>
#include <sstream>

#include "tools/eval/html_style.hpp"
#include "tools/eval/text_table.hpp"

namespace mtstereo::eval {
namespace {

// A cell with a number; the page sorts by its value, and cells without one last.
std::string number_cell(double value, int digits) {
  const std::string text = fixed(value, digits);
  return "<td data-value='" + (text == "-" ? "" : text) + "'>" + text + "</td>";
}

std::string text_cell(const std::string& text) { return "<td>" + html_text(text) + "</td>"; }

std::string head_row(const std::vector<std::string>& names) {
  std::string text = "<thead><tr>";
  for (const std::string& name : names) {
    text += (name == "pictures" ? "<th class='pictures'>" : "<th>") + name + "</th>";
  }
  return text + "</tr></thead>\n";
}

std::string figure_cells(const Evaluation& evaluation, double seconds_per_megapixel) {
  static_assert(kBadThresholds[1] == 1);
  const double flat =
      evaluation.flat_answers ? static_cast<double>(*evaluation.flat_answers) : kNone;
  return number_cell(evaluation.all.avgerr, 3) + number_cell(evaluation.all.d_all, 2) +
         number_cell(evaluation.all.bad[1], 2) + number_cell(evaluation.density, 1) +
         number_cell(flat, 0) + number_cell(seconds_per_megapixel, 3);
}

void write_settings(std::ostream& out, const Report& report) {
  out << "<p>" << html_text(report.dataset) << " in " << html_text(report.folder) << ", mtstereo "
      << html_text(version()) << "</p>\n<details><summary>Parameters</summary><p>";
  for (const auto& [name, text] : report.parameters) {
    out << html_text(name) << " = " << html_text(text) << "<br>\n";
  }
  for (const auto& [method, settings] : report.rival_settings) {
    out << html_text(method) << ": OpenCV, " << html_text(settings) << "<br>\n";
  }
  out << "</p></details>\n";
  for (const Problem& failure : report.failures) {
    out << "<p class='failures'>" << html_text(failure.pair + ": " + failure.reason) << "</p>\n";
  }
}

void write_means(std::ostream& out, const Report& report) {
  out << "<h2>Means</h2>\n<table>"
      << head_row({"images", "method", "pairs", "avgerr px", "D-all %", "bad1 %", "density %",
                   "flat", "s/MP"})
      << "<tbody>\n";
  for (const std::string& kind : report.kinds) {
    for (const Summary& mean : summarize(report, kind)) {
      if (mean.pairs == 0) continue;
      out << "<tr>" << text_cell(kind) << text_cell(mean.method) << number_cell(mean.pairs, 0)
          << figure_cells(mean.evaluation, mean.seconds_per_megapixel) << "</tr>\n";
    }
  }
  out << "</tbody></table>\n";
}

void write_flicker(std::ostream& out, const Report& report) {
  if (!report.flicker) return;
  out << "<h2>Flicker at noise " << *report.flicker << "</h2>\n<table>"
      << head_row({"method", "density %", "come and go %", "spread px"}) << "<tbody>\n";
  for (const auto& [method, flicker] : summarize_flicker(report)) {
    out << "<tr>" << text_cell(method) << number_cell(flicker.density, 1)
        << number_cell(flicker.come_and_go, 1) << number_cell(flicker.spread, 3) << "</tr>\n";
  }
  out << "</tbody></table>\n";
}

void write_curves(std::ostream& out, const Report& report) {
  if (report.curves.empty()) return;
  out << "<h2>Error against density</h2>\n";
  for (const CurveMeasure& measure : {kCurveMeasures[0], kCurveMeasures[1]}) {
    out << "<div>\n";
    for (const CurveReport& curve : report.curves) {
      if (curve.pairs > 0) out << curve_svg(curve, measure);
    }
    out << "</div>\n";
  }
  out << "<p>";
  for (const Curve& curve : report.curves.front().curves) {
    out << html_text(curve.name) << ": " << html_text(curve.settings) << "<br>\n";
  }
  out << "</p>\n";
}

std::string figure(const std::string& caption, const std::string& source) {
  return "<figure><img loading='lazy' alt='" + caption + "' " + source + "><figcaption>" + caption +
         "</figcaption></figure>";
}

// The ground truth of a pair is stored once, in its first row with pictures.
using TruthIds = std::map<std::string, std::size_t>;

std::string picture_cell(const PairReport& pair, TruthIds& ids) {
  if (pair.pictures.left.empty()) return "<td class='pictures'></td>";
  const auto [found, first] = ids.try_emplace(pair.pair.name, ids.size());
  const std::string id = "truth" + std::to_string(found->second);
  const std::string truth =
      first ? "id='" + id + "' src='" + pair.pictures.truth + "'" : "data-copy='" + id + "'";
  return "<td class='pictures'>" + figure("left", "src='" + pair.pictures.left + "'") +
         figure("ground truth", truth) +
         figure("disparity", "src='" + pair.pictures.disparity + "'") +
         figure("error", "src='" + pair.pictures.error + "'") +
         figure("confidence", "src='" + pair.pictures.confidence + "'") + "</td>";
}

std::string choice(const std::string& id, const std::vector<std::string>& values) {
  std::string text = "<label>" + id + " <select id='" + id + "'><option value=''>all</option>";
  for (const std::string& value : values) text += "<option>" + html_text(value) + "</option>";
  return text + "</select></label>\n";
}

void write_results(std::ostream& out, const Report& report) {
  out << "<h2>Results</h2>\n<p>A click on a heading sorts, a click on a picture enlarges it. "
         "Disparities: blue = 0, red = search range, black = none. Errors: blue = 0, red = 5 px "
         "and "
         "more, gray = no disparity, black = no ground truth. Confidence: black = none, white = "
         "255. Errors of enlarged images are in px of the original.</p>\n<p><label>pair <input "
         "id='pair'></label>\n"
      << choice("images", report.kinds) << choice("method", report.methods)
      << "</p>\n<table id='results' class='sortable'>"
      << head_row({"pair", "images", "method", "avgerr px", "D-all %", "bad1 %", "density %",
                   "flat", "s/MP", "pictures"})
      << "<tbody>\n";
  TruthIds ids;
  for (const PairReport& pair : report.pairs) {
    for (const MethodResult& result : pair.results) {
      out << "<tr>" << text_cell(pair.pair.name) << text_cell(pair.kind) << text_cell(result.method)
          << figure_cells(result.evaluation, result.seconds_per_megapixel)
          << (result.method == kOwnMethod ? picture_cell(pair, ids) : "<td class='pictures'></td>")
          << "</tr>\n";
    }
  }
  out << "</tbody></table>\n<dialog><img alt=''></dialog>\n";
}

}  // namespace

std::string html_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string to_html(const Report& report) {
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n<title>mtstereo-eval: "
      << html_text(report.dataset) << "</title>\n<style>" << kHtmlStyle
      << "</style>\n</head>\n<body>\n<h1>mtstereo-eval, mode "
      << html_text(parameter_text(report, "mode")) << "</h1>\n";
  write_settings(out, report);
  write_means(out, report);
  write_flicker(out, report);
  write_curves(out, report);
  write_results(out, report);
  out << "<script>" << kHtmlScript << "</script>\n</body>\n</html>\n";
  return out.str();
}

}  // namespace mtstereo::eval
