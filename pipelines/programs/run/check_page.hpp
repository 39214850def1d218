// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "recordings/checks/findings.hpp"

namespace mtstereo::run {

/// One page about a recording: findings with remedies, what was measured, what to expect.
std::string check_page(const CheckFigures& figures, const std::vector<Finding>& findings);

}  // namespace mtstereo::run
