// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/errors.hpp"

#include <pybind11/pybind11.h>

#include <new>

#include "python/names.hpp"

namespace py = pybind11;

namespace mtstereo::python {

void raise(const Error& error) {
  if (error.code == ErrorCode::kOutOfMemory) {
    if (error.message.empty()) throw std::bad_alloc();
    PyErr_SetString(PyExc_MemoryError, error.message.c_str());
    throw py::error_already_set();
  }
  if (error.code == ErrorCode::kSystem) {
    PyErr_SetString(PyExc_OSError, error.message.c_str());
    throw py::error_already_set();
  }
  throw py::value_error(with_keywords(error.message));
}

}  // namespace mtstereo::python
