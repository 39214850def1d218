// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <type_traits>

#include "matcher/frame_memory.hpp"
#include "matcher/steps.hpp"

// How an entry of the list of steps calls its function with groups of the memory.

namespace mtstereo {

/// The group of the memory that has this type.
template <typename Group>
Group& group(FrameMemory& memory) {
  using Plain = std::remove_const_t<Group>;
  if constexpr (std::is_same_v<Plain, Views>) {
    return memory.views;
  } else if constexpr (std::is_same_v<Plain, Nodes>) {
    return memory.nodes;
  } else if constexpr (std::is_same_v<Plain, Costs>) {
    return memory.costs;
  } else if constexpr (std::is_same_v<Plain, Pyramid>) {
    return memory.pyramid;
  } else if constexpr (std::is_same_v<Plain, Maps>) {
    return memory.maps;
  } else if constexpr (std::is_same_v<Plain, EnlargedMaps>) {
    return memory.enlarged;
  } else if constexpr (std::is_same_v<Plain, Completion>) {
    return memory.completion;
  } else {
    static_assert(std::is_same_v<Plain, OutputMaps>, "FrameMemory has no such group");
    return memory.output;
  }
}

/// A step's function, called with the groups that it reads (const) and writes.
template <auto kFunction, typename... Groups>
void on(const StepContext& context, FrameMemory& memory) {
  kFunction(context, group<Groups>(memory)...);
}

}  // namespace mtstereo
