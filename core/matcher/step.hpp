// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string_view>

#include "base/bands.hpp"
#include "matcher/settings.hpp"

namespace mtstereo {

struct FrameMemory;

/// What every step reads besides its groups of the memory.
struct StepContext {
  const Settings& settings;
  const Bands& bands;        ///< of the matched views
  const Bands& input_bands;  ///< of the input views
};

/// One step of the method: a row of a list in steps.cpp.
struct Step {
  std::string_view name;
  /// Whether the step runs with these settings.
  bool (*runs)(const Settings& settings);
  /// Runs the step on the groups of the memory that its function takes.
  void (*run)(const StepContext& context, FrameMemory& memory);
};

}  // namespace mtstereo
