// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/fit/fitting.hpp"

#include <algorithm>
#include <cmath>

#include "stages/refine/reliability.hpp"
#include "tools/eval/degradation.hpp"

namespace mtstereo::fit {
namespace {

constexpr int kRounds = 15;
constexpr double kRate = 0.6;        // share of a Newton step
constexpr double kCleanWeight = 11;  // as much as all degraded kinds together
constexpr double kLeastHess = 200;   // added to the second derivative, against bins of few samples

/// Sums over the samples of each bin.
struct BinSums {
  std::array<double, kClueBins> gradient{};
  std::array<double, kClueBins> curvature{};
};

struct Fitting {
  std::vector<const Sample*> samples;
  std::vector<PartShares> shares;
  std::vector<double> weight;
  std::vector<double> odds;  ///< the logarithm of each sample's odds
};

/// Whether a clue is the same for all samples, so that it says nothing.
bool is_constant(int clue, const Fitting& fitting) {
  return std::all_of(fitting.samples.begin(), fitting.samples.end(), [&](const Sample* sample) {
    return sample->bins[clue] == fitting.samples.front()->bins[clue];
  });
}

/// One Newton step of the entries of a clue in one part.
void improve(int part, int clue, Fitting& fitting, LogOdds& table) {
  BinSums sums;
  for (std::size_t i = 0; i < fitting.samples.size(); ++i) {
    const double share = fitting.shares[i][part];
    if (share == 0) continue;
    const double right = 1 / (1 + std::exp(-fitting.odds[i]));
    const int bin = fitting.samples[i]->bins[clue];
    const double weight = share * fitting.weight[i];
    sums.gradient[bin] += weight * ((fitting.samples[i]->wrong ? 0 : 1) - right);
    sums.curvature[bin] += weight * share * right * (1 - right);
  }
  std::array<double, kClueBins> step{};
  for (int bin = 0; bin < kClueBins; ++bin) {
    step[bin] = kRate * sums.gradient[bin] / (sums.curvature[bin] + kLeastHess);
    table[part][clue][bin] += step[bin];
  }
  for (std::size_t i = 0; i < fitting.samples.size(); ++i) {
    fitting.odds[i] += fitting.shares[i][part] * step[fitting.samples[i]->bins[clue]];
  }
}

}  // namespace

LogOdds fit(const std::vector<const PairSamples*>& pairs) {
  Fitting fitting;
  for (const PairSamples* pair : pairs) {
    for (const Sample& sample : pair->samples) {
      if (!sample.known) continue;
      fitting.samples.push_back(&sample);
      fitting.shares.push_back(pair->shares);
      fitting.weight.push_back(pair->kind == eval::kCleanKind ? kCleanWeight : 1);
    }
  }
  fitting.odds.assign(fitting.samples.size(), 0.0);
  LogOdds table{};
  std::vector<int> clues;
  for (int clue = 0; clue < kClues; ++clue) {
    if (!is_constant(clue, fitting)) clues.push_back(clue);
  }
  for (int round = 0; round < kRounds; ++round) {
    for (int part = 0; part < kTableParts; ++part) {
      for (const int clue : clues) {
        if (part == kAnyPart || clue < kPixelClues) improve(part, clue, fitting, table);
      }
    }
  }
  return table;
}

double log_odds(const LogOdds& odds, const PartShares& shares, const Sample& sample) {
  double sum = 0;
  for (int part = 0; part < kTableParts; ++part) {
    for (int clue = 0; clue < kClues; ++clue) {
      sum += shares[part] * odds[part][clue][sample.bins[clue]];
    }
  }
  return sum;
}

TableParts library_table(const LogOdds& odds) {
  TableParts parts{};
  for (int part = 0; part < kTableParts; ++part) {
    for (int clue = 0; clue < kClues; ++clue) {
      // Each pixel has one noise level.
      const double even = part == kAnyPart && clue == kNoiseClue ? kEvenOdds : 0;
      for (int bin = 0; bin < kClueBins; ++bin) {
        const double value = (even + kPerLogOdds * odds[part][clue][bin]) * kReliabilityOne;
        parts[part][clue][bin] = static_cast<std::int16_t>(std::lround(value));
      }
    }
  }
  return parts;
}

Outcome outcome(const std::vector<const PairSamples*>& pairs,
                const std::vector<const TableParts*>& tables, int least) {
  Outcome mean;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ReliabilityTable table = table_for(*tables[i], pairs[i]->shares);
    double kept = 0, known = 0, wrong = 0;
    for (const Sample& sample : pairs[i]->samples) {
      if (confidence(table, sample) < least) continue;
      ++kept;
      known += sample.known;
      wrong += sample.wrong;
    }
    if (known > 0) mean.d_all += 100 * wrong / known / static_cast<double>(pairs.size());
    mean.density += 100 * kept / static_cast<double>(pairs[i]->samples.size() * pairs.size());
  }
  return mean;
}

}  // namespace mtstereo::fit
