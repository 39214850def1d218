// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/pybind11.h>

#include "mtstereo/matcher.hpp"
#include "python/alignment.hpp"
#include "python/calibration.hpp"
#include "python/depth.hpp"
#include "python/keywords.hpp"
#include "python/matcher.hpp"
#include "python/rectification.hpp"

namespace py = pybind11;

namespace {

// Objects of one interpreter would be seen by another one, whose lock does not protect them.
void require_main_interpreter() {
  if (PyInterpreterState_Get() == PyInterpreterState_Main()) return;
  throw py::import_error(
      "mtstereo works in the main interpreter only, not in a sub-interpreter: use threads, for "
      "which it releases the "
      "GIL, or processes");
}

}  // namespace

PYBIND11_MODULE(_mtstereo, module) {
  using namespace mtstereo;
  module.doc() = "The binding of libmtstereo and libmtstereo-geometry; import mtstereo instead.";
  module.attr("__version__") = version();
  module.def("require_main_interpreter", &require_main_interpreter);
  python::bind_parameters(module);
  python::bind_alignment(module);
  python::bind_matcher(module);
  python::bind_calibration(module);
  python::bind_rectification(module);
  python::bind_depth(module);
}
