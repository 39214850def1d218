// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/bands.hpp"
#include "base/buffer.hpp"
#include "stages/refine/clues.hpp"
#include "stages/refine/reliability.hpp"

/// The rating of a complete map, which guide-rating and reliability share.

namespace mtstereo {

/// The memory for the rating of one map.
struct Rating {
  ClueMaps clues;

  struct Scratch {
    ClueScratch clues;
    ReliabilityScratch reliability;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  /// The clues are a group of the reused memory.
  void resize(int width, int height, int threads, ReusedMemory& reused);
};

/// Replaces the confidence of a complete map by its reliability.
void rate(const Bands& bands, const RatedViews& views, const Image<std::int32_t>& map,
          const TableParts& parts, Inferred inferred, Rating& rating,
          Image<std::uint8_t>& confidence);

}  // namespace mtstereo
