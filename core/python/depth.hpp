// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace mtstereo::python {

/// Binds depth(), cloud() and Cloud. Needs Rectification.
void bind_depth(pybind11::module_& module);

}  // namespace mtstereo::python
