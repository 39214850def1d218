// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "frames.hpp"
#include "summary.hpp"

namespace mtstereo::bench {

/// Registers the matching of whole frames, by the library and by OpenCV's matchers, with 1 and 2
/// threads, and announces them to the summary.
void register_whole_frames(const std::vector<FramePointer>& all, Summary& summary);

}  // namespace mtstereo::bench
