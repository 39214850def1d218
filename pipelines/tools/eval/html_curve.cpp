// SPDX-License-Identifier: LGPL-2.1-or-later

// The curves of the HTML report as SVG.

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "tools/eval/html_report.hpp"

namespace mtstereo::eval {
namespace {

constexpr double kLeft = 40, kTop = 24, kWidth = 320, kHeight = 190, kMargin = 12, kBelow = 34;
constexpr double kMostDensity = 100;
// Of the methods, as in plot.py.
constexpr std::array kColors{"#d22828", "#1464be", "#1e8c46", "#8232aa", "#e68c00"};

struct Point {
  double density, error;
};

// The points of a line; an envelope is sampled at each whole percent.
std::vector<Point> points_of(const Curve& curve, const CurveMeasure& measure) {
  std::vector<Point> points;
  if (curve.envelope) {
    for (int density = 0; density <= kMostDensity; ++density) {
      points.push_back({static_cast<double>(density), error_at(curve.sweep, density, measure)});
    }
  } else {
    for (const CurvePoint& point : curve.sweep.points) {
      points.push_back({point.density, point.*measure.value});
    }
  }
  std::erase_if(points,
                [](const Point& p) { return std::isnan(p.density) || std::isnan(p.error); });
  return points;
}

// The step of about five grid lines: 1, 2 or 5 times a power of ten.
double step_of(double most) {
  const double power = std::pow(10, std::floor(std::log10(most / 5)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * 5 >= most) return factor * power;
  }
  return 10 * power;
}

class Drawing {
 public:
  Drawing(const std::string& title, double most) : most_(most) {
    text_ << "<svg width='" << kLeft + kWidth + kMargin << "' height='" << kTop + kHeight + kBelow
          << "' font-family='sans-serif' font-size='11'>\n<text x='" << kLeft
          << "' y='14' font-weight='bold'>" << html_text(title) << "</text>\n";
  }

  void grid() {
    for (int density = 0; density <= kMostDensity; density += 20) {
      line({density + 0.0, 0}, {density + 0.0, most_});
      label(x(density), kTop + kHeight + 14, "middle", density);
    }
    const double step = step_of(most_);
    for (int i = 0; i * step <= most_ * 1.0001; ++i) {
      line({0, i * step}, {kMostDensity, i * step});
      label(kLeft - 4, y(i * step) + 4, "end", i * step);
    }
    text_ << "<text x='" << kLeft + kWidth << "' y='" << kTop + kHeight + 28
          << "' text-anchor='end'>density [%]</text>\n";
  }

  void curve(const Curve& curve, const std::vector<Point>& points) {
    text_ << "<polyline fill='none' stroke='" << kColors[curve.method % kColors.size()]
          << "' stroke-width='"
          << (curve.method == 0 ? 2.5
              : curve.envelope  ? 1.7
                                : 0.8)
          << "' points='";
    for (const Point& p : points) text_ << x(p.density) << ',' << y(p.error) << ' ';
    text_ << "'><title>" << html_text(curve.name) << "</title></polyline>\n";
  }

  std::string finish() {
    text_ << "</svg>\n";
    return text_.str();
  }

 private:
  static double x(double density) { return kLeft + kWidth * density / kMostDensity; }
  double y(double error) const { return kTop + kHeight * (1 - error / most_); }

  void line(Point from, Point to) {
    text_ << "<line stroke='#ddd' x1='" << x(from.density) << "' y1='" << y(from.error) << "' x2='"
          << x(to.density) << "' y2='" << y(to.error) << "'/>\n";
  }
  void label(double at_x, double at_y, const char* anchor, double value) {
    text_ << "<text x='" << at_x << "' y='" << at_y << "' text-anchor='" << anchor << "'>" << value
          << "</text>\n";
  }

  double most_;
  std::ostringstream text_;
};

}  // namespace

std::string curve_svg(const CurveReport& report, const CurveMeasure& measure) {
  std::vector<std::vector<Point>> lines;
  double most = 0;
  for (const Curve& curve : report.curves) {
    lines.push_back(points_of(curve, measure));
    for (const Point& point : lines.back()) most = std::max(most, point.error);
  }
  Drawing drawing(report.kind + ": " + measure.name + " [" + measure.unit + "]",
                  most > 0 ? most : 1);
  drawing.grid();
  // The library's line is the last one, above the others.
  for (std::size_t i = lines.size(); i-- > 0;) drawing.curve(report.curves[i], lines[i]);
  return drawing.finish();
}

}  // namespace mtstereo::eval
