// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Averages a view over time where it is still. Each pixel has a recursive mean: a frame has the
/// weight 1 / n, where n counts the frames since the pixel's block changed, up to kMostFrames, and
/// falls as the block differs from its means more than noise does. Where the view changes, the
/// filtered view is the view; block_moves.hpp moves the means before a moving camera.
///
/// Per frame: measure_changes() for all bands of rows, rate_changes() and count_frames() once, then
/// average_rows() for all bands. A band begins with the first row of a block.

/// Side of a block [px].
inline constexpr int kTimeBlock = 8;
static_assert(kTimeBlock % 2 == 0, "two rows of Means share their rests");
inline constexpr int kTimeBlockPixels = kTimeBlock * kTimeBlock;

/// Number of blocks for this many pixels.
inline constexpr int time_blocks(int pixels) { return (pixels + kTimeBlock - 1) / kTimeBlock; }

/// Most frames in a mean.
inline constexpr int kMostFrames = 8;

/// A block is still if its pixels differ from their means by at most kStillDeviation times the
/// deviation of that difference, as noise makes it, plus kStillRest on average [gray values]. Noise
/// alone makes 0.8 times as much.
inline constexpr float kStillDeviation = 1.04F;
inline constexpr float kStillRest = 0.5F;

/// A still block is trusted less, the more the sum of its differences departs from 0, and not at
/// all from this many deviations on. The deviation is that of all blocks (1.48 times the median),
/// but at most what noise makes, and at least kLeastDeviation [gray values of kTimeBlockPixels].
inline constexpr float kMostDeviations = 6;
inline constexpr float kLeastDeviation = 4;

/// Steps of a mean per gray value, of a number of frames, of a trust and of a weight.
inline constexpr int kMeanShift = 4;
inline constexpr int kMeanOne = 1 << kMeanShift;
inline constexpr int kFramesOne = 16;
inline constexpr int kTrustOne = 128;
inline constexpr int kWeightOne = 16384;

/// The means of a view: per pixel kMeanOne * filtered + rest - kMeanOne / 2 [1 / kMeanOne gray
/// values], at least 0. Finer steps change no map by more than chance, and these take half a byte.
struct Means {
  Image<std::uint8_t> filtered;  ///< rounded to gray values: the filtered view
  Image<std::uint8_t> rests;     ///< of two rows in one: the upper one in the lower four bits
  Image<std::uint8_t> frames;    ///< in the means of each block [1 / kFramesOne]; 0: just the view

  /// The rest of a mean that is the filtered view, of both rows.
  static constexpr std::uint8_t kNoRests = 0x88;

  void resize(int width, int height, ReusedMemory* reused = nullptr);
  /// Sets all means to 0: the first frame is added to them with its full weight.
  void clear();
};

/// What is known of the blocks of a view in one frame. All images have one pixel per block but
/// `weights`.
struct TimeBlocks {
  Image<std::int32_t> change;      ///< sum of the differences from the means, of 64 pixels
  Image<std::int32_t> difference;  ///< sum of their magnitudes, of 64 pixels
  Image<std::uint8_t> trust;       ///< [1 / kTrustOne]
  Image<std::int16_t> weights;     ///< of the frame, a row of pixels per row of blocks, times -2
  Buffer<std::int32_t> sorted;     ///< scratch memory of rate_changes()

  void resize(int width, int height, ReusedMemory* reused = nullptr);
};

/// Compares the rows y0 .. y1 - 1 with the filtered view of the last frame.
void measure_changes(GrayView view, const Image<std::uint8_t>& filtered, int y0, int y1,
                     TimeBlocks& blocks);

/// Decides which blocks are still, with this standard deviation of the noise of the view, and
/// returns their share. `frames` are those in the means.
double rate_changes(float noise, const Image<std::uint8_t>& frames, TimeBlocks& blocks);

/// Counts the frames in the means with this frame; 1 everywhere if they begin anew. A block is
/// trusted as little as the eight around it: what moves also changes the map beside it. `last` may
/// be `frames`.
void count_frames(bool anew, const Image<std::uint8_t>& last, TimeBlocks& blocks,
                  Image<std::uint8_t>& frames);

/// Adds the rows y0 .. y1 - 1 of a frame to the means `last`, which may be `means`.
void average_rows(GrayView view, int y0, int y1, const TimeBlocks& blocks, const Means& last,
                  Means& means);

}  // namespace mtstereo
