// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frames.hpp"
#include "summary.hpp"
#include "tools/eval/text_table.hpp"

namespace mtstereo::bench {

/// An instruction set that the kernels are compiled for and that this processor supports.
struct SimdTarget {
  std::int64_t id;   ///< Highway's bit
  std::string name;  ///< Highway's name, as in "AVX2"
};

/// All of them, the fastest one first. The last one on x86 is EMU128, which emulates vectors for
/// processors without SSSE3.
std::vector<SimdTarget> simd_targets();

/// Restricts the library's kernels to one target for its lifetime.
class ForcedTarget {
 public:
  explicit ForcedTarget(const SimdTarget& target);
  ~ForcedTarget();
  ForcedTarget(const ForcedTarget&) = delete;
  ForcedTarget& operator=(const ForcedTarget&) = delete;
};

/// Registers the frame, matched with the default parameters and one thread, on every target. Each
/// target has to return what the fastest one returns.
void register_targets(const FramePointer& frame);

/// The targets that were timed on the frame, with their times as multiples of AVX2's and of the
/// fastest target's ("-" where that one was not timed). Empty if no target was timed.
std::vector<eval::TableRow> target_table(const Frame& frame, const Summary& summary);

}  // namespace mtstereo::bench
