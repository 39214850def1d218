// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/confidence.hpp"

#include <cstring>

#include "shared/confidence_meta.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {
namespace {

/// Sets the confidence to 0 where the map has no disparity: in the border they are removed after
/// the matching. False if the map cannot be mapped.
bool clear_removed(const ElementState& state, GstBuffer* output, GstVideoFrame& confidence) {
  const MappedFrame map(state.output, output, GST_MAP_READ);
  if (!map.mapped()) return false;
  for (int y = 0; y < state.output.height; ++y) {
    const auto* disparities = reinterpret_cast<const std::uint16_t*>(plane_row(*map.frame(), y));
    std::uint8_t* row = plane_row(confidence, y);
    for (int x = 0; x < state.output.width; ++x) {
      row[x] = disparities[x] != 0 ? row[x] : std::uint8_t{0};
    }
  }
  return true;
}

/// The confidence of the last pair in a new buffer; NULL if there is no memory for it.
BufferPointer copy_confidence(ElementState& state, GstBuffer* output) {
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
  if (state.border_pixels > 0 && !clear_removed(state, output, *frame.frame())) return nullptr;
  return map;
}

}  // namespace

bool attach_confidence(ElementState& state, GstBuffer* output) {
  BufferPointer map = copy_confidence(state, output);
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
