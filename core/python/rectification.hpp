// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace mtstereo::python {

/// Binds Rectification, rectify() and Rectifier. Needs Calibration.
void bind_rectification(pybind11::module_& module);

}  // namespace mtstereo::python
