// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/block_moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#define HWY_TARGET_INCLUDE "stages/prepare/block_moves.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// The rows y0 .. y1 - 1 of a block whose first column is x from means that are moved by (move_x,
/// move_y). Also the last block of a row is a whole one: its end belongs to the padding. Halves are
/// rounded up, first between two rows and then to whole steps of a mean.
void move_block(const Means& last, int move_x, int move_y, int x, int y0, int y1, Means& moved) {
  static_assert(256 * kMeanOne * kMoveOne <= 32768, "16 bits are enough");
  const hn::CappedTag<std::int16_t, kTimeBlock> d16;
  const hn::Rebind<std::uint8_t, decltype(d16)> d8;
  const int from_x = kMoveOne * x + move_x, from_y = kMoveOne * y0 + move_y;
  const int column = from_x / kMoveOne, row = from_y / kMoveOne - y0;
  const auto right = hn::Set(d16, static_cast<std::int16_t>(from_x % kMoveOne));
  const auto down = hn::Set(d16, static_cast<std::int16_t>(from_y % kMoveOne << (15 - kMoveShift)));
  const auto last_bits = hn::Set(d16, kMeanOne - 1);
  const std::uint8_t *const grays = last.filtered.row(0), *const rests = last.rests.row(0);
  const std::ptrdiff_t gray_stride = last.filtered.stride(), rest_stride = last.rests.stride();
  // Means between two columns [1 / kMoveOne steps].
  const auto across = [&](int y, int from) {
    const std::uint8_t* gray_row = grays + y * gray_stride + from;
    const std::uint8_t* rest_row = rests + y / 2 * rest_stride + from;
    const auto at = [&](int i) {
      const auto both = hn::PromoteTo(d16, hn::LoadU(d8, rest_row + i));
      const auto rest = y % 2 == 0 ? hn::And(both, last_bits) : hn::ShiftRight<kMeanShift>(both);
      const auto gray = hn::PromoteTo(d16, hn::LoadU(d8, gray_row + i));
      return hn::Or(hn::ShiftLeft<kMeanShift>(gray), rest);
    };
    const auto first = at(0);
    return hn::Add(hn::ShiftLeft<kMoveShift>(first), hn::Mul(hn::Sub(at(1), first), right));
  };
  for (int i = 0; i < kTimeBlock; i += static_cast<int>(hn::Lanes(d16))) {
    auto above = across(row + y0, column + i);
    auto upper_rest = hn::Zero(d16);
    for (int y = y0; y < y1; ++y) {
      const auto below = across(row + y + 1, column + i);
      const auto between = hn::Add(above, hn::MulFixedPoint15(hn::Sub(below, above), down));
      const auto mean = hn::ShiftRight<kMoveShift>(hn::Add(between, hn::Set(d16, kMoveOne / 2)));
      hn::StoreU(hn::DemoteTo(d8, hn::ShiftRight<kMeanShift>(mean)), d8,
                 moved.filtered.row(y) + x + i);
      auto rest = hn::And(mean, last_bits);
      if (y % 2 != 0) rest = hn::Or(upper_rest, hn::ShiftLeft<kMeanShift>(rest));
      hn::StoreU(hn::DemoteTo(d8, rest), d8, moved.rests.row(y / 2) + x + i);
      upper_rest = rest;
      above = below;
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(move_block);

namespace {

/// The median of some pixels of a block.
float block_disparity(const Image<std::uint16_t>& map, const MapPlace& place, int x0, int y0) {
  constexpr std::array kSampled = {1, 3, 4, 6};
  std::array<int, kSampled.size() * kSampled.size()> known;
  int count = 0;
  for (const int dy : kSampled) {
    const int y = (y0 + dy) / place.scale;
    for (const int dx : kSampled) {
      const int from_first = x0 + dx - place.column, x = from_first / place.scale;
      if (y >= map.height() || from_first < 0 || x >= map.width() || map.row(y)[x] == 0) continue;
      known[count++] = map.row(y)[x];
    }
  }
  if (count == 0) return kNoBlock;
  std::nth_element(known.begin(), known.begin() + count / 2, known.begin() + count);
  return static_cast<float>(place.scale * known[count / 2]) / kHeldOne +
         static_cast<float>(place.column);
}

/// Whether the block at (x0, y0) and the pixels after it are inside a view when it is moved.
bool is_inside(int x0, int y0, int x, int y, int width, int height) {
  if (x == BlockMoves::kUnknown) return false;
  const auto fits = [](int first, int offset, int size) {
    const int begin = kMoveOne * first + offset;
    return begin >= 0 && begin + kMoveOne * kTimeBlock <= kMoveOne * (size - 1);
  };
  return fits(x0, x, width) && fits(y0, y, height);
}

/// Blocks without an offset take that of the block before or above, with a step of -1 of the block
/// after or below.
void fill_unknown(BlockMoves& moves, int step) {
  const int columns = moves.x.width(), rows = moves.x.height();
  const auto take = [&](int column, int row, int from_column, int from_row) {
    if (from_column < 0 || from_column >= columns || from_row < 0 || from_row >= rows) return;
    if (moves.x.row(row)[column] != BlockMoves::kUnknown) return;
    moves.x.row(row)[column] = moves.x.row(from_row)[from_column];
    moves.y.row(row)[column] = moves.y.row(from_row)[from_column];
  };
  for (int i = 0; i < rows; ++i) {
    const int row = step > 0 ? i : rows - 1 - i;
    for (int k = 0; k < columns; ++k) {
      const int column = step > 0 ? k : columns - 1 - k;
      take(column, row, column - step, row);
      take(column, row, column, row - step);
    }
  }
}

/// An offset in steps, or kUnknown if it is too large.
std::int16_t in_steps(float offset) {
  constexpr float kMost = 32000;
  const float steps = std::floor(offset * kMoveOne + 0.5F);
  return std::abs(steps) <= kMost ? static_cast<std::int16_t>(steps) : BlockMoves::kUnknown;
}

/// Sets the offset of the block to which a block of the last left view moved; `last` is its center.
void place_block(const CameraMotion& motion, const ScenePoint& last, int side, int width,
                 int height, BlockMoves& moves) {
  const float center_x = static_cast<float>(width) / 2, center_y = static_cast<float>(height) / 2;
  const ScenePoint now = motion.moved({last.x - center_x, last.y - center_y, last.disparity});
  const float shift = side == 0 ? 0 : now.disparity;
  const float last_shift = side == 0 ? 0 : last.disparity;
  const float x = now.x + center_x - shift, y = now.y + center_y;
  if (!(x >= 0 && y >= 0 && x < static_cast<float>(width) && y < static_cast<float>(height)))
    return;
  const int column = static_cast<int>(x) / kTimeBlock, row = static_cast<int>(y) / kTimeBlock;
  if (now.disparity <= moves.disparity.row(row)[column]) return;
  const std::int16_t move_x = in_steps(last.x - last_shift - x), move_y = in_steps(last.y - y);
  if (move_x == BlockMoves::kUnknown || move_y == BlockMoves::kUnknown) return;
  moves.disparity.row(row)[column] = now.disparity;
  moves.x.row(row)[column] = move_x;
  moves.y.row(row)[column] = move_y;
}

/// The number of frames in the means of the block that contains the center of a moved one.
std::uint8_t frames_there(const Image<std::uint8_t>& frames, int x0, int y0, int x, int y) {
  const auto block = [](int first, int offset) {
    return ((kMoveOne * first + offset) / kMoveOne + kTimeBlock / 2) / kTimeBlock;
  };
  return frames.row(block(y0, y))[block(x0, x)];
}

/// Begins the means of a block anew.
void take_view(GrayView view, int x0, int y0, int y1, Means& means) {
  const int count = std::min(kTimeBlock, view.width - x0);
  for (int y = y0; y < y1; ++y) {
    std::copy_n(view.row(y) + x0, count, means.filtered.row(y) + x0);
    std::fill_n(means.rests.row(y / 2) + x0, count, Means::kNoRests);
  }
}

}  // namespace

void BlockMoves::resize(int width, int height, ReusedMemory* reused) {
  const int columns = time_blocks(width), rows = time_blocks(height);
  x.resize(columns, rows, reused);
  y.resize(columns, rows, reused);
  disparity.resize(columns, rows, reused);
}

void find_block_disparities(const Image<std::uint16_t>& map, const MapPlace& place, int row0,
                            int row1, Image<float>& disparities) {
  for (int row = row0; row < row1; ++row) {
    for (int column = 0; column < disparities.width(); ++column) {
      disparities.row(row)[column] =
          block_disparity(map, place, column * kTimeBlock, row * kTimeBlock);
    }
  }
}

void find_moves(const CameraMotion& motion, const Image<float>& disparities, int side, int width,
                int height, BlockMoves& moves) {
  const int columns = disparities.width();
  for (int row = 0; row < disparities.height(); ++row) {
    std::fill_n(moves.x.row(row), columns, BlockMoves::kUnknown);
    std::fill_n(moves.y.row(row), columns, BlockMoves::kUnknown);
    std::fill_n(moves.disparity.row(row), columns, kNoBlock);
  }
  constexpr float kCenter = (kTimeBlock - 1) / 2.0F;
  for (int row = 0; row < disparities.height(); ++row) {
    for (int column = 0; column < columns; ++column) {
      const ScenePoint block = {static_cast<float>(column * kTimeBlock) + kCenter,
                                static_cast<float>(row * kTimeBlock) + kCenter,
                                disparities.row(row)[column]};
      if (block.disparity > kNoBlock) place_block(motion, block, side, width, height, moves);
    }
  }
  fill_unknown(moves, 1);
  fill_unknown(moves, -1);
}

void place_points(const MotionPoints& points, const MapPlace& place, MotionPoints& placed) {
  const auto scale = static_cast<float>(place.scale);
  const int count = points.columns * points.rows;
  placed.points.resize(count);
  placed.columns = points.columns;
  placed.rows = points.rows;
  for (int i = 0; i < count; ++i) {
    const ScenePoint& point = points.points[i];
    placed.points[i] = {scale * (point.x + 0.5F) - 0.5F + static_cast<float>(place.column),
                        scale * (point.y + 0.5F) - 0.5F, scale * point.disparity};
  }
}

void move_means(GrayView view, const BlockMoves& moves, const Means& last, int y0, int y1,
                Means& moved) {
  const auto move = HWY_DYNAMIC_DISPATCH(move_block);
  for (int top = y0; top < y1; top += kTimeBlock) {
    const int row = top / kTimeBlock, bottom = std::min(top + kTimeBlock, y1);
    for (int column = 0; column < moves.x.width(); ++column) {
      const int x0 = column * kTimeBlock;
      const int x = moves.x.row(row)[column], y = moves.y.row(row)[column];
      const bool inside = is_inside(x0, top, x, y, view.width, view.height);
      moved.frames.row(row)[column] = inside ? frames_there(last.frames, x0, top, x, y) : 0;
      if (inside) {
        move(last, x, y, x0, top, bottom, moved);
      } else {
        take_view(view, x0, top, bottom, moved);
      }
    }
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
