// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/check_page.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/outputs/printable.hpp"
#include "lib/outputs/texts.hpp"
#include "programs/run/help_format.hpp"
#include "recordings/matching/view_geometry.hpp"
#include "recordings/matching/work_text.hpp"

namespace mtstereo::run {
namespace {

using outputs::counted;
using outputs::decimal;

constexpr std::size_t kLine = 100;
constexpr double kInStep = 0.02;  // of a frame

// `first` begins the first line, and as many spaces the others.
std::string indented(const std::string& first, const std::string& text) {
  const std::string margin(first.size(), ' ');
  std::string lines = first;
  for (const char each : wrapped(outputs::printable(text), kLine - first.size())) {
    lines += each;
    if (each == '\n') lines += margin;
  }
  return lines + "\n";
}

class FigureLines {
 public:
  explicit FigureLines(const CheckFigures& figures) : figures_(figures) {}

  std::string text() {
    line("views", views());
    line("rows", rows());
    line("time", time());
    line("light", light());
    line("sharpness", sharpness());
    if (figures_.range && !figures_.diagnosis.worthless()) line("disparities", disparities());
    const std::string cameras = measures_text(figures_.work);
    if (!cameras.empty()) line("cameras", cameras);
    return std::move(lines_);
  }

 private:
  void line(const std::string& name, const std::string& text) {
    constexpr std::size_t kName = 15;
    std::string first = "  " + name;
    first.resize(kName, ' ');
    lines_ += indented(first, text);
  }

  // "112 and 110"
  std::string both(double ViewFigures::*value, int digits, double factor = 1) const {
    return decimal(factor * (figures_.views[0].*value), digits) + " and " +
           decimal(factor * (figures_.views[1].*value), digits);
  }

  std::string views() const {
    return decimal(100 * figures_.diagnosis.matched, 0) +
           " % of the points of the left view are found in the right one";
  }

  std::string rows() const {
    const ViewInspection& found = figures_.inspection;
    if (!found.trusted) return "not measured: too few points, or they disagree";
    const RowExtremes extremes = rows_of(found, view_size(figures_.work));
    if (extremes.largest() < kVisibleRows) return "they agree within 0.1 px";
    return "the right view is " + rows_text(extremes) +
           (figures_.corrected ? ", corrected" : ", not corrected");
  }

  std::string time() const {
    const TimeFigures& times = figures_.times;
    if (!times.measured)
      return times.reason.empty() ? "not measured" : "not measured: " + times.reason;
    const double apart = std::abs(times.apart);
    const auto period = static_cast<double>(figures_.work.period) * 1e-9;
    const std::string deviation = decimal(1e3 * times.deviation, 1) + " ms";
    if (apart < kInStep * period) return "in step, with a standard deviation of " + deviation;
    return "the right view is " + decimal(1e3 * apart, 1) + " ms (" + decimal(apart / period, 2) +
           " frames) " + (times.apart < 0 ? "earlier" : "later") + ", standard deviation " +
           deviation;
  }

  std::string light() const {
    return "mean " + both(&ViewFigures::mean, 0) + " of 255, white " +
           both(&ViewFigures::saturated, 1, 100) + " %, noise " + both(&ViewFigures::noise, 1) +
           " (left and right)";
  }

  std::string sharpness() const {
    const double ratio = figures_.inspection.sharpness;
    std::string text = ratio > 0 ? "left / right " + decimal(ratio, 2) : "not compared";
    const ModeFigures* const usual = figures_.mode(kSemiDense);
    if (usual != nullptr && usual->fine_detail > 0) {
      text += ", finest detail " + decimal(usual->fine_detail, 2);
    }
    return text;
  }

  std::string disparities() const {
    const Parameters parameters = matcher_parameters(figures_.work.options);
    const int used = parameters.integer(Parameter::kMaxDisparity);
    return "the reliable ones reach " + decimal(figures_.range->reliable, 0) +
           " px; max-disparity=" + std::to_string(used) +
           (figures_.range_given ? " is given" : " suffices");
  }

  const CheckFigures& figures_;
  std::string lines_;
};

std::string expectation(const std::vector<ModeFigures>& modes) {
  std::string text =
      "Expected (estimated from four pairs at most; wrong: off by 3 px and 5 % or more)\n"
      "  mode                       known    wrong    time\n";
  for (const ModeFigures& mode : modes) {
    const std::string wrong = mode.wrong ? outputs::percent(*mode.wrong, 1) : "-  ";
    text += outputs::format("  %-26s%4.0f %%%9s%6.0f ms\n", mode.name.c_str(), 100 * mode.density,
                            wrong.c_str(), mode.milliseconds);
  }
  return text;
}

std::string verdict(const std::vector<Finding>& findings) {
  const auto harmful = std::count_if(findings.begin(), findings.end(),
                                     [](const Finding& each) { return each.harms; });
  const auto notes = static_cast<std::ptrdiff_t>(findings.size()) - harmful;
  const std::string more = notes > 0 ? ", " + counted(notes, "note") : "";
  return harmful == 0 ? "Result: good" + more + ".\n"
                      : "Result: bad, " + counted(harmful, "harmful finding") + more + ".\n";
}

}  // namespace

std::string check_page(const CheckFigures& figures, const std::vector<Finding>& findings) {
  const Work& work = figures.work;
  std::string page = indented("", work.recording.name + ": " + recognized(work).front());
  for (const std::string& remark : work.remarks) page += indented("- ", remark);
  page += "\n";
  for (const Finding& finding : findings) {
    page += indented(finding.harms ? "HARM  " : "note  ", finding.advice.problem);
    if (!finding.advice.remedy.empty()) page += indented("      > ", finding.advice.remedy);
  }
  if (!findings.empty()) page += "\n";
  page += "Measured\n" + FigureLines(figures).text() + "\n";
  if (!figures.modes.empty()) page += expectation(figures.modes) + "\n";
  return page + verdict(findings);
}

}  // namespace mtstereo::run
