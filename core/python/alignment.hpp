// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace mtstereo::python {

/// Binds RowField, ViewCorrection, PairFindings and Alignment.
void bind_alignment(pybind11::module_& module);

}  // namespace mtstereo::python
