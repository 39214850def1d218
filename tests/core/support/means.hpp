// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "stages/prepare/time_filter.hpp"
#include "support/plane.hpp"

namespace mtstereo::test {

/// The means of a view [1 / kMeanOne gray values].
inline Plane<int> copy_of_means(const Means& means) {
  Plane<int> copy(means.filtered.width(), means.filtered.height());
  for (int y = 0; y < copy.height; ++y) {
    for (int x = 0; x < copy.width; ++x) {
      const int both = means.rests.row(y / 2)[x];
      const int rest = y % 2 == 0 ? both % kMeanOne : both / kMeanOne;
      copy(x, y) = kMeanOne * means.filtered.row(y)[x] + rest - kMeanOne / 2;
    }
  }
  return copy;
}

}  // namespace mtstereo::test
