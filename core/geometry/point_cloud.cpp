// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/point_cloud.hpp"

#include <cmath>

#include "base/guard.hpp"
#include "geometry/check_image.hpp"

namespace mtstereo {
namespace {

Status check_options(const CloudOptions& options) {
  if (options.step < 1) {
    return Error{ErrorCode::kInvalidParameter,
                 "step = " + std::to_string(options.step) + " is invalid: it must be at least 1"};
  }
  if (options.min_confidence < 0 || options.min_confidence > 255) {
    return Error{ErrorCode::kInvalidParameter,
                 "min-confidence = " + std::to_string(options.min_confidence) +
                     " is invalid: the range is 0 to 255"};
  }
  return check_range(options.near, options.far);
}

Status check_input(const CloudInput& input) {
  const auto& map = input.disparity;
  if (Status status = check_image("disparity map", map); !status) return status;
  if (input.color.data != nullptr) {
    if (input.color_channels != 1 && input.color_channels != 3) {
      return Error{ErrorCode::kInvalidParameter, "a left view with " +
                                                     std::to_string(input.color_channels) +
                                                     " channels is invalid: it must have 1 or 3"};
    }
    const auto& color = input.color;
    if (Status status = check_image("left view", color, input.color_channels); !status) {
      return status;
    }
    if (Status status = check_sizes("disparity map", map.width, map.height, "left view",
                                    color.width, color.height);
        !status) {
      return status;
    }
  }
  if (input.confidence.data == nullptr) return {};
  if (Status status = check_image("confidence map", input.confidence); !status) return status;
  return check_sizes("disparity map", map.width, map.height, "confidence map",
                     input.confidence.width, input.confidence.height);
}

/// One row of the images; no data where there is no image.
struct CloudRow {
  const std::uint16_t* disparity = nullptr;
  const std::uint8_t* color = nullptr;
  int channels = 1;
  const std::uint8_t* confidence = nullptr;
};

void add_color(const CloudRow& row, int x, CloudPoint& point) {
  if (row.color == nullptr) {
    point.red = point.green = point.blue = 255;
    return;
  }
  const std::uint8_t* color = row.color + static_cast<std::ptrdiff_t>(x) * row.channels;
  point.red = color[0];
  point.green = row.channels == 3 ? color[1] : color[0];
  point.blue = row.channels == 3 ? color[2] : color[0];
}

void add_points(const CloudRow& row, int width, double v, const DepthGeometry& geometry,
                const CloudOptions& options, std::vector<CloudPoint>& points) {
  for (int x = 0; x < width; x += options.step) {
    const std::uint8_t confidence = row.confidence != nullptr ? row.confidence[x] : 255;
    if (row.disparity[x] == 0 || confidence < options.min_confidence) continue;
    const double depth = geometry.depth_of(row.disparity[x]);
    if (!std::isfinite(depth) || depth < options.near || depth > options.far) continue;
    const double scale = depth / geometry.focal_length;
    CloudPoint& point = points.emplace_back();
    point.x = static_cast<float>((x - geometry.center_x) * scale);
    point.y = static_cast<float>(v * scale);
    point.z = static_cast<float>(depth);
    point.confidence = confidence;
    add_color(row, x, point);
  }
}

}  // namespace

Status make_cloud(const CloudInput& input, const DepthGeometry& geometry,
                  const CloudOptions& options, std::vector<CloudPoint>& points) noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_input(input); !status) return status;
    if (Status status = check_geometry(geometry); !status) return status;
    if (Status status = check_options(options); !status) return status;
    points.clear();
    for (int y = 0; y < input.disparity.height; y += options.step) {
      const CloudRow row = {input.disparity.row(y),
                            input.color.data != nullptr ? input.color.row(y) : nullptr,
                            input.color_channels,
                            input.confidence.data != nullptr ? input.confidence.row(y) : nullptr};
      add_points(row, input.disparity.width, y - geometry.center_y, geometry, options, points);
    }
    return {};
  });
}

}  // namespace mtstereo
