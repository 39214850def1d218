// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "programs/run/options.hpp"

namespace mtstereo::run {

/// mtstereo-run --check: prints a page about each recording, and with --out writes an image of the
/// rows. Returns the exit status: kDone if all are good, kWorthless if a finding harms, kIncomplete
/// if some cannot be checked. Throws UserError if the only one cannot be.
int run_check_command(const std::vector<Recording>& recordings,
                      const std::vector<Problem>& problems, const Options& options);

}  // namespace mtstereo::run
