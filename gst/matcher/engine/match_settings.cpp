// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/match_settings.hpp"

namespace mtstereo::plugin {
namespace {

constexpr int kUsualScale = 256;  // [steps per px]

}  // namespace

void MatchSettings::fit_scale() {
  if (scale_is_set) return;
  int scale = kUsualScale;
  while (scale > 1 && !parameters.check_scale16(scale)) scale /= 2;
  // A range that fits at no scale is refused with the usual one.
  disparity_scale = parameters.check_scale16(scale) ? scale : kUsualScale;
}

DisparityUnit MatchSettings::unit() const {
  return {.scale = disparity_scale,
          .max_disparity = parameters.integer(Parameter::kMaxDisparity),
          .min_disparity = parameters.integer(Parameter::kMinDisparity),
          .offset = parameters.disparity_offset()};
}

bool MatchSettings::has_other_scale() const {
  return disparity_scale != kUsualScale && !scale_is_set;
}

std::string MatchSettings::text() const {
  std::string text;
  for (const ParameterInfo& info : parameter_table()) {
    text += std::string(" ") + info.name + "=" + parameters.text(info.id);
  }
  return text + " disparity-scale=" + std::to_string(disparity_scale);
}

}  // namespace mtstereo::plugin
