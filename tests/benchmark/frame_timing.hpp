// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <benchmark/benchmark.h>

#include "frames.hpp"
#include "outcome.hpp"
#include "summary.hpp"

namespace mtstereo::bench {

/// A set of defaults that is timed.
struct Variant {
  const char* name;
  const char* preset;
  const char* mode;
};

/// What everything else is compared with.
inline constexpr Variant kDefaultVariant = {kDefaultMethod, "default", "semi-dense"};

/// Whether the library has a preset with this name.
bool has_preset(const char* preset);

Parameters parameters_of(const Variant& variant, const Frame& frame, int threads);

/// Matches the frame until the state has enough of it; what sizes the buffers does not count.
/// Throws std::runtime_error where nothing is found.
Outcome time_matcher(benchmark::State& state, const Parameters& parameters, const Frame& frame);

/// The same with as many threads, and requires the outcome of the other number of threads, 1 or 2.
/// `other` is that outcome once it was needed.
void time_library(benchmark::State& state, const Variant& variant, const Frame& frame, int threads,
                  Outcome& other);

/// Tells s/MP, frames/s and density of what was timed.
void count_frame(benchmark::State& state, const Frame& frame, double density);

}  // namespace mtstereo::bench
