// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/resolution_choice.hpp"

namespace mtstereo {

void ResolutionChoice::take(std::optional<double> share) {
  if (!share) return;
  const bool contrary = half_ ? *share >= kSharp : *share <= kSoft;
  contrary_ = contrary ? contrary_ + 1 : 0;
  if (contrary_ < kFrames) return;
  half_ = !half_;
  contrary_ = 0;
}

}  // namespace mtstereo
