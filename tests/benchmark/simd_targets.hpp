// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "eval/text_table.hpp"
#include "frames.hpp"
#include "summary.hpp"

namespace mtstereo::bench {

/// An instruction set that the library's kernels are compiled for and that this processor has.
struct SimdTarget {
  std::int64_t id;      ///< of Highway
  std::string name;     ///< as in "AVX2"
  std::string highway;  ///< what Highway calls it
};

/// All of them, the best one first: those of Highway, where what an x86-64 processor without any
/// extension runs is named "SSE2", whatever Highway compiles for that.
std::vector<SimdTarget> simd_targets();

/// The library's kernels are those of one target until this is gone.
class ForcedTarget {
 public:
  explicit ForcedTarget(const SimdTarget& target);
  ~ForcedTarget();
  ForcedTarget(const ForcedTarget&) = delete;
  ForcedTarget& operator=(const ForcedTarget&) = delete;
};

/// Registers the frame, matched by the defaults with one thread, on every target. Each has to give
/// what the best one gives.
void register_targets(const FramePointer& frame);

/// The targets that were timed on the frame, with the time as a multiple of AVX2's and of the best
/// one's, "-" where that was not timed. Empty where none was.
std::vector<eval::TableRow> target_table(const Frame& frame, const Summary& summary);

}  // namespace mtstereo::bench
