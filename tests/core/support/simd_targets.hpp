// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace mtstereo::test {

/// Calls body() once for every compiled SIMD target that this processor supports, with dynamic
/// dispatch restricted to that target.
template <typename Body>
void for_each_simd_target(Body&& body) {
  struct Restore {
    ~Restore() {
      hwy::SetSupportedTargetsForTest(0);
      hwy::GetChosenTarget().DeInit();
    }
  } restore;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    body();
  }
}

}  // namespace mtstereo::test
