// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mtstereo/parameters.hpp"
#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// The values of WorkOptions::parameters that are parameters of the matcher; the others are
/// properties of the element. A max-disparity that is to be found counts as not set. Throws
/// UserError if one is not valid.
Parameters matcher_parameters(const WorkOptions& options);
/// The size of a view before it is rectified [px].
struct ViewSize {
  int width = 0, height = 0;
};
ViewSize view_size(const Work& work);

/// Whether a value of max-disparity asks for find_range(): "auto" or "0".
bool is_range_to_find(const std::string& value);
/// The value of a property; empty if it is not set.
std::string property_of(const WorkOptions& options, const std::string& name);

/// Checks that the products can be made of a recording. Throws UserError.
void check_products(const Recording& recording, const WorkOptions& options);

/// Adds what follows from the recording: its search range, and a scale of the values that it fits
/// into. Throws UserError if the parameters do not fit the frames.
void complete_options(Work& work);

}  // namespace mtstereo::run
