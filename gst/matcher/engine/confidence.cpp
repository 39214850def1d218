// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/confidence.hpp"

#include <cstring>
#include <utility>

#include "shared/confidence_meta.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {
namespace {

/// Sets the confidence to 0 where the map has no disparity. False if the map cannot be mapped.
bool clear_removed(GstBuffer* buffer, const GstVideoInfo& map_info, GstVideoFrame& confidence) {
  const MappedFrame map(map_info, buffer, GST_MAP_READ);
  if (!map.mapped()) return false;
  for (int y = 0; y < map_info.height; ++y) {
    const auto* disparities = reinterpret_cast<const std::uint16_t*>(plane_row(*map.frame(), y));
    std::uint8_t* row = plane_row(confidence, y);
    for (int x = 0; x < map_info.width; ++x) {
      row[x] = disparities[x] != 0 ? row[x] : std::uint8_t{0};
    }
  }
  return true;
}

}  // namespace

BufferPointer ConfidenceMaps::copy(GrayView confidence, GstBuffer* map,
                                   const GstVideoInfo& map_info, bool removed) {
  if (!pool_.fit(map_info)) return nullptr;
  BufferPointer buffer = pool_.acquire();
  if (!buffer) return nullptr;
  MappedFrame frame(pool_.info(), buffer.get(), GST_MAP_WRITE);
  if (!frame.mapped()) return nullptr;
  for (int y = 0; y < map_info.height; ++y) {
    std::memcpy(plane_row(*frame.frame(), y), confidence.row(y),
                static_cast<std::size_t>(map_info.width));
  }
  if (removed && !clear_removed(map, map_info, *frame.frame())) return nullptr;
  return buffer;
}

bool ConfidenceMaps::attach(GrayView confidence, GstBuffer* map, const GstVideoInfo& map_info,
                            bool removed) {
  BufferPointer buffer = copy(confidence, map, map_info, removed);
  if (!buffer) return false;
  const SamplePointer sample = pool_.finish(std::move(buffer), map);
  set_confidence(map, sample.get());
  return true;
}

}  // namespace mtstereo::plugin
