// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <string_view>

#include "base/bands.hpp"
#include "matcher/frame_memory.hpp"
#include "matcher/settings.hpp"

namespace mtstereo {

/// What every step reads besides its groups of the memory.
struct StepContext {
  const Settings& settings;
  const Bands& bands;        ///< of the matched views
  const Bands& input_bands;  ///< of the input views
};

/// One step of the method: an entry of the list that a matcher runs for each frame.
struct Step {
  std::string_view name;
  /// Whether the step runs with these settings.
  bool (*runs)(const Settings& settings);
  /// Runs the step on the groups of the memory that its entry names.
  void (*run)(const StepContext& context, FrameMemory& memory);
};

/// All steps in the order in which they run. The order is fixed; settings can only disable steps.
/// Everything that depends on the order of the method reads this list: the matcher, the benchmark,
/// the pictures of docs/ and the tests.
std::span<const Step> steps();

}  // namespace mtstereo
