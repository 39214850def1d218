// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/confidence.hpp"

#include <cstring>

#include "shared/confidence_meta.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {
namespace {

/// The confidence of the last pair in a new buffer; NULL if there is no memory for it.
BufferPointer copy_confidence(ElementState& state) {
  if (!state.confidence_pool.fit(state.output)) return nullptr;
  BufferPointer map = state.confidence_pool.acquire();
  if (!map) return nullptr;
  MappedFrame frame(state.confidence_pool.info(), map.get(), GST_MAP_WRITE);
  if (!frame.mapped()) return nullptr;
  const GrayView confidence = state.matcher->confidence();
  for (int y = 0; y < state.output.height; ++y) {
    std::memcpy(plane_row(*frame.frame(), y), confidence.row(y),
                static_cast<std::size_t>(state.output.width));
  }
  return map;
}

}  // namespace

bool attach_confidence(ElementState& state, GstBuffer* output) {
  BufferPointer map = copy_confidence(state);
  if (!map) {
    post_error(state, GST_RESOURCE_ERROR, GST_RESOURCE_ERROR_NO_SPACE_LEFT,
               "There is not enough memory for a confidence map of " +
                   std::to_string(state.output.width) + "x" + std::to_string(state.output.height) +
                   " px. Set confidence-map=false if it is not needed.",
               state.streams_text());
    return false;
  }
  const SamplePointer sample = state.confidence_pool.finish(std::move(map), output);
  set_confidence(output, sample.get());
  return true;
}

}  // namespace mtstereo::plugin
