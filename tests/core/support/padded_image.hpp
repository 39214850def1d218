// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstring>

#include "support/plane.hpp"

namespace mtstereo::test {

/// An image in a larger block of memory, as a caller of the library may have it: with bytes before
/// the first row, between the rows and after the last one. They hold a pattern that reveals writes.
template <typename T>
class PaddedImage {
 public:
  /// `padding` bytes follow each row (a multiple of the pixel size); the first pixel lies `offset`
  /// bytes after a 64-byte boundary.
  PaddedImage(const Plane<T>& plane, int padding, int offset = 0)
      : width_(plane.width),
        height_(plane.height),
        stride_(plane.width * sizeof(T) + padding),
        first_(kGuard + offset) {
    block_.resize(first_ + stride_ * height_ + kGuard);
    std::memset(block_.data(), kPoison, block_.size());
    for (int y = 0; y < height_; ++y) {
      std::memcpy(block_.data() + first_ + y * stride_, &plane(0, y), width_ * sizeof(T));
    }
    before_ = copy();
  }

  ImageView<const T> view() const {
    return {reinterpret_cast<const T*>(block_.data() + first_), width_, height_, stride_};
  }
  ImageView<T> writable() {
    return {reinterpret_cast<T*>(block_.data() + first_), width_, height_, stride_};
  }
  /// The image upside down: starts at the last row, with a negative stride.
  ImageView<const T> upside_down() const {
    return {reinterpret_cast<const T*>(block_.data() + first_ + (height_ - 1) * stride_), width_,
            height_, -stride_};
  }

  /// True if no byte has changed since the image was constructed.
  bool unchanged() const { return copy() == before_; }
  /// True if only pixels have changed and no byte around them.
  bool padding_unchanged() const {
    std::vector<std::uint8_t> now = copy();
    for (int y = 0; y < height_; ++y) {
      const std::ptrdiff_t at = first_ + y * stride_;
      std::copy_n(before_.data() + at, width_ * sizeof(T), now.data() + at);
    }
    return now == before_;
  }

 private:
  static constexpr int kGuard = 128;
  static constexpr int kPoison = 0xA5;
  std::vector<std::uint8_t> copy() const { return {block_.data(), block_.data() + block_.size()}; }

  int width_;
  int height_;
  std::ptrdiff_t stride_;
  std::ptrdiff_t first_;
  Buffer<std::uint8_t> block_;
  std::vector<std::uint8_t> before_;
};

}  // namespace mtstereo::test
