// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "frames.hpp"

namespace mtstereo::bench {

/// Registers every stage of one frame: all those of the defaults, then what only other modes and
/// the paper's preset run.
void register_stages(const FramePointer& frame);

}  // namespace mtstereo::bench
