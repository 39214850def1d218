// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace mtstereo {

/// A view of an image that somebody else owns: it neither allocates nor frees. Row y begins
/// `stride` bytes after row y - 1; the bytes between the end of a row and the next one are never
/// read and never written.
template <typename T>
struct ImageView {
  T* data = nullptr;          ///< first pixel of the first row
  int width = 0;              ///< [px]
  int height = 0;             ///< [px]
  std::ptrdiff_t stride = 0;  ///< from row to row [bytes], at least width * sizeof(T)

  /// First pixel of row y, 0 <= y < height.
  T* row(int y) const {
    using Byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
    return reinterpret_cast<T*>(reinterpret_cast<Byte*>(data) + y * stride);
  }
};

/// 8-bit gray values (luma), as a camera gives them.
using GrayView = ImageView<const std::uint8_t>;

/// Disparity of the left view in fixed point: px = value / kDisparityOne. The left pixel (x, y) and
/// the right pixel (x - disparity, y) show the same point. kNoDisparity where nothing is known; the
/// smallest disparity that is told is 1 / kDisparityOne px, so that a point at infinity differs
/// from none.
using DisparityView = ImageView<const std::int32_t>;

/// One px of disparity in a DisparityView.
inline constexpr std::int32_t kDisparityOne = 256;

/// The value of a DisparityView's pixel without a disparity.
inline constexpr std::int32_t kNoDisparity = 0;

}  // namespace mtstereo
