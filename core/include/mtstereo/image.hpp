// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace mtstereo {

/// A view of an image. It does not own the pixels: the caller keeps them alive while the view is in
/// use. Row y starts `stride` bytes after row y - 1. Padding bytes between the end of a row and the
/// start of the next one are never read or written.
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

/// An image of 8-bit gray values (luma).
using GrayView = ImageView<const std::uint8_t>;

/// A disparity map of the left view in fixed point: disparity [px] = value / kDisparityOne, plus
/// Parameters::disparity_offset() if negative disparities are searched (otherwise that is 0). The
/// left pixel (x, y) and the right pixel (x - disparity, y) show the same point of the scene. A
/// pixel without a disparity has the value kNoDisparity. The smallest value of a disparity is 1, so
/// that a point at infinity differs from an unknown one.
using DisparityView = ImageView<const std::int32_t>;

/// The value of 1 px of disparity in a DisparityView.
inline constexpr std::int32_t kDisparityOne = 256;

/// The value of a pixel without a disparity in a DisparityView.
inline constexpr std::int32_t kNoDisparity = 0;

/// The highest confidence of a disparity that was inferred and not matched in Mode::kFull, and of a
/// filled gap in Mode::kSemiDense with cost=census: the confidence of matched ones is higher.
inline constexpr int kMostInferred = 15;

}  // namespace mtstereo
