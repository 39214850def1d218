// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/rectification.hpp"

#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "mtstereo/geometry/rectification.hpp"
#include "mtstereo/geometry/rig.hpp"
#include "python/arrays.hpp"
#include "python/errors.hpp"
#include "python/exclusive.hpp"

namespace py = pybind11;

namespace mtstereo::python {
namespace {

using Side = Rectifier::Side;

/// The rectifiers of both views.
class PairRectifier {
 public:
  PairRectifier(const StereoCalibration& calibration, const Rectification& rectification)
      : left_(value_of(Rectifier::create(calibration, rectification, Side::kLeft))),
        right_(value_of(Rectifier::create(calibration, rectification, Side::kRight))),
        width_(rectification.width),
        height_(rectification.height) {}

  py::tuple rectify(py::handle left, py::handle right, std::uint8_t border) {
    return py::make_tuple(apply(left_, "left", left, border),
                          apply(right_, "right", right, border));
  }

 private:
  py::array apply(Exclusive<Rectifier>& rectifier, const char* name, py::handle value,
                  std::uint8_t border) const {
    const ArrayView<std::uint8_t> in = color_view(name, value);
    const int channels = in.array.ndim() == 3 ? static_cast<int>(in.array.shape(2)) : 1;
    std::vector<py::ssize_t> shape = {height_, width_};
    if (in.array.ndim() == 3) shape.push_back(channels);
    py::array_t<std::uint8_t> result(shape);
    const ImageView<std::uint8_t> out{result.mutable_data(), width_, height_, result.strides(0)};
    require(
        rectifier.with([&](Rectifier& own) { return own.apply(in.view, out, channels, border); }));
    return result;
  }

  Exclusive<Rectifier> left_, right_;
  int width_, height_;
};

Rectification pinholes(double focal_length, double baseline, double center_x, double center_y,
                       double principal_offset) {
  Rectification rectification;
  rectification.left_rotation = rectification.right_rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  rectification.focal_length = focal_length;
  rectification.baseline = baseline;
  rectification.left_center_x = center_x;
  rectification.right_center_x = center_x + principal_offset;
  rectification.center_y = center_y;
  return rectification;
}

Rectification rectified(const StereoCalibration& calibration, double alpha, int width, int height,
                        bool zero_disparity, bool from_file) {
  RectificationOptions options;
  options.alpha = alpha;
  options.width = width;
  options.height = height;
  options.zero_disparity = zero_disparity;
  options.from_file = from_file;
  return value_of(rectify(calibration, options));
}

std::vector<std::string> remarks(const StereoCalibration& calibration,
                                 const Rectification& rectification) {
  std::vector<std::string> texts;
  for (const RectificationRemark& remark :
       value_of(rectification_remarks(calibration, rectification))) {
    texts.push_back((remark.side == Side::kLeft ? "left: " : "right: ") + remark.text);
  }
  return texts;
}

void bind_rectified(py::module_& module) {
  using R = Rectification;
  py::class_<R>(
      module, "Rectification",
      R"(The rectified cameras: of a calibration by rectify(), or of views that are rectified already.

Rectification(focal_length=721.5, baseline=0.54) is enough for depth(); cloud() also needs the principal point. str()
gives its figures in words.)")
      .def(py::init(&pinholes), py::kw_only(), py::arg("focal_length"), py::arg("baseline"),
           py::arg("center_x") = 0, py::arg("center_y") = 0, py::arg("principal_offset") = 0)
      .def_readonly("width", &R::width, "Of the rectified images [px].")
      .def_readonly("height", &R::height, "Of the rectified images [px].")
      .def_readonly("focal_length", &R::focal_length, "[px]")
      .def_readonly("baseline", &R::baseline, "Distance of the cameras [m].")
      .def_readonly("center_x", &R::left_center_x,
                    "Column of the principal point of the left view [px].")
      .def_readonly("center_y", &R::center_y, "Row of the principal points [px].")
      .def_property_readonly("principal_offset", &R::principal_offset,
                             "What depth() adds to a disparity [px]; Middlebury's doffs.")
      .def_property_readonly(
          "left_rotation",
          [](const R& rectification) { return matrix3(rectification.left_rotation); },
          "R1: float64, (3, 3), from the axes of the left camera to the rectified axes.")
      .def_property_readonly(
          "right_rotation",
          [](const R& rectification) { return matrix3(rectification.right_rotation); },
          "R2: float64, (3, 3), from the axes of the right camera to the rectified axes.")
      .def("__eq__", [](const R& a, const R& b) { return a == b; })
      .def("__str__", [](const R& rectification) { return rig_text(rig_figures(rectification)); });
}

}  // namespace

void bind_rectification(py::module_& module) {
  bind_rectified(module);
  module.def("rectify", &rectified, py::arg("calibration"), py::kw_only(), py::arg("alpha") = 0,
             py::arg("width") = 0, py::arg("height") = 0, py::arg("zero_disparity") = true,
             py::arg("from_file") = true,
             R"(The Rectification of a Calibration.

alpha: 0 keeps only pixels that both cameras see, 1 all pixels, -1 the focal length. width, height: of the rectified
images [px], 0 = as the cameras. zero_disparity: points at infinity have the disparity 0. from_file: take the
rectification that the file states, if all other options are the defaults. ValueError: the cameras cannot be rectified,
or an option is out of range.)");
  module.def("rectification_remarks", &remarks, py::arg("calibration"), py::arg("rectification"),
             "What is unusual about the rectified views: a list of sentences.");
  py::class_<PairRectifier>(
      module, "Rectifier",
      "Rectifies pairs: Rectifier(calibration, rectification)(left, right). It takes time to "
      "make, so keep it. ValueError: the calibration has no size of images; scaled() sets it.")
      .def(py::init<const StereoCalibration&, const Rectification&>(), py::arg("calibration"),
           py::arg("rectification"))
      .def("__call__", &PairRectifier::rectify, py::arg("left"), py::arg("right"),
           py::arg("border") = 0,
           R"(The rectified views (left, right): new arrays.

left, right: uint8, (height, width), or (height, width, channels) with 3 or 4 channels, of the size of the cameras.
border: the value of pixels that the camera does not see. Errors as for Matcher. The GIL is released.)");
}

}  // namespace mtstereo::python
