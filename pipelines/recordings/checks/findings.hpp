// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "recordings/checks/check_figures.hpp"

namespace mtstereo::run {

/// Something that is wrong with a recording, or could be better.
struct Finding {
  bool harms = false;  ///< the results are wrong or missing until it is changed
  Advice advice;
};

/// What the figures of a recording mean: first the findings that harm.
std::vector<Finding> find_problems(const CheckFigures& figures);

}  // namespace mtstereo::run
