// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fuzz_input.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo::fuzz {

/// Pseudo-random numbers from a seed.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed * 2 + 1) {}
  std::uint32_t next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::uint32_t>(state_ >> 33);
  }

 private:
  std::uint64_t state_;
};

/// An image with padded rows. The memory ends with the last pixel and begins at any alignment, so
/// that the sanitizer finds an access outside of it.
class FuzzImage {
 public:
  FuzzImage(int width, int height, int padding, int offset)
      : width_(width),
        height_(height),
        stride_(width + padding),
        offset_(offset),
        bytes_(static_cast<std::size_t>(offset) +
               static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height - 1) +
               static_cast<std::size_t>(width)) {}

  std::uint8_t& at(int x, int y) {
    return bytes_[static_cast<std::size_t>(offset_ + y * stride_ + x)];
  }
  GrayView view() const { return {bytes_.data() + offset_, width_, height_, stride_}; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// Paints what the next bytes of the input say: a gray value, stripes, noise of some strength, or
  /// the bytes themselves.
  void paint(FuzzInput& input) {
    const int kind = input.byte() % 5;
    const int base = input.byte();
    const int strength = input.byte();
    const int period = input.byte() % 32 + 1;
    Noise noise(input.bits(2));
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) at(x, y) = pixel(input, kind, base, strength, period, noise);
    }
    if (kind == 2) smooth();
  }

  /// Copies another image of this size, moved by a number of pixels to the left and of rows down.
  void copy_moved(const FuzzImage& from, int left, int down) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const GrayView source = from.view();
        at(x, y) =
            source.row(std::clamp(y - down, 0, height_ - 1))[std::clamp(x + left, 0, width_ - 1)];
      }
    }
  }

  /// Changes some pixels.
  void disturb(FuzzInput& input) {
    for (int count = input.byte() % 16; count > 0; --count) {
      const int x = input.byte() % width_;
      const int y = input.byte() % height_;
      at(x, y) = input.byte();
    }
  }

 private:
  std::uint8_t pixel(FuzzInput& input, int kind, int base, int strength, int period, Noise& noise) {
    const auto random = static_cast<int>(noise.next() % 256);
    switch (kind) {
      case 0:
        return static_cast<std::uint8_t>(base);
      case 1:
      case 2:
        return static_cast<std::uint8_t>(
            std::clamp(base + (random - 128) * strength / 128, 0, 255));
      case 3:
        return static_cast<std::uint8_t>(column_++ / period % 2 == 0 ? base : strength);
      default:
        return input.empty() ? static_cast<std::uint8_t>(random) : input.byte();
    }
  }
  void smooth() {
    for (int y = 0; y < height_; ++y) {
      for (int x = 1; x < width_; ++x) {
        at(x, y) = static_cast<std::uint8_t>((at(x, y) + 2 * at(x - 1, y)) / 3);
      }
    }
  }

  int width_;
  int height_;
  int stride_;
  int offset_;
  int column_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace mtstereo::fuzz
