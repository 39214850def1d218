// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/pixels/census_cost.hpp"
#include "stages/pixels/disparity_selection.hpp"
#include "stages/pixels/row_pair.hpp"
#include "stages/pixels/search_range.hpp"
#include "stages/pixels/texture.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// Guided pixel matching by the census cost: runs search_range, texture, census_cost,
/// row_pair and disparity_selection, two rows at a time.

struct CensusMatchingOptions {
  SearchRangeOptions range;
  CensusCostOptions cost;
  SmoothnessOptions smoothness;
  SelectionOptions selection;
};

/// Scratch memory of one thread: a few rows of costs.
struct CensusMatchingScratch {
  struct Row {
    Buffer<std::uint16_t> low;
    Buffer<std::uint16_t> high;
    Buffer<std::uint8_t> costs;
    Candidates candidates;
  };
  std::array<Row, 2> rows;
  TextureScratch texture;
  CensusCostScratch cost;
  RowPairScratch pair;

  void resize(int width, const CensusMatchingOptions& options);
};

/// Replaces the nodes' disparities in the rows y0 .. y1 - 1 by the pixels' own and writes their
/// peak ratios. Pixels without texture around them lose theirs. The result does not depend on how
/// the image is divided into such bands.
void match_pixels_by_census(GrayView left_image, const CensusImage& left, const CensusImage& right,
                            const CensusMatchingOptions& options, int y0, int y1,
                            CensusMatchingScratch& scratch, Image<std::int32_t>& map,
                            Image<std::uint8_t>& ratio);

}  // namespace mtstereo
