// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "mtstereo/parameters.hpp"

// The rows of the parameter table as keyword arguments.

namespace mtstereo::python {

/// Sets parameters from keyword arguments; None resets one to its default. Throws TypeError for an
/// unknown keyword or a value of another type, and ValueError for a value that is not allowed;
/// `parameters` is unchanged then.
void set_parameters(Parameters& parameters, const pybind11::kwargs& keywords);

/// The values in effect, by keyword.
pybind11::dict parameter_values(const Parameters& parameters);

/// The descriptions of all keywords, for a docstring.
std::string keywords_text();

/// Binds ParameterInfo and parameter_table().
void bind_parameters(pybind11::module_& module);

}  // namespace mtstereo::python
