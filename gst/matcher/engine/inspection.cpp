// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/inspection.hpp"

namespace mtstereo::plugin {

bool InspectionSchedule::due(int interval) {
  ++since_;
  return attempts_ > 0 || since_ >= interval;
}

void InspectionSchedule::inspected(bool trusted) {
  since_ = 0;
  if (trusted) {
    attempts_ = 0;
  } else if (trusted_) {
    attempts_ = kAttempts - 1;  // this inspection was the first
  } else if (attempts_ > 0) {
    --attempts_;
  }
  trusted_ = trusted;
}

std::uint32_t ProblemWarnings::due(std::uint32_t problems, int interval) {
  const std::int64_t enough = std::int64_t{kSettling} * interval;
  for (std::size_t i = 0; i < absent_.size(); ++i) {
    const std::uint32_t problem = std::uint32_t{1} << i;
    absent_[i] = (problems & problem) != 0 ? 0 : absent_[i] + 1;
    if (absent_[i] >= enough) reported_ &= ~problem;
  }
  const std::uint32_t news = problems & ~reported_;
  reported_ |= news;
  return news;
}

}  // namespace mtstereo::plugin
