// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <optional>

#include "shared/times.hpp"

namespace mtstereo::plugin {

/// The running time at a position of a segment. It is negative for a frame that begins before its
/// segment, as the first one after a seek may. std::nullopt without a position or a segment of
/// times.
std::optional<Nanoseconds> to_running_time(const GstSegment& segment, GstClockTime position);

}  // namespace mtstereo::plugin
