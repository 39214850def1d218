// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/depth_frame.hpp"

#include <gst/video/video.h>

#include <cstddef>

namespace mtstereo::plugin {
namespace {

/// True if the library can read and write the pixels as they are.
bool is_native(const ImageView<std::uint16_t>& image) {
  constexpr std::uintptr_t kMask = alignof(std::uint16_t) - 1;
  return G_BYTE_ORDER == G_LITTLE_ENDIAN && ((reinterpret_cast<std::uintptr_t>(image.data) |
                                              static_cast<std::uintptr_t>(image.stride)) &
                                             kMask) == 0;
}

ImageView<const std::uint16_t> read_only(const ImageView<std::uint16_t>& image) {
  return {image.data, image.width, image.height, image.stride};
}

/// Calls visit(bytes, value) with each pixel of the frame and its copy.
template <typename Visit>
void for_each_pixel(MappedFrame& frame, const ImageView<std::uint16_t>& copy, Visit&& visit) {
  for (int y = 0; y < copy.height; ++y) {
    std::uint8_t* bytes = plane_row(*frame.frame(), y);
    std::uint16_t* values = copy.row(y);
    for (int x = 0; x < copy.width; ++x)
      visit(bytes + 2 * static_cast<std::ptrdiff_t>(x), values[x]);
  }
}

}  // namespace

Status FrameBounds::write(MappedFrame& frame) {
  const ImageView<std::uint16_t> image = frame.gray16();
  if (is_native(image)) return space_.bound_unknown(read_only(image), image);
  copy_.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const ImageView<std::uint16_t> copy = {copy_.data(), image.width, image.height,
                                         2 * static_cast<std::ptrdiff_t>(image.width)};
  for_each_pixel(frame, copy,
                 [](const std::uint8_t* bytes, std::uint16_t& value) { value = read16(bytes); });
  if (Status status = space_.bound_unknown(read_only(copy), copy); !status) return status;
  for_each_pixel(frame, copy,
                 [](std::uint8_t* bytes, std::uint16_t value) { write16(bytes, value); });
  return {};
}

void write_depths(const DepthConverter& converter, MappedFrame& frame) {
  const ImageView<std::uint16_t> image = frame.gray16();
  // MappedFrame has checked what the converter checks.
  if (is_native(image) && converter.convert(read_only(image), image)) return;
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* row = plane_row(*frame.frame(), y);
    for (int x = 0; x < image.width; ++x, row += 2) {
      write16(row, converter.depth16_of(read16(row)));
    }
  }
}

}  // namespace mtstereo::plugin
