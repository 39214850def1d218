// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The properties near and far.
struct DepthRange {
  double near = 0;  ///< [m]
  double far = 0;   ///< [m]; 0: no limit
  bool valid() const { return far == 0 || near < far; }
  /// `far`, or infinity without a limit [m].
  double end() const;
  bool operator==(const DepthRange&) const = default;
};

/// The largest value of both properties [m].
inline constexpr double kLargestDepthLimit = 1e6;

/// For the start of an element: posts an error and returns false if the range is not valid.
bool check_range_at_start(gpointer element, const DepthRange& range);

/// For each frame: the range to use. `set` is what the properties have, guarded by the object lock;
/// `last` the last valid range, of the streaming thread. A range that is not valid is refused with
/// a warning, and the properties return to the last one.
DepthRange settle_range(gpointer element, DepthRange& set, DepthRange& last);

}  // namespace mtstereo::plugin
