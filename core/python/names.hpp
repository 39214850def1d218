// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mtstereo/parameters.hpp"

// The names of parameters in Python.

namespace mtstereo::python {

/// The keyword of a parameter: its name with '_' in place of '-'.
std::string keyword_of(const ParameterInfo& info);

/// A text of the library with the keywords in place of the names of parameters.
std::string with_keywords(std::string text);

}  // namespace mtstereo::python
