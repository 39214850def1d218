// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/arrays.hpp"

#include <string>

#include "mtstereo/parameters.hpp"

namespace py = pybind11;

namespace mtstereo::python {
namespace {

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

/// `filler`: what masked pixels are replaced by, in the remedy.
py::array array_of(const std::string& name, py::handle value, const std::string& filler = "0") {
  if (py::isinstance<py::array>(value)) {
    if (!py::hasattr(value, "filled")) return py::reinterpret_borrow<py::array>(value);
    throw py::type_error(name + " is a masked array, whose mask would be ignored: pass " + name +
                         ".filled(" + filler + ")");
  }
  if (value.is_none()) {
    throw py::type_error(name +
                         " is None: cv2.imread() returns None for a file that it cannot read");
  }
  throw py::type_error(name + " is of type " + Py_TYPE(value.ptr())->tp_name +
                       ": pass a NumPy array, for example numpy.asarray(" + name + ")");
}

void check_bytes(const std::string& name, const py::array& array) {
  // Not by identity: an array that was unpickled has another object for the same type.
  if (py::isinstance<py::array_t<std::uint8_t>>(array)) return;
  const std::string type = py::str(array.dtype());
  std::string remedy = "convert the values to 0 .. 255 and pass " + name + ".astype(numpy.uint8)";
  if (type == "uint16") remedy = "pass (" + name + " >> 8).astype(numpy.uint8) for 16-bit values";
  throw py::type_error(name + " has the dtype " + type + ", but images have 8 bits: " + remedy);
}

bool has_channels(const py::array& array) {
  return array.ndim() == 3 && (array.shape(2) == 3 || array.shape(2) == 4);
}

void check_sides(const std::string& name, const py::array& array) {
  for (const py::ssize_t side : {array.shape(0), array.shape(1)}) {
    if (side >= 1 && side <= kLargestImageSide) continue;
    throw py::value_error(name + " has the shape " + shape_text(array) +
                          ": each side must be 1 to " + std::to_string(kLargestImageSide) + " px");
  }
}

void check_two_dimensions(const std::string& name, const py::array& array) {
  if (has_channels(array)) {
    const std::string alpha = array.shape(2) == 4 ? "A" : "";
    throw py::value_error(name + " has the shape " + shape_text(array) +
                          ", a color image: pass gray values, cv2.cvtColor(" + name +
                          ", cv2.COLOR_BGR" + alpha + "2GRAY)");
  }
  if (array.ndim() != 2) {
    throw py::value_error(name + " has the shape " + shape_text(array) +
                          ": pass one image, of the shape (height, width)");
  }
  check_sides(name, array);
}

/// The view of an array whose type and shape are right, or of a copy in contiguous memory.
template <typename T>
ArrayView<T> view_or_copy(py::array array) {
  const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
  const auto pixel = static_cast<py::ssize_t>(sizeof(T)) * channels;
  const bool dense = channels == 1 || array.strides(2) == sizeof(T);
  const bool readable = dense && (array.strides(1) == pixel || array.shape(1) == 1) &&
                        (array.strides(0) >= array.shape(1) * pixel || array.shape(0) == 1);
  const bool as_is = readable && py::isinstance<py::array_t<T>>(array) &&
                     (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
  if (!as_is) array = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!array) throw py::error_already_set();
  return {array,
          {static_cast<const T*>(array.data()), static_cast<int>(array.shape(1)),
           static_cast<int>(array.shape(0)), array.strides(0)}};
}

}  // namespace

ArrayView<std::uint8_t> gray_view(const char* name, py::handle value) {
  const py::array array = array_of(name, value);
  check_bytes(name, array);
  check_two_dimensions(name, array);
  return view_or_copy<std::uint8_t>(array);
}

ArrayView<std::uint8_t> color_view(const char* name, py::handle value) {
  const py::array array = array_of(name, value);
  check_bytes(name, array);
  if (array.ndim() != 2 && !has_channels(array)) {
    throw py::value_error(
        name + std::string(" has the shape ") + shape_text(array) +
        ": pass (height, width), or (height, width, channels) with 3 or 4 channels");
  }
  check_sides(name, array);
  return view_or_copy<std::uint8_t>(array);
}

ArrayView<float> disparity_view(const char* name, py::handle value) {
  const py::array array = array_of(name, value, "numpy.nan");
  if (array.dtype().kind() != 'f') {
    throw py::type_error(
        name + std::string(" has the dtype ") + std::string(py::str(array.dtype())) +
        ": pass disparities in px as float32, NaN = unknown; those of mtstereo's 16-bit files are "
        "numpy.where(values > 0, values / 256, numpy.nan)");
  }
  check_two_dimensions(name, array);
  return view_or_copy<float>(array);
}

py::array_t<double> matrix3(const std::array<double, 9>& values) {
  return py::array_t<double>({3, 3}, values.data());
}

}  // namespace mtstereo::python
