// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/black_maps.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace mtstereo::plugin {
namespace {

/// Largest minus smallest gray value of a view.
int contrast(GrayView view) {
  std::uint8_t least = 255, most = 0;
  for (int y = 0; y < view.height; ++y) {
    const auto [low, high] = std::minmax_element(view.row(y), view.row(y) + view.width);
    least = std::min(least, *low);
    most = std::max(most, *high);
  }
  return most - least;
}

}  // namespace

std::optional<double> BlackMaps::mean(double density, bool explained) {
  if (explained || reported_) {
    pairs_ = 0;
    sum_ = 0;
    return std::nullopt;
  }
  sum_ += density;
  if (++pairs_ < kPairs) return std::nullopt;
  pairs_ = 0;
  return std::exchange(sum_, 0) / kPairs;
}

std::string black_maps_text(double density, bool sparse, GrayView left, GrayView right) {
  constexpr double kUsual = 0.5;  // such maps are not worth a look at the views
  constexpr int kFewValues = 16;  // as of 12 of 16 bits
  if (density > kUsual) return {};
  char share[40];
  std::snprintf(share, sizeof share, "%.1f %% of the pixels", 100 * density);
  const int values = std::max(contrast(left), contrast(right)) + 1;
  if (values <= kFewValues) {
    return "The views have no more than " + std::to_string(values) +
           " gray values, and the maps disparities in " + share +
           ": check light and lens caps. If the cameras use 10 or 12 of 16 bits, set them to 8 "
           "bits, or to a mode that uses all 16.";
  }
  if (density >= (sparse ? 0.01 : 0.05)) return {};
  return "The maps are nearly black: the last " + std::to_string(BlackMaps::kPairs) +
         " have disparities in " + share +
         ". Possible causes: views that were not taken at the same time or not rectified, a search "
         "range that does not fit (min-disparity, max-disparity), little light or texture. "
         "mtstereo-run LEFT RIGHT --check looks for the cause in a recording.";
}

}  // namespace mtstereo::plugin
