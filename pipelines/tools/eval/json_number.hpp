// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace mtstereo::eval {

/// A figure; null if it could not be measured, because JSON has no NaN.
inline nlohmann::json json_number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace mtstereo::eval
