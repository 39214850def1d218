// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/depth.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "base/guard.hpp"
#include "geometry/check_image.hpp"

namespace mtstereo {
namespace {

constexpr std::size_t kValues = 65536;
constexpr std::uint16_t kLargestDepth = 65535;

Error invalid_geometry(const char* name, double value, const char* rule) {
  return {ErrorCode::kInvalidCalibration, std::string("the ") + name + " of the geometry is " +
                                              std::to_string(value) + ", but it must be " + rule};
}

Status check_options(const DepthOptions& options) {
  if (!(options.unit > 0) || !std::isfinite(options.unit)) {
    return Error{ErrorCode::kInvalidParameter, "the unit of the depths is " +
                                                   std::to_string(options.unit) +
                                                   " m, but it must be positive and finite"};
  }
  return check_range(options.near, options.far);
}

/// The 16-bit depth of a value other than 0.
std::uint16_t depth16(double depth, const DepthOptions& options) {
  if (depth < options.near || depth > options.far) return 0;
  const double units = std::floor(depth / options.unit + 0.5);
  if (units > kLargestDepth) return options.clamp ? kLargestDepth : std::uint16_t{0};
  return units < 1 ? std::uint16_t{1} : static_cast<std::uint16_t>(units);
}

}  // namespace

double DepthGeometry::depth_of(std::uint16_t value) const noexcept {
  const double disparity = value / scale + offset + principal_offset;
  if (value == 0 || !(disparity > 0)) return std::numeric_limits<double>::infinity();
  return focal_length * baseline / disparity;
}

double DepthGeometry::depth_step(double depth, double step) const noexcept {
  return depth * depth * step / (focal_length * baseline);
}

Status check_geometry(const DepthGeometry& geometry) noexcept {
  return guarded([&]() -> Status {
    const std::pair<const char*, double> positive[] = {{"focal length", geometry.focal_length},
                                                       {"baseline", geometry.baseline},
                                                       {"disparity scale", geometry.scale}};
    for (const auto& [name, value] : positive) {
      if (!(value > 0) || !std::isfinite(value)) {
        return invalid_geometry(name, value, "positive and finite");
      }
    }
    const std::pair<const char*, double> finite[] = {
        {"principal offset", geometry.principal_offset},
        {"column of the principal point", geometry.center_x},
        {"row of the principal point", geometry.center_y},
        {"disparity offset", geometry.offset}};
    for (const auto& [name, value] : finite) {
      if (!std::isfinite(value)) return invalid_geometry(name, value, "finite");
    }
    return {};
  });
}

DepthConverter::DepthConverter(std::unique_ptr<std::uint16_t[]> table) noexcept
    : table_(std::move(table)) {}
DepthConverter::~DepthConverter() = default;
DepthConverter::DepthConverter(DepthConverter&&) noexcept = default;
DepthConverter& DepthConverter::operator=(DepthConverter&&) noexcept = default;

Result<DepthConverter> DepthConverter::create(const DepthGeometry& geometry,
                                              const DepthOptions& options) noexcept {
  return guarded([&]() -> Result<DepthConverter> {
    if (const Status status = check_geometry(geometry); !status) return status.error();
    if (const Status status = check_options(options); !status) return status.error();
    auto table = std::make_unique<std::uint16_t[]>(kValues);  // zeros: no depth
    for (std::size_t value = 1; value < kValues; ++value) {
      table[value] = depth16(geometry.depth_of(static_cast<std::uint16_t>(value)), options);
    }
    return DepthConverter(std::move(table));
  });
}

std::uint16_t DepthConverter::depth16_of(std::uint16_t value) const noexcept {
  return table_[value];
}

Status DepthConverter::convert(ImageView<const std::uint16_t> disparity,
                               ImageView<std::uint16_t> depth) const noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_image("disparity map", disparity); !status) return status;
    if (Status status = check_image(
            "depth map",
            ImageView<const std::uint16_t>{depth.data, depth.width, depth.height, depth.stride});
        !status) {
      return status;
    }
    if (Status status = check_sizes("disparity map", disparity.width, disparity.height, "depth map",
                                    depth.width, depth.height);
        !status) {
      return status;
    }
    const std::uint16_t* table = table_.get();
    for (int y = 0; y < disparity.height; ++y) {
      const std::uint16_t* from = disparity.row(y);
      std::uint16_t* to = depth.row(y);
      for (int x = 0; x < disparity.width; ++x) to[x] = table[from[x]];
    }
    return {};
  });
}

}  // namespace mtstereo
