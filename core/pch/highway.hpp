// SPDX-License-Identifier: LGPL-2.1-or-later
// Precompiled for the kernels: Highway's functions for all targets. For the kernels base/simd.hpp
// goes through the targets once more, so the macros of Highway have to be as before the first time.
#define HWY_TARGET_INCLUDE <hwy/highway.h>
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on
#undef HIGHWAY_HWY_FOREACH_TARGET_H_
#undef HWY_HIGHWAY_INCLUDED
#undef HWY_SET_MACROS_PER_TARGET
#undef HWY_TARGET_INCLUDE
#undef HWY_TARGET_TOGGLE
#define MTSTEREO_PRECOMPILED_HIGHWAY

#include <algorithm>
#include <array>
#include <memory>
#include <vector>
