// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace mtstereo::python {

/// Binds Camera and Calibration.
void bind_calibration(pybind11::module_& module);

}  // namespace mtstereo::python
