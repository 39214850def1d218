// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/free_space.hpp"

#include <algorithm>
#include <cstddef>

#include "base/guard.hpp"
#include "geometry/check_image.hpp"

namespace mtstereo {
namespace {

/// The rows that a row of bounds is computed from. None is part of the output.
struct Neighbors {
  std::uint16_t* above;        ///< the nearest disparity above each pixel, or its own
  std::uint16_t* right;        ///< the nearest one to the right
  const std::uint16_t* below;  ///< the nearest one below
};

Status check_maps(const ImageView<const std::uint16_t>& disparity,
                  const ImageView<std::uint16_t>& bounds) {
  if (Status status = check_image("disparity map", disparity); !status) return status;
  const ImageView<const std::uint16_t> out = {bounds.data, bounds.width, bounds.height,
                                              bounds.stride};
  if (Status status = check_image("map of bounds", out); !status) return status;
  return check_sizes("disparity map", disparity.width, disparity.height, "map of bounds",
                     bounds.width, bounds.height);
}

/// nearest[x] = the disparity of the row at x, or without one `beyond`[x].
void continue_columns(const std::uint16_t* row, const std::uint16_t* beyond, int width,
                      std::uint16_t* nearest) {
  for (int x = 0; x < width; ++x) nearest[x] = row[x] != 0 ? row[x] : beyond[x];
}

/// From the last row upwards: below(x, y) is the disparity at (x, y), or the nearest one below.
void sweep_upwards(const ImageView<const std::uint16_t>& map, std::uint16_t* below) {
  const auto width = static_cast<std::size_t>(map.width);
  std::uint16_t* row = below + width * (static_cast<std::size_t>(map.height) - 1);
  std::copy_n(map.row(map.height - 1), width, row);
  for (int y = map.height - 2; y >= 0; --y, row -= width) {
    continue_columns(map.row(y), row, map.width, row - width);
  }
}

/// The bounds of one row, which may be the row of disparities itself.
void bound_row(const std::uint16_t* row, const Neighbors& near, int width, std::uint16_t* bounds) {
  continue_columns(row, near.above, width, near.above);
  std::uint16_t right = 0;
  for (int x = width - 1; x >= 0; --x) near.right[x] = right = row[x] != 0 ? row[x] : right;
  std::uint16_t left = 0;
  for (int x = 0; x < width; ++x) {
    // Where there is a disparity, all four are equal to it.
    left = row[x] != 0 ? row[x] : left;
    const bool between = left != 0 && near.right[x] != 0;
    const std::uint16_t in_row = std::max(left, near.right[x]);
    bounds[x] = between ? std::max({in_row, near.above[x], near.below[x]}) : std::uint16_t{0};
  }
}

}  // namespace

FreeSpace::FreeSpace() noexcept = default;
FreeSpace::~FreeSpace() = default;
FreeSpace::FreeSpace(FreeSpace&&) noexcept = default;
FreeSpace& FreeSpace::operator=(FreeSpace&&) noexcept = default;

Status FreeSpace::bound_unknown(ImageView<const std::uint16_t> disparity,
                                ImageView<std::uint16_t> bounds) noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_maps(disparity, bounds); !status) return status;
    const auto width = static_cast<std::size_t>(disparity.width);
    const auto height = static_cast<std::size_t>(disparity.height);
    if (memory_.size() < width * (height + 2)) memory_.resize(width * (height + 2));
    std::uint16_t* above = memory_.data();
    std::uint16_t* right = above + width;
    std::uint16_t* below = right + width;
    std::fill_n(above, width, std::uint16_t{0});
    sweep_upwards(disparity, below);
    for (int y = 0; y < disparity.height; ++y, below += width) {
      bound_row(disparity.row(y), {above, right, below}, disparity.width, bounds.row(y));
    }
    return {};
  });
}

}  // namespace mtstereo
