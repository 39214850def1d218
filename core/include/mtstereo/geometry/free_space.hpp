// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mtstereo/export.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/result.hpp"

// How far one can see through the pixels of a disparity map that have no disparity.

namespace mtstereo {

/// Bounds the disparity of pixels that have none by those around them. It owns the memory for one
/// map, which grows with the largest one and is reused. One thread at a time.
class MTSTEREO_API FreeSpace {
 public:
  /// Allocates nothing.
  FreeSpace() noexcept;
  ~FreeSpace();
  /// Moves the memory.
  FreeSpace(FreeSpace&&) noexcept;
  /// Moves the memory.
  FreeSpace& operator=(FreeSpace&&) noexcept;

  /// Copies the disparities of a map, and gives each pixel without one (0) its bound: the largest
  /// of the nearest disparities to the left, to the right, above and below, each up to the border
  /// of the image. As far as the surroundings tell, the ray of the pixel is free up to the depth of
  /// the bound. That is an estimate: what stands free in a gap is not in the map. A pixel has no
  /// bound (0) if there is no disparity to its left or none to its right: what is beyond the last
  /// disparity of a row is often nearer.
  ///
  /// The values have the scale and the offset of the map; DepthConverter turns both
  /// maps into depths. `disparity` and `bounds` may be the same image. The time is proportional to
  /// the number of pixels. Allocates only for a map with more pixels than all before. Fails with
  /// kInvalidImage, kSizeMismatch or kOutOfMemory; then `bounds` is unchanged.
  Status bound_unknown(ImageView<const std::uint16_t> disparity,
                       ImageView<std::uint16_t> bounds) noexcept;

 private:
  std::vector<std::uint16_t> memory_;
};

}  // namespace mtstereo
