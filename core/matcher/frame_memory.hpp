// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <tuple>
#include <type_traits>

#include "matcher/map_steps.hpp"
#include "matcher/node_steps.hpp"
#include "matcher/path_steps.hpp"
#include "matcher/result_steps.hpp"
#include "matcher/time_steps.hpp"
#include "matcher/view_steps.hpp"

namespace mtstereo {

/// The memory of one matcher, in groups, each of which is declared beside the steps that write it.
/// A group holds the results of its steps, which later steps read, and the scratch memory of each
/// thread. Its resize() is the only place that allocates; call it after every change of settings or
/// size. Buffers only grow, so resize() is cheap if nothing larger is needed. Buffers that no two
/// steps need at the same time are in the same memory.
struct FrameMemory {
  Views views;
  Nodes nodes;
  Costs costs;
  Pyramid pyramid;
  Maps maps;
  ResultMaps result;
  ResultBuffers buffers;
  PastViews past;
  LastPair last;

  /// References to all groups.
  auto all() { return std::tie(views, nodes, costs, pyramid, maps, result, buffers, past, last); }

  /// The group of this type.
  template <typename Group>
  Group& group() {
    return std::get<std::remove_const_t<Group>&>(all());
  }

  void resize(const Settings& settings, const FrameSize& size) {
    // The reused memory grows the first time only, so the second time all buffers in it are placed.
    for (int time = 0; time < 2; ++time) {
      std::apply([&](auto&... group) { (resize_group(settings, size, group), ...); }, all());
    }
  }

 private:
  template <typename Group>
  void resize_group(const Settings& settings, const FrameSize& size, Group& group) {
    if constexpr (requires { group.resize(settings, size, reused_); }) {
      group.resize(settings, size, reused_);
    } else {
      group.resize(settings, size);
    }
  }

  /// Of the largest of those groups of buffers whose contents only a few successive steps need.
  ReusedMemory reused_;
};

}  // namespace mtstereo
