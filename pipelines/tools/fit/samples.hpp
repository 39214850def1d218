// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "stages/refine/reliability_table.hpp"
#include "tools/eval/datasets.hpp"

namespace mtstereo::fit {

/// The bins of the clues about one pixel, and whether its disparity is right.
struct Sample {
  std::array<std::uint8_t, kClues> bins;
  bool known = false;  ///< there is ground truth
  bool wrong = false;  ///< an outlier by KITTI's D-all, in px of the original pair
};

/// The samples of one pair of views, as it is or degraded.
struct PairSamples {
  std::string family;  ///< of data sets that are left out together
  std::string kind;    ///< the degradation
  PartShares shares;   ///< of the parts of the tables
  std::vector<Sample> samples;
};

/// A pair with ground truth.
struct TrainingPair {
  std::string name;
  std::string family;
  int max_disparity = 0;
  eval::LoadedPair views;
};

/// The pairs in a folder, and those that the project renders itself.
std::vector<TrainingPair> pairs_in(const std::string& folder);
std::vector<TrainingPair> rendered_pairs();

/// Matches the views, degraded by `kind` or eval::kCleanKind, and takes the rated ones of `count`
/// random pixels. `guide` rates the map that is a clue for the others. The choice depends on the
/// arguments only.
PairSamples take_samples(const TrainingPair& pair, const std::string& kind, RatedMap rated,
                         const TableParts& guide, int count);

/// The confidence that the library gives a sample.
int confidence(const ReliabilityTable& table, const Sample& sample);

}  // namespace mtstereo::fit
