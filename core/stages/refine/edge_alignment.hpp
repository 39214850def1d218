// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/refine/edge_window.hpp"

namespace mtstereo {

/// Moves jumps of a complete map to the edges of the image. The windows of the matching cost reach
/// over the edges of objects, so that objects become too wide. A pixel near a jump takes the
/// weighted median of the disparities around it. Pixels of nearly its gray value have the most
/// weight.
///
/// Call find_jumps() for all bands of rows, then align_edges() or doubt_edges() for all bands.

/// Neighbors that differ by more are a jump [1 / kDisparityOne px].
inline constexpr std::int32_t kJump = 2 * kDisparityOne;

/// A pixel is near a jump if it is at most this many columns and rows away [px].
inline constexpr int kEdgeReach = 3;

/// Steps per px of the disparities that the median compares.
inline constexpr int kEdgeOne = 16;

/// The weight of a pixel: 1 + kEdgeContrast minus the difference of the gray values, at least 1.
inline constexpr int kEdgeContrast = 24;

/// A pixel keeps its disparity if the median differs by less [steps of 1 / kEdgeOne px].
inline constexpr int kEdgeKept = kEdgeOne / 2;

/// What find_jumps() writes for align_edges(). Its rows have borders of kEdgeRadius columns that
/// repeat the outermost ones.
struct EdgeMap {
  Image<std::int16_t> disparity;  ///< [1 / kEdgeOne px]
  Image<std::uint8_t> gray;       ///< of the left view
  Image<std::uint8_t> near;       ///< without borders: 1 within kEdgeReach columns of a jump

  void resize(int width, int height, ReusedMemory* reused = nullptr);
};

/// Writes the rows y0 .. y1 - 1 of `edges`. A jump between two rows belongs to the upper one. If
/// `changed` is not nullptr, only jumps count that have a pixel on one side that it marks.
void find_jumps(GrayView left_view, const Image<std::int32_t>& map,
                const Image<std::uint8_t>* changed, int y0, int y1, EdgeMap& edges);

/// Scratch memory of one thread.
struct EdgeScratch {
  Buffer<std::uint8_t> near;  ///< a row

  void resize(int width);
};

/// Aligns the rows y0 .. y1 - 1 of the map. A pixel that changes is inferred: its confidence
/// becomes kMostInferred at most.
void align_edges(const EdgeMap& edges, int y0, int y1, EdgeScratch& scratch,
                 Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

/// Only lowers the confidence of the pixels that align_edges() would change: where inferred
/// disparities are rejected, the medians are not needed, nor are the windows of inferred pixels.
void doubt_edges(const EdgeMap& edges, int y0, int y1, EdgeScratch& scratch,
                 Image<std::uint8_t>& confidence);

}  // namespace mtstereo
