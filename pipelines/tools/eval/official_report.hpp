// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/eval/results.hpp"

namespace mtstereo::eval {

/// The official figures of one method over the pairs of one benchmark.
struct OfficialSummary {
  Benchmark benchmark = Benchmark::kKitti2015;
  std::string method;
  int all_pairs = 0, noc_pairs = 0;         ///< the pairs that have figures of the region
  std::optional<OfficialFigures> all, noc;  ///< none without such a pair
};

/// One for each benchmark and method with a result on the images as they are.
std::vector<OfficialSummary> summarize_official(const Report& report);

/// What the pairs of a benchmark lack, one sentence each.
std::vector<std::string> official_notes(const Report& report, Benchmark benchmark);

/// Prints one table for each benchmark, of the images as they are.
void print_official(std::ostream& out, const Report& report);

/// The figures of one map.
nlohmann::json official_json(const OfficialCounts& counts);

/// The means and notes of each benchmark.
nlohmann::json official_means_json(const Report& report);

}  // namespace mtstereo::eval
