// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// What was recognized and assumed, for people: input, views, matching and results, a line each.
std::vector<std::string> recognized(const Work& work);

}  // namespace mtstereo::run
