// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/arrays.hpp"

#include <string>

#include "mtstereo/parameters.hpp"

namespace py = pybind11;

namespace mtstereo::python {
namespace {

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

[[noreturn]] void refuse_object(const std::string& name, py::handle value) {
  if (value.is_none()) {
    throw py::type_error(name +
                         " is None: cv2.imread() returns None for a file that it cannot read");
  }
  throw py::type_error(name + " is of type " + Py_TYPE(value.ptr())->tp_name +
                       ": pass a NumPy array, for example numpy.asarray(" + name + ")");
}

void check_type(const std::string& name, const py::array& array) {
  if (array.dtype().is(py::dtype::of<std::uint8_t>())) return;
  const std::string type = py::str(array.dtype());
  std::string remedy =
      "convert the gray values to 0 .. 255 and pass " + name + ".astype(numpy.uint8)";
  if (type == "uint16")
    remedy = "pass (" + name + " >> 8).astype(numpy.uint8) for 16-bit gray values";
  throw py::type_error(name + " has the dtype " + type + ", but the views have 8 bits: " + remedy);
}

void check_shape(const std::string& name, const py::array& array) {
  if (array.ndim() == 3 && (array.shape(2) == 3 || array.shape(2) == 4)) {
    const std::string alpha = array.shape(2) == 4 ? "A" : "";
    throw py::value_error(name + " has the shape " + shape_text(array) +
                          ", a color image: pass gray values, cv2.cvtColor(" + name +
                          ", cv2.COLOR_BGR" + alpha + "2GRAY)");
  }
  if (array.ndim() != 2) {
    throw py::value_error(name + " has the shape " + shape_text(array) +
                          ": pass one gray image, of the shape (height, width)");
  }
  for (const py::ssize_t side : {array.shape(0), array.shape(1)}) {
    if (side >= 1 && side <= kLargestImageSide) continue;
    throw py::value_error(name + " has the shape " + shape_text(array) +
                          ": each side must be 1 to " + std::to_string(kLargestImageSide) + " px");
  }
}

}  // namespace

ArrayView<std::uint8_t> gray_view(const char* name, py::handle value) {
  if (!py::isinstance<py::array>(value)) refuse_object(name, value);
  auto array = py::reinterpret_borrow<py::array>(value);
  check_type(name, array);
  check_shape(name, array);
  const bool readable = (array.strides(1) == 1 || array.shape(1) == 1) &&
                        (array.strides(0) >= array.shape(1) || array.shape(0) == 1);
  if (!readable) array = py::array_t<std::uint8_t, py::array::c_style>::ensure(array);
  if (!array) throw py::error_already_set();
  return {array,
          {static_cast<const std::uint8_t*>(array.data()), static_cast<int>(array.shape(1)),
           static_cast<int>(array.shape(0)), array.strides(0)}};
}

}  // namespace mtstereo::python
