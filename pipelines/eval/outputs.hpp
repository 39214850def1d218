// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "eval/datasets.hpp"
#include "eval/options.hpp"
#include "eval/report.hpp"

namespace mtstereo::eval {

/// Before the work, which can take hours: throws InputError where a file that is asked for cannot
/// be written, or is one of the data set's own.
void check_outputs(const Options& options, const DataSet& set);

/// Writes the files that are asked for. A file that cannot be written is named on the standard
/// error and takes no other with it; false then.
bool write_outputs(const Options& options, const Report& report);

}  // namespace mtstereo::eval
