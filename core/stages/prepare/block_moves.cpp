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
/// move_y). Also the last block of a row is a whole one: its end belongs to the padding.
void move_block(const Image<std::uint16_t>& last, int move_x, int move_y, int x, int y0, int y1,
                Image<std::uint16_t>& moved) {
  const hn::CappedTag<std::uint32_t, kTimeBlock> d32;
  const hn::Rebind<std::uint16_t, decltype(d32)> d16;
  constexpr int kShift = 6;
  static_assert(kMoveOne * kMoveOne == 1 << kShift);
  const int from_x = kMoveOne * x + move_x, from_y = kMoveOne * y0 + move_y;
  const int right = from_x % kMoveOne, down = from_y % kMoveOne;
  const auto weight = [&](int value) { return hn::Set(d32, static_cast<std::uint32_t>(value)); };
  const auto upper_left = weight((kMoveOne - down) * (kMoveOne - right));
  const auto upper_right = weight((kMoveOne - down) * right);
  const auto lower_left = weight(down * (kMoveOne - right)), lower_right = weight(down * right);
  const auto load = [&](const std::uint16_t* means) {
    return hn::PromoteTo(d32, hn::LoadU(d16, means));
  };
  for (int y = y0; y < y1; ++y) {
    const std::uint16_t* above = last.row(from_y / kMoveOne + y - y0) + from_x / kMoveOne;
    const std::uint16_t* below = above + last.stride();
    for (int i = 0; i < kTimeBlock; i += static_cast<int>(hn::Lanes(d32))) {
      const auto upper =
          hn::Add(hn::Mul(load(above + i), upper_left), hn::Mul(load(above + i + 1), upper_right));
      const auto lower =
          hn::Add(hn::Mul(load(below + i), lower_left), hn::Mul(load(below + i + 1), lower_right));
      const auto sum = hn::Add(hn::Add(upper, lower), weight(1 << (kShift - 1)));
      hn::StoreU(hn::TruncateTo(d16, hn::ShiftRight<kShift>(sum)), d16, moved.row(y) + x + i);
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
void take_view(GrayView view, int x0, int y0, int y1, Image<std::uint16_t>& mean) {
  const int right = std::min(x0 + kTimeBlock, view.width);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < right; ++x) {
      mean.row(y)[x] = static_cast<std::uint16_t>(view.row(y)[x] * kMeanOne);
    }
  }
}

}  // namespace

void BlockMoves::resize(int width, int height) {
  const int columns = time_blocks(width), rows = time_blocks(height);
  x.resize(columns, rows);
  y.resize(columns, rows);
  disparity.resize(columns, rows);
}

void Means::resize(int width, int height) {
  mean.resize(width, height);
  frames.resize(time_blocks(width), time_blocks(height));
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

void move_means(GrayView view, const BlockMoves& moves, const Image<std::uint16_t>& last,
                const Image<std::uint8_t>& frames, int y0, int y1, Means& moved,
                Image<std::uint8_t>& filtered) {
  for (int top = y0; top < y1; top += kTimeBlock) {
    const int row = top / kTimeBlock, bottom = std::min(top + kTimeBlock, y1);
    for (int column = 0; column < frames.width(); ++column) {
      const int x0 = column * kTimeBlock;
      const int x = moves.x.row(row)[column], y = moves.y.row(row)[column];
      const bool inside = is_inside(x0, top, x, y, view.width, view.height);
      moved.frames.row(row)[column] = inside ? frames_there(frames, x0, top, x, y) : 0;
      if (inside) {
        HWY_DYNAMIC_DISPATCH(move_block)(last, x, y, x0, top, bottom, moved.mean);
      } else {
        take_view(view, x0, top, bottom, moved.mean);
      }
    }
    for (int y = top; y < bottom; ++y) {
      const std::uint16_t* __restrict__ means = moved.mean.row(y);
      std::uint8_t* __restrict__ out = filtered.row(y);
      for (int x = 0; x < view.width; ++x) {
        out[x] = static_cast<std::uint8_t>((means[x] + kMeanOne / 2) / kMeanOne);
      }
    }
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
