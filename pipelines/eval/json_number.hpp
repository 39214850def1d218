// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace mtstereo::eval {

/// A figure; null where it could not be measured, as JSON has no NaN.
inline nlohmann::json json_number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace mtstereo::eval
