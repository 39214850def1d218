// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tools/eval/datasets.hpp"
#include "tools/eval/options.hpp"
#include "tools/eval/report.hpp"

namespace mtstereo::eval {

/// Runs before the evaluation, which can take hours: throws UserError if a requested file cannot
/// be written or belongs to the data set.
void check_outputs(const Options& options, const DataSet& set);

/// Writes the requested files. A file that cannot be written is named on the standard error, and
/// the others are still written. Returns whether all of them were written.
bool write_outputs(const Options& options, const Report& report);

}  // namespace mtstereo::eval
