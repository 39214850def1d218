// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/depth.hpp"

#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mtstereo/geometry/depth.hpp"
#include "mtstereo/geometry/point_cloud.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "python/arrays.hpp"
#include "python/errors.hpp"

namespace py = pybind11;

namespace mtstereo::python {
namespace {

DepthGeometry geometry_of(const Rectification& rectification) {
  DepthGeometry geometry;
  geometry.focal_length = rectification.focal_length;
  geometry.baseline = rectification.baseline;
  geometry.principal_offset = rectification.principal_offset();
  geometry.center_x = rectification.left_center_x;
  geometry.center_y = rectification.center_y;
  return geometry;
}

/// The map of `disparity`, which must have the size of the views of `rectification` if it is known.
ArrayView<float> map_of(py::handle disparity, const Rectification& rectification) {
  ArrayView<float> map = disparity_view("disparity", disparity);
  const auto [width, height] = std::pair(rectification.width, rectification.height);
  if (width == 0 || (map.view.width == width && map.view.height == height)) return map;
  const auto size = [](int x, int y) {
    return std::to_string(x) + "x" + std::to_string(y) + " px";
  };
  throw py::value_error("disparity has " + size(map.view.width, map.view.height) +
                        ", but the rectified views " + size(width, height) +
                        ": depths would be wrong. Pass the map of these views, or set width and "
                        "height of rectify()");
}

/// DepthGeometry::depth_of() for a disparity that no 16-bit value has.
float depth_of(float disparity, double focal_times_baseline, double principal_offset) {
  if (!std::isfinite(disparity)) return std::numeric_limits<float>::quiet_NaN();  // as in .pfm
  const double moved = static_cast<double>(disparity) + principal_offset;
  if (!(moved > 0)) return std::numeric_limits<float>::infinity();
  return static_cast<float>(focal_times_baseline / moved);
}

py::array_t<float> depth(py::handle disparity, const Rectification& rectification) {
  const ArrayView<float> map = map_of(disparity, rectification);
  const DepthGeometry geometry = geometry_of(rectification);
  require(check_geometry(geometry));
  py::array_t<float> depths = new_image<float>(map.view.height, map.view.width);
  const ImageView<float> out = view_of(depths);
  const py::gil_scoped_release released;
  const double product = geometry.focal_length * geometry.baseline;
  for (int y = 0; y < out.height; ++y) {
    const float* from = map.view.row(y);
    std::transform(from, from + out.width, out.row(y), [&](float value) {
      return depth_of(value, product, geometry.principal_offset);
    });
  }
  return depths;
}

/// Without a principal point, which depths do not need, all points would be displaced.
void require_center(const Rectification& rectification, ImageView<const float> map) {
  if (rectification.left_center_x != 0 || rectification.center_y != 0) return;
  const auto middle = [](int length) { return py::str(py::float_((length - 1) / 2.0)); };
  throw py::value_error(
      "points need center_x and center_y of the Rectification: give those of the views, or the "
      "middle if they are not known: center_x=" +
      std::string(middle(map.width)) + ", center_y=" + std::string(middle(map.height)));
}

/// A map in the 16-bit values of the library.
struct FixedMap {
  std::vector<std::uint16_t> values;
  double scale = kDisparityOne;
  double offset = 0;
};

/// Rounds a map to 1/256 px, or to the next power of two of that with which all values fit.
FixedMap fixed_map(ImageView<const float> map) {
  float least = 0, most = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const float value = map.row(y)[x];
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  FixedMap fixed;
  fixed.offset = std::floor(least);
  while ((most - fixed.offset) * fixed.scale > 65535) fixed.scale /= 2;
  fixed.values.reserve(static_cast<std::size_t>(map.width) * map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double value = (static_cast<double>(map.row(y)[x]) - fixed.offset) * fixed.scale;
      fixed.values.push_back(std::isfinite(value) ? static_cast<std::uint16_t>(
                                                        std::clamp(std::round(value), 1.0, 65535.0))
                                                  : 0);
    }
  }
  return fixed;
}

struct Cloud {
  std::vector<CloudPoint> points;
};

Cloud cloud(py::handle disparity, const Rectification& rectification, py::handle color,
            py::handle confidence, double near, double far, int min_confidence, int step) {
  const ArrayView<float> map = map_of(disparity, rectification);
  require_center(rectification, map.view);
  ArrayView<std::uint8_t> colors, confidences;
  CloudInput input;
  if (!color.is_none()) {
    colors = color_view("color", color);
    input.color = colors.view;
    input.color_channels = colors.array.ndim() == 3 ? static_cast<int>(colors.array.shape(2)) : 1;
  }
  if (!confidence.is_none()) {
    confidences = gray_view("confidence", confidence);
    input.confidence = confidences.view;
  }
  Cloud result;
  const auto make = [&]() -> Status {
    const py::gil_scoped_release released;
    const FixedMap fixed = fixed_map(map.view);
    input.disparity = {fixed.values.data(), map.view.width, map.view.height,
                       static_cast<std::ptrdiff_t>(sizeof(std::uint16_t)) * map.view.width};
    DepthGeometry geometry = geometry_of(rectification);
    geometry.scale = fixed.scale;
    geometry.offset = fixed.offset;
    return make_cloud(input, geometry, {near, far, min_confidence, step}, result.points);
  };
  require(make());
  return result;
}

/// A member of all points as an array that keeps the cloud.
template <typename T>
py::array member_of(const py::object& owner, T CloudPoint::*member, int count) {
  auto& points = owner.cast<Cloud&>().points;
  const T* first = points.empty() ? nullptr : &(points.front().*member);
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(points.size())};
  std::vector<py::ssize_t> strides = {sizeof(CloudPoint)};
  if (count > 1) {
    shape.push_back(count);
    strides.push_back(sizeof(T));
  }
  return py::array(py::dtype::of<T>(), shape, strides, first, owner);
}

void write_points(const Cloud& cloud, const std::filesystem::path& path) {
  const std::string suffix = path.extension().string();
  if (suffix != ".ply" && suffix != ".pcd") {
    throw py::value_error("path ends with '" + suffix + "': the formats are .ply and .pcd");
  }
  const auto written = [&] {
    const py::gil_scoped_release released;
    return write_cloud(cloud.points, suffix == ".ply" ? CloudFormat::kPly : CloudFormat::kPcd,
                       path.string());
  };
  require(written());
}

constexpr const char* kCloudText = R"(The points of a map: a Cloud.

disparity: float32, (height, width) [px], NaN or inf = unknown; rounded to 1/256 px, and coarser if it has 256 px or more.
color: the left view, uint8, (height, width) or (height, width, 3) as red, green, blue; image[:, :, ::-1] of OpenCV's.
confidence: uint8, (height, width). near, far: the depths of the points [m]. min_confidence: 0 .. 255. step: every n-th
pixel of every n-th row. TypeError, ValueError: an array has another type, shape or size, or a value is out of range.)";

}  // namespace

void bind_depth(py::module_& module) {
  module.def(
      "depth", &depth, py::arg("disparity"), py::arg("rectification"),
      R"(Depths [m] of a map: float32, (height, width), NaN = unknown, inf = at or beyond infinity.

disparity: float32, (height, width) [px], NaN or inf = unknown. Depth = focal length * baseline / (disparity +
principal_offset) of the Rectification. TypeError: no array of floats. ValueError: another shape or size, or no such
cameras.)");
  py::class_<Cloud>(module, "Cloud",
                    "Points in the axes of the rectified left camera: x to the right, y downwards, "
                    "z forward. The arrays "
                    "are those of the cloud, not copies.")
      .def("__len__", [](const Cloud& cloud) { return cloud.points.size(); })
      .def_property_readonly(
          "points", [](const py::object& cloud) { return member_of(cloud, &CloudPoint::x, 3); },
          "float32, (n, 3): x, y, z [m].")
      .def_property_readonly(
          "colors", [](const py::object& cloud) { return member_of(cloud, &CloudPoint::red, 3); },
          "uint8, (n, 3): red, green, blue; white without a view.")
      .def_property_readonly(
          "confidence",
          [](const py::object& cloud) { return member_of(cloud, &CloudPoint::confidence, 1); },
          "uint8, (n,): 255 without a confidence map.")
      .def("write", &write_points, py::arg("path"),
           "Writes a .ply or .pcd file. ValueError: another suffix. OSError: the file cannot be "
           "written.");
  module.def("cloud", &cloud, py::arg("disparity"), py::arg("rectification"),
             py::arg("color") = py::none(), py::arg("confidence") = py::none(), py::kw_only(),
             py::arg("near") = 0, py::arg("far") = std::numeric_limits<double>::infinity(),
             py::arg("min_confidence") = 0, py::arg("step") = 1, kCloudText);
}

}  // namespace mtstereo::python
