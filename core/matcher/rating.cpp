// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/rating.hpp"

namespace mtstereo {

void Rating::resize(int width, int height, int threads, ReusedMemory& reused) {
  reused.start_group();
  clues.resize(width, height, &reused);
  scratch.resize(threads);
  for (Scratch& worker : scratch) {
    worker.clues.resize(width);
    worker.reliability.resize(width);
  }
}

void rate(const Bands& bands, const RatedViews& views, const Image<std::int32_t>& map,
          const TableParts& parts, Inferred inferred, Rating& rating,
          Image<std::uint8_t>& confidence) {
  const ReliabilityTable table = table_for(parts, part_shares(views));
  bands.rows([&](int y0, int y1, int worker) {
    gather_clues(views, map, confidence, y0, y1, rating.scratch[worker].clues, rating.clues);
  });
  bands.rows([&](int y0, int y1, int worker) {
    rate_reliability(views, map, rating.clues, table, inferred, y0, y1,
                     rating.scratch[worker].reliability, confidence);
  });
}

}  // namespace mtstereo
