// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/remapping.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace mtstereo {
namespace {

using Corner = PositionMap::Corner;
using Weights = PositionMap::Weights;

constexpr int kBits = 5;
static_assert(1 << kBits == kPositionSteps);
/// Pixels of a row that are collected before they are interpolated.
constexpr int kBlock = 128;

const std::uint8_t* address(ImageView<const std::uint8_t> in, Corner corner, int channels) {
  return in.data + corner.y * in.stride + static_cast<std::ptrdiff_t>(corner.x) * channels;
}

/// The left pixel in the lower byte, the right one in the upper byte.
std::uint16_t load_pair(const std::uint8_t* from) {
  std::uint16_t pair = 0;
  std::memcpy(&pair, from, sizeof pair);
  if constexpr (std::endian::native == std::endian::big) {
    pair = static_cast<std::uint16_t>(pair << 8 | pair >> 8);
  }
  return pair;
}

/// Interpolates in a row of two pixels: kBits fractional bits.
std::int16_t between(int left, int right, int weight) {
  return static_cast<std::int16_t>(left * kPositionSteps + (right - left) * weight);
}

/// Rounds (top * (kPositionSteps - weight) + bottom * weight) to whole gray levels, in numbers of
/// 16 bits: the upper half of the product is the difference times the weight, without kBits bits.
/// What rounding down leaves out here does not change the result.
std::uint8_t between_rows(std::int16_t top, std::int16_t bottom, int weight) {
  constexpr int kUp = 2;
  const auto difference = static_cast<std::int16_t>((bottom - top) << kUp);
  const auto factor = static_cast<std::int16_t>(weight << (16 - kBits - kUp));
  const auto part = static_cast<std::int16_t>(difference * factor >> 16);
  constexpr int kHalf = 1 << (kBits - 1);
  return static_cast<std::uint8_t>(static_cast<std::int16_t>(top + part + kHalf) >> kBits);
}

/// Gray images: the pixels are collected by a loop of loads and interpolated by a loop that the
/// compiler turns into vector code.
void remap_gray(const Corner* corners, const Weights* weights, int count,
                ImageView<const std::uint8_t> in, std::uint8_t* out) {
  std::uint16_t tops[kBlock];
  std::uint16_t bottoms[kBlock];
  for (int first = 0; first < count; first += kBlock) {
    const int n = std::min(kBlock, count - first);
    for (int i = 0; i < n; ++i) {
      const std::uint8_t* from = address(in, corners[first + i], 1);
      tops[i] = load_pair(from);
      bottoms[i] = load_pair(from + in.stride);
    }
    for (int i = 0; i < n; ++i) {
      const Weights weight = weights[first + i];
      const std::int16_t top = between(tops[i] & 255, tops[i] >> 8, weight.x);
      const std::int16_t bottom = between(bottoms[i] & 255, bottoms[i] >> 8, weight.x);
      out[first + i] = between_rows(top, bottom, weight.y);
    }
  }
}

std::uint32_t load_word(const std::uint8_t* from) {
  std::uint32_t word = 0;
  std::memcpy(&word, from, sizeof word);
  return word;
}

/// The pixel on the right of that at `from`, and a byte that does not matter if it has three. No
/// byte after it is read.
template <int kChannels>
std::uint32_t load_right(const std::uint8_t* from) {
  if constexpr (kChannels == 4) return load_word(from + 4);
  const std::uint32_t word = load_word(from + 2);
  return std::endian::native == std::endian::little ? word >> 8U : word << 8U;
}

/// The pixels of a block and their weights, four bytes for each: the loop over the bytes is vector
/// code.
struct ColorBlock {
  static constexpr int kSize = 4 * kBlock;
  alignas(kAlignment) std::uint8_t top_left[kSize];
  alignas(kAlignment) std::uint8_t top_right[kSize];
  alignas(kAlignment) std::uint8_t bottom_left[kSize];
  alignas(kAlignment) std::uint8_t bottom_right[kSize];
  alignas(kAlignment) std::uint8_t right[kSize];  ///< weight of the right pixels
  alignas(kAlignment) std::uint8_t lower[kSize];  ///< weight of the lower pixels
  alignas(kAlignment) std::uint8_t result[kSize];

  static void store(std::uint8_t* to, int i, std::uint32_t word) {
    std::memcpy(to + 4 * i, &word, sizeof word);
  }
  void interpolate(int count) {
    for (int i = 0; i < 4 * count; ++i) {
      result[i] = between_rows(between(top_left[i], top_right[i], right[i]),
                               between(bottom_left[i], bottom_right[i], right[i]), lower[i]);
    }
  }
};

template <int kChannels>
void remap_color(const Corner* corners, const Weights* weights, int count,
                 ImageView<const std::uint8_t> in, std::uint8_t* out) {
  constexpr std::uint32_t kEachByte = 0x01010101;
  ColorBlock block;
  for (int first = 0; first < count; first += kBlock) {
    const int n = std::min(kBlock, count - first);
    for (int i = 0; i < n; ++i) {
      const std::uint8_t* top = address(in, corners[first + i], kChannels);
      const std::uint8_t* bottom = top + in.stride;
      ColorBlock::store(block.top_left, i, load_word(top));
      ColorBlock::store(block.top_right, i, load_right<kChannels>(top));
      ColorBlock::store(block.bottom_left, i, load_word(bottom));
      ColorBlock::store(block.bottom_right, i, load_right<kChannels>(bottom));
      ColorBlock::store(block.right, i, weights[first + i].x * kEachByte);
      ColorBlock::store(block.lower, i, weights[first + i].y * kEachByte);
    }
    block.interpolate(n);
    for (int i = 0; i < n; ++i, out += kChannels) {
      std::memcpy(out, block.result + 4 * i, kChannels);
    }
  }
}

void remap_run(const PositionMap& map, const PixelRun& run, ImageView<const std::uint8_t> in,
               ImageView<std::uint8_t> out, int channels) {
  const Corner* corners = map.corners(run.y) + run.begin;
  const Weights* weights = map.weights(run.y) + run.begin;
  std::uint8_t* to = out.row(run.y) + static_cast<std::ptrdiff_t>(run.begin) * channels;
  const int count = run.end - run.begin;
  if (channels == 1) {
    remap_gray(corners, weights, count, in, to);
  } else if (channels == 3) {
    remap_color<3>(corners, weights, count, in, to);
  } else {
    remap_color<4>(corners, weights, count, in, to);
  }
}

/// Splits a position into a corner that has neighbors on both sides, and the weight of the next
/// pixel. False if the position is outside of the image.
bool split(double position, int size, std::int16_t& corner, std::uint8_t& weight) {
  // Comparisons are false for NaN.
  if (!(position > -1) || !(position < size)) return false;
  const long steps = std::lrint(position * kPositionSteps);
  if (steps < 0 || steps > static_cast<long>(size - 1) * kPositionSteps) return false;
  const long whole = std::min(steps >> kBits, static_cast<long>(size) - 2);
  corner = static_cast<std::int16_t>(whole);
  weight = static_cast<std::uint8_t>(steps - whole * kPositionSteps);
  return true;
}

}  // namespace

void PositionMap::reset(int width, int height, int in_width, int in_height) {
  width_ = width;
  height_ = height;
  in_width_ = in_width;
  in_height_ = in_height;
  corners_.resize(index(height));
  weights_.resize(index(height));
  runs_.clear();
}

void PositionMap::append(int x, int y, double u, double v) {
  const std::size_t at = index(y) + static_cast<std::size_t>(x);
  Corner corner{};
  Weights weights{};
  if (!split(u, in_width_, corner.x, weights.x) || !split(v, in_height_, corner.y, weights.y)) {
    return;
  }
  corners_[at] = corner;
  weights_[at] = weights;
  if (!runs_.empty() && runs_.back().y == y && runs_.back().end == x) {
    ++runs_.back().end;
  } else {
    runs_.push_back({y, x, x + 1});
  }
}

void remap(const PositionMap& map, ImageView<const std::uint8_t> in, ImageView<std::uint8_t> out,
           int channels, std::uint8_t border) {
  int y = 0;
  int x = 0;
  const auto fill_row = [&](int end) {
    const auto offset = static_cast<std::ptrdiff_t>(x) * channels;
    std::memset(out.row(y) + offset, border,
                static_cast<std::size_t>(end - x) * static_cast<std::size_t>(channels));
    x = end;
  };
  const auto fill_to_row = [&](int row) {
    for (; y < row; ++y, x = 0) fill_row(map.width());
  };
  for (const PixelRun& run : map.runs()) {
    fill_to_row(run.y);
    fill_row(run.begin);
    remap_run(map, run, in, out, channels);
    x = run.end;
  }
  fill_to_row(map.height());
}

}  // namespace mtstereo
