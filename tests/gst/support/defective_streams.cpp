// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/defective_streams.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>

namespace mtstereo::test {
namespace {

/// True if a warning states that frames may belong to others, or have no partners.
bool is_about_times(const std::string& warning) {
  for (const char* words :
       {"cannot prove that they belong together", "drifted apart", "had no partner"}) {
    if (warning.find(words) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

std::vector<NumberedFrame> defective_sequence(int count, const Defects& defects, unsigned seed,
                                              GstClockTime interval) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<NumberedFrame> frames;
  for (int i = 0; i < count; ++i) {
    const bool lost = share(random) < defects.loss;
    const double jitter = (2 * share(random) - 1) * static_cast<double>(defects.jitter);
    const double time = static_cast<double>(static_cast<GstClockTime>(i) * interval);
    if (lost) continue;
    const double pts = GST_SECOND + time * (1 + defects.drift) + jitter;
    frames.push_back({i, static_cast<GstClockTime>(static_cast<Nanoseconds>(pts) + defects.skew)});
  }
  return frames;
}

int wrong_without_warning(const FeedResult& result, int allowed) {
  std::size_t end = result.maps.size();
  for (std::size_t i = 0; i < result.warnings.size(); ++i) {
    if (is_about_times(result.warnings[i])) end = std::min(end, result.maps_before_warning[i]);
  }
  return static_cast<int>(
      std::count_if(result.maps.begin(), result.maps.begin() + static_cast<std::ptrdiff_t>(end),
                    [&](const NumberedMap& map) {
                      return !map.difference || std::abs(*map.difference) > allowed;
                    }));
}

std::string summary(const FeedResult& result) {
  std::string text = std::to_string(result.count.maps) + " maps, " +
                     std::to_string(result.count.wrong) + " wrong, " +
                     std::to_string(result.count.unknown) + " unknown, " +
                     std::to_string(wrong_without_warning(result)) + " before a warning, dropped " +
                     std::to_string(result.stats.dropped_left) + " and " +
                     std::to_string(result.stats.dropped_right);
  for (std::size_t i = 0; i < result.warnings.size(); ++i) {
    text += "\n  after " + std::to_string(result.maps_before_warning[i]) +
            " maps: " + result.warnings[i].substr(0, 60);
  }
  return text + "\n";
}

}  // namespace mtstereo::test
