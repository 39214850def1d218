// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mtstereo/image.hpp"
#include "shared/confidence_pool.hpp"

namespace mtstereo::plugin {

/// Attaches confidence maps to disparity maps.
class ConfidenceMaps {
 public:
  /// Attaches a copy of `confidence` to a disparity map whose pixels and times are set. With
  /// `removed` the map has fewer disparities than the confidence, which is cleared there. False if
  /// there is not enough memory.
  bool attach(GrayView confidence, GstBuffer* map, const GstVideoInfo& map_info, bool removed);
  void clear() { pool_.clear(); }

 private:
  BufferPointer copy(GrayView confidence, GstBuffer* map, const GstVideoInfo& map_info,
                     bool removed);

  ConfidencePool pool_;
};

}  // namespace mtstereo::plugin
