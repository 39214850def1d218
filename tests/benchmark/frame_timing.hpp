// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <benchmark/benchmark.h>

#include "frames.hpp"
#include "outcome.hpp"
#include "summary.hpp"

namespace mtstereo::bench {

/// A set of defaults that is timed as a method.
struct Variant {
  const char* name;
  const char* preset;
  const char* mode;
};

/// The method that all others are compared with.
inline constexpr Variant kDefaultVariant = {kDefaultMethod, "default", "semi-dense"};

/// Whether the library has a preset with this name.
bool has_preset(const char* preset);

Parameters parameters_of(const Variant& variant, const Frame& frame, int threads);

/// Matches the frame until the state has enough iterations; the first frame, which allocates the
/// buffers, is not timed. Throws std::runtime_error if no disparity is found.
Outcome time_matcher(benchmark::State& state, const Parameters& parameters, const Frame& frame);

/// The same with this number of threads, 1 or 2. Requires that the other number gives the same
/// outcome, which `other` caches.
void time_library(benchmark::State& state, const Variant& variant, const Frame& frame, int threads,
                  Outcome& other);

/// Sets the counters s/MP, frames/s and density.
void count_frame(benchmark::State& state, const Frame& frame, double density);

}  // namespace mtstereo::bench
