// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <cstdlib>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// A pixel of a thin run: its evidence, its difference from the right view, its gray value.
struct ThinSample {
  int gain = 0, misfit = 0, gray = 0;
};

struct ThinPiece {
  int line, begin, end, disparity, before, after;
  int previous = -1, next = -1, chain = -1;
  int gain = 0, misfit = 0;
  std::vector<ThinSample> samples{};  ///< from one before the run to one after it
};

/// Access to a map by line and position; lines are rows or columns.
struct ThinLines {
  const DisparityPlane& map;
  bool rows;
  int count() const { return rows ? map.height : map.width; }
  int length() const { return rows ? map.width : map.height; }
  int at(int line, int i) const {
    if (i < 0 || i >= length()) return 0;
    return rows ? map(i, line) : map(line, i);
  }
};

/// The nearest known disparity among 13 pixels from `i` on in steps of `step`; 0 = none.
inline int nearest_known(const ThinLines& lines, int line, int i, int step) {
  for (int k = 0; k < 13; ++k) {
    if (lines.at(line, i + k * step) != 0) return lines.at(line, i + k * step);
  }
  return 0;
}

inline std::vector<ThinPiece> thin_pieces(const ThinLines& lines) {
  std::vector<ThinPiece> pieces;
  for (int line = 0; line < lines.count(); ++line) {
    int kept = 0;
    for (int begin = 0, end = 0; begin < lines.length(); begin = end) {
      end = begin + 1;
      if (lines.at(line, begin) == 0) continue;
      long sum = lines.at(line, begin);
      while (lines.at(line, end) != 0 &&
             std::abs(lines.at(line, end) - lines.at(line, end - 1)) <= 256) {
        sum += lines.at(line, end++);
      }
      const int mean = static_cast<int>(sum / (end - begin));
      const int before = nearest_known(lines, line, begin - 1, -1);
      const int after = nearest_known(lines, line, end, 1);
      const bool nearer = mean - before > 512 && mean - after > 512;
      if (end - begin > 13 || !nearer || (before == 0 && after == 0)) continue;
      if (kept++ > lines.length() / 8) continue;
      pieces.push_back({line, begin, end, mean, before, after});
    }
  }
  return pieces;
}

/// Each run continues the first one of those in the line before that overlap it most, or else one
/// in the second line before it.
inline void link_pieces(std::vector<ThinPiece>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    ThinPiece& run = pieces[i];
    for (int back = 1; back <= 2 && run.previous < 0; ++back) {
      int most = 0;
      for (std::size_t k = 0; k < i; ++k) {
        const ThinPiece& other = pieces[k];
        const int overlap = std::min(run.end, other.end) - std::max(run.begin, other.begin);
        if (other.line != run.line - back || overlap <= most) continue;
        if (std::abs(run.disparity - other.disparity) > 256) continue;
        most = overlap;
        run.previous = static_cast<int>(k);
      }
    }
    run.chain = static_cast<int>(i);
    if (run.previous < 0) continue;
    run.chain = pieces[run.previous].chain;
    if (pieces[run.previous].next < 0) pieces[run.previous].next = static_cast<int>(i);
  }
}

/// The least difference of a gray value from the line through the right view's pixels, within half
/// a pixel of a position [1/256 px]; at most 30.
inline int thin_difference(const GrayPlane& right, int gray, int at, int y) {
  const int first = at - 128, last = at + 128, middle = static_cast<int>(std::floor(last / 256.0));
  const auto value = [&](int place) {
    const int x = static_cast<int>(std::floor(place / 256.0)), part = place - 256 * x;
    return (right.clamped(x, y) * (256 - part) + right.clamped(x + 1, y) * part) / 256;
  };
  const int at_middle = right.clamped(middle, y);
  const int low = std::min({value(first), value(last), at_middle});
  const int high = std::max({value(first), value(last), at_middle});
  const int away = gray < low ? low - gray : gray > high ? gray - high : 0;
  return std::min(away, 30);
}

inline void rate_pieces(const GrayPlane& left, const GrayPlane& right, const ThinLines& lines,
                        std::vector<ThinPiece>& pieces) {
  for (ThinPiece& run : pieces) {
    int inside = 0;
    for (int i = run.begin - 1; i <= run.end; ++i) {
      const int place = std::clamp(i, 0, lines.length() - 1);
      const int x = lines.rows ? place : run.line, y = lines.rows ? run.line : place;
      const auto from = [&](int disparity) {
        return thin_difference(right, left(x, y), 256 * x - disparity, y);
      };
      const int before = run.before != 0 ? run.before : run.after;
      const int after = run.after != 0 ? run.after : run.before;
      const int own = from(run.disparity);
      run.samples.push_back({std::min(from(before), from(after)) - own, own, left(x, y)});
      if (place != i) continue;
      run.gain += run.samples.back().gain;
      run.misfit += own;
      ++inside;
    }
    run.gain = 16 * run.gain / inside;
    run.misfit = 16 * run.misfit / inside;
  }
}

inline bool accepted(const std::vector<ThinPiece>& pieces, int chain, bool rows) {
  int runs = 0, gain = 0, misfit = 0, convincing = 0, enclosed = 0;
  for (const ThinPiece& run : pieces) {
    if (run.chain != chain) continue;
    ++runs;
    gain += run.gain;
    misfit += run.misfit;
    convincing += run.gain > 8;
    enclosed += run.before != 0 && run.after != 0;
  }
  return runs >= (rows ? 12 : 20) && gain >= (rows ? 64 : 32) * runs &&
         100 * convincing >= (rows ? 80 : 50) * runs && misfit <= 240 * runs && 2 * gain > misfit &&
         2 * enclosed >= runs;
}

/// Whether the i-th pixel of a run is part of the object.
inline bool keeps(const std::vector<ThinPiece>& pieces, const ThinPiece& run, int i) {
  const int width = run.end - run.begin;
  std::vector<const ThinPiece*> around = {&run};
  for (int k = 0, at = run.previous; k < 4 && at >= 0; ++k, at = pieces[at].previous) {
    around.push_back(&pieces[at]);
  }
  for (int k = 0, at = run.next; k < 4 && at >= 0; ++k, at = pieces[at].next) {
    around.push_back(&pieces[at]);
  }
  int count = 0;
  const auto sum_at = [&](int place) {
    ThinSample sum;
    count = 0;
    for (const ThinPiece* other : around) {
      const int wider = other->end - other->begin - width;
      const int there = place + static_cast<int>(std::floor(wider / 2.0));
      if (there < 0 || there >= static_cast<int>(other->samples.size())) continue;
      sum.gain += other->samples[there].gain;
      sum.misfit += other->samples[there].misfit;
      sum.gray += other->samples[there].gray;
      ++count;
    }
    return sum;
  };
  const auto gray = [&](int place) {
    const int sum = sum_at(place).gray;
    return 16 * sum / count;
  };
  const int middle = (gray(1 + width / 2) + gray(1 + (width - 1) / 2)) / 2;
  const int outside = gray(2 * i + 1 < width ? 0 : width + 1);
  if (5 * std::abs(gray(i + 1) - middle) > 4 * std::abs(gray(i + 1) - outside)) return false;
  const ThinSample sum = sum_at(i + 1);
  return sum.gain > 2 * count && sum.misfit <= 4 * count;
}

/// Negates the disparities of thin structures in `found`, which has the pixels of the map.
inline void mark_thin_along(const GrayPlane& left, const GrayPlane& right,
                            const DisparityPlane& map, bool rows, DisparityPlane& found) {
  const ThinLines lines{map, rows};
  std::vector<ThinPiece> pieces = thin_pieces(lines);
  link_pieces(pieces);
  rate_pieces(left, right, lines, pieces);
  for (const ThinPiece& run : pieces) {
    if (!accepted(pieces, run.chain, rows)) continue;
    for (int i = 0; i < run.end - run.begin; ++i) {
      if (!keeps(pieces, run, i)) continue;
      const int x = rows ? run.begin + i : run.line, y = rows ? run.line : run.begin + i;
      found(x, y) = -map(x, y);
    }
  }
}

inline DisparityPlane mark_thin(const GrayPlane& left, const GrayPlane& right,
                                const DisparityPlane& map) {
  DisparityPlane found = map;
  mark_thin_along(left, right, map, true, found);
  mark_thin_along(left, right, map, false, found);
  return found;
}

}  // namespace mtstereo::reference
