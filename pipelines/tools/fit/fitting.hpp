// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "tools/fit/samples.hpp"

namespace mtstereo::fit {

/// The logarithm of the odds that a disparity is right, as a sum of one entry per clue and part,
/// times the part's share.
using LogOdds = std::array<std::array<std::array<double, kClueBins>, kClues>, kTableParts>;

/// Fits the entries by boosting: each entry in turn takes a Newton step of the logistic loss. Only
/// samples with ground truth count.
LogOdds fit(const std::vector<const PairSamples*>& pairs);

/// The sum for a sample of views with these shares.
double log_odds(const LogOdds& odds, const PartShares& shares, const Sample& sample);

/// The table of the library: the confidence is kEvenOdds + kPerLogOdds times the logarithm of the
/// odds.
inline constexpr double kEvenOdds = 64;
inline constexpr double kPerLogOdds = 24;
TableParts library_table(const LogOdds& odds);

/// The mean D-all [%] and the mean density [%] of pairs without the samples of lower confidence.
struct Outcome {
  double d_all = 0;
  double density = 0;
};
Outcome outcome(const std::vector<const PairSamples*>& pairs,
                const std::vector<const TableParts*>& tables, int least);

}  // namespace mtstereo::fit
