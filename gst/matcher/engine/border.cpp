// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/border.hpp"

#include <algorithm>
#include <cstddef>

namespace mtstereo::plugin {
namespace {

/// Sets values to 0; returns how many were not 0.
long clear(std::uint16_t* begin, const std::uint16_t* end) {
  long removed = 0;
  for (std::uint16_t* value = begin; value < end; ++value) {
    removed += *value != 0 ? 1 : 0;
    *value = 0;
  }
  return removed;
}

/// Removes the disparities of a row whose right pixels, x - disparity, are not in the columns.
long clear_partners(std::uint16_t* row, int begin, int end, ValidColumns right, int width,
                    const DisparityUnit& unit) {
  if (right.begin == 0 && right.end == width) return 0;
  long removed = 0;
  for (int x = begin; x < end; ++x) {
    const int value = row[x];
    // The disparity is value / scale + offset; a pixel between two columns needs both.
    const int most = (x - right.begin - unit.offset) * unit.scale;
    const int least = (x - (right.end - 1) - unit.offset) * unit.scale;
    const bool remove = value > most || value < least;
    removed += remove && value != 0 ? 1 : 0;
    row[x] = remove ? std::uint16_t{0} : row[x];
  }
  return removed;
}

}  // namespace

std::vector<ValidColumns> without_margin(const std::vector<ValidColumns>& columns, int width,
                                         int margin) {
  const auto height = static_cast<int>(columns.size());
  std::vector<ValidColumns> result(columns.size());
  for (int y = 0; y < height; ++y) {
    int begin = 0;
    int end = width;
    const int last = std::min(y + margin, height - 1);
    for (int near = std::max(y - margin, 0); near <= last; ++near) {
      const ValidColumns& row = columns[static_cast<std::size_t>(near)];
      begin = std::max(begin, row.begin);
      end = std::min(end, row.end);
    }
    if (begin > 0) begin += margin;
    if (end < width) end -= margin;
    if (begin < end) result[static_cast<std::size_t>(y)] = {begin, end};
  }
  return result;
}

long remove_border(ImageView<std::uint16_t> map, const std::vector<ValidColumns>& left,
                   const std::vector<ValidColumns>& right, const DisparityUnit& unit) {
  long removed = 0;
  const ValidColumns all{0, map.width};
  for (int y = 0; y < map.height; ++y) {
    std::uint16_t* row = map.row(y);
    const auto index = static_cast<std::size_t>(y);
    const ValidColumns own = left.empty() ? all : left[index];
    const ValidColumns partners = right.empty() ? all : right[index];
    removed += clear(row, row + own.begin) + clear(row + own.end, row + map.width);
    removed += clear_partners(row, own.begin, own.end, partners, map.width, unit);
  }
  return removed;
}

}  // namespace mtstereo::plugin
