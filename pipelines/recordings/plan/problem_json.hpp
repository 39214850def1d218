// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Problem, input, reason)

}  // namespace mtstereo::run
