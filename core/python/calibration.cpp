// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/calibration.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "mtstereo/geometry/calibration.hpp"
#include "python/arrays.hpp"
#include "python/errors.hpp"

namespace py = pybind11;

namespace mtstereo::python {
namespace {

const char* lens_name(const CameraCalibration& camera) {
  constexpr const char* kNames[] = {"none", "plumb-bob", "fisheye", "omnidirectional"};
  return kNames[static_cast<int>(camera.lens)];
}

py::array_t<double> matrix_of(const CameraCalibration& camera) {
  return matrix3({camera.focal_x, 0, camera.center_x, 0, camera.focal_y, camera.center_y, 0, 0, 1});
}

StereoCalibration read(const std::filesystem::path& path, int width, int height) {
  const py::gil_scoped_release released;
  auto calibration = read_calibration(path.string(), width, height);
  const py::gil_scoped_acquire acquired;
  return value_of(std::move(calibration));
}

void write(const StereoCalibration& calibration, const std::filesystem::path& path) {
  require(write_calibration(calibration, path.string()));
}

void bind_camera(py::module_& module) {
  py::class_<CameraCalibration>(module, "Camera",
                                "One camera and its lens, as the calibration states it.")
      .def_readonly("width", &CameraCalibration::width, "Of its image [px]; 0 = unknown.")
      .def_readonly("height", &CameraCalibration::height, "Of its image [px]; 0 = unknown.")
      .def_property_readonly("matrix", &matrix_of, "K: float64, (3, 3) [px].")
      .def_property_readonly("lens", &lens_name,
                             "'none', 'plumb-bob', 'fisheye' or 'omnidirectional'.")
      .def_readonly(
          "coefficients", &CameraCalibration::coefficients,
          "The distortion: a list in OpenCV's order; docs/calibration.md describes the models.");
}

}  // namespace

void bind_calibration(py::module_& module) {
  bind_camera(module);
  using Calibration = StereoCalibration;
  py::class_<Calibration>(module, "Calibration",
                          "Two cameras and how they stand to each other; read() reads a file.")
      .def_static("read", &read, py::arg("path"), py::arg("width") = 0, py::arg("height") = 0,
                  R"(Reads a calibration file; the format is recognized from the content.

path: a file, or "LEFT,RIGHT" for formats with one file per camera; "FILE#CHOICE" selects (docs/calibration.md).
width, height: of the video [px], if known. ValueError: the file cannot be read or is not a sound calibration; the
message names the file, the entry and what to do.)")
      .def("write", &write, py::arg("path"),
           "Writes it as YAML that read() and OpenCV's FileStorage read. OSError: the file cannot "
           "be written, or is there and mtstereo did not write it.")
      .def(
          "scaled",
          [](const Calibration& calibration, int width, int height) {
            return value_of(scale_calibration(calibration, width, height));
          },
          py::arg("width"), py::arg("height"),
          "The calibration for video of another size [px] with the same aspect ratio. ValueError: "
          "another ratio.")
      .def_readonly("left", &Calibration::left, "The left Camera.")
      .def_readonly("right", &Calibration::right, "The right Camera.")
      .def_property_readonly(
          "rotation", [](const Calibration& calibration) { return matrix3(calibration.rotation); },
          "R: float64, (3, 3). A point X of the left camera is R X + T in the right one.")
      .def_property_readonly(
          "translation",
          [](const Calibration& calibration) {
            return py::array_t<double>(3, calibration.translation.data());
          },
          "T: float64, (3,) [m].")
      .def_property_readonly("baseline", &Calibration::baseline, "Distance of the cameras [m].")
      .def_readonly("format", &Calibration::format,
                    "What the file was recognized as, as in 'OpenCV'.")
      .def_readonly("date", &Calibration::date, "Of the calibration, ISO 8601, or ''.")
      .def_readonly("remarks", &Calibration::remarks,
                    "What is unusual about it: a list of sentences.");
}

}  // namespace mtstereo::python
