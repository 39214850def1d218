// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace mtstereo {
namespace {

/// The angle from the first to the last pixel of a row or column [degrees].
double field_of(double focal_length, double center, int side) {
  if (side < 1 || !(focal_length > 0)) return 0;
  const double angle =
      std::atan((center + 0.5) / focal_length) + std::atan((side - 0.5 - center) / focal_length);
  return angle * 180 / std::numbers::pi;
}

/// A number with three digits that count, without an exponent.
std::string three_digits(double number) {
  char text[64];
  const int places =
      number > 0 && number < 100 ? 2 - static_cast<int>(std::floor(std::log10(number))) : 0;
  std::snprintf(text, sizeof text, "%.*f", std::clamp(places, 0, 6), number);
  return text;
}

/// A number with at most four digits, and no zeros at its end.
std::string plain(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", number);
  return text;
}

}  // namespace

RigFigures rig_figures(const Rectification& rectification, const DisparityRange& range) noexcept {
  RigFigures figures;
  figures.focal_length = rectification.focal_length;
  figures.baseline = rectification.baseline;
  figures.range = range;
  figures.horizontal_field =
      field_of(rectification.focal_length, rectification.left_center_x, rectification.width);
  figures.vertical_field =
      field_of(rectification.focal_length, rectification.center_y, rectification.height);
  const double offset = rectification.principal_offset();
  const double product = rectification.focal_length * rectification.baseline;
  const double smallest = std::max(range.smallest + offset, range.step);
  const double largest = range.largest + offset;
  if (range.largest != 0 && largest > 0) figures.nearest = product / largest;
  if (smallest > 0) figures.farthest = product / smallest;
  return figures;
}

std::string rig_text(const RigFigures& figures) {
  char text[160];
  std::snprintf(text, sizeof text, "focal length %.1f px, baseline %s m", figures.focal_length,
                three_digits(figures.baseline).c_str());
  std::string result = text;
  if (figures.horizontal_field > 0 && figures.vertical_field > 0) {
    std::snprintf(text, sizeof text, ", field of view %.0f x %.0f degrees",
                  figures.horizontal_field, figures.vertical_field);
    result += text;
  }
  const DisparityRange& range = figures.range;
  if (figures.nearest > 0 && figures.farthest > 0) {
    result += ", measures from " + three_digits(figures.nearest) + " m (" + plain(range.largest) +
              " px) to " + three_digits(figures.farthest) + " m (" +
              plain(std::max(range.smallest, range.step)) + " px)";
  }
  return result;
}

}  // namespace mtstereo
