// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mtstereo/geometry/depth.hpp"
#include "mtstereo/geometry/free_space.hpp"
#include "mtstereo/result.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {

/// Gives the pixels of frames without a disparity the bounds of free space. Its memory grows with
/// the largest frame. One thread at a time.
class FrameBounds {
 public:
  /// Replaces the disparities of a frame that is mapped for writing, at any address. Fails with
  /// kOutOfMemory, or throws std::bad_alloc; then the frame is unchanged.
  Status write(MappedFrame& frame);

 private:
  FreeSpace space_;
  std::vector<std::uint16_t> copy_;  ///< of frames that the library cannot read as they are
};

/// Replaces the disparities of a frame that is mapped for writing, at any address, by depths.
void write_depths(const DepthConverter& converter, MappedFrame& frame);

}  // namespace mtstereo::plugin
