// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

namespace mtstereo {

/// Differences of gray values of pixels and their partners, counted for their median: what few
/// wrong partners hardly change.
class GrayDifferences {
 public:
  static constexpr int kMost = 255;

  void add(int difference) {
    ++counts_[difference + kMost];
    ++pixels_;
  }

  std::int64_t pixels() const { return pixels_; }

  /// Of two differences in the middle the larger one. There must be a difference.
  int median() const {
    int bin = 0;
    for (std::int64_t before = counts_[0]; before <= pixels_ / 2; before += counts_[bin]) ++bin;
    return bin - kMost;
  }

 private:
  std::array<std::uint32_t, 2 * kMost + 1> counts_ = {};
  std::int64_t pixels_ = 0;
};

}  // namespace mtstereo
