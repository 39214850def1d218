// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "reference/prepare/halving.hpp"
#include "reference/refine/gap_filling.hpp"
#include "reference/refine/speckle_removal.hpp"

namespace mtstereo::reference {

/// Sums of squares of four pixels, plus 1, of the view (scale 2) or of its half (scale 4).
inline DisparityPlane reduced_sums(const GrayPlane& left, int scale) {
  const GrayPlane view = scale == 2 ? left : halve(left);
  DisparityPlane sums(left.width / scale, left.height / scale);
  for (int y = 0; y < sums.height; ++y) {
    for (int x = 0; x < sums.width; ++x) {
      sums(x, y) = 1 + view(2 * x, 2 * y) + view(2 * x + 1, 2 * y) + view(2 * x, 2 * y + 1) +
                   view(2 * x + 1, 2 * y + 1);
    }
  }
  return sums;
}

/// 8 quarters of a gray value at half the size, 12 at a quarter of it; less if the standard
/// deviation is below 40, at least twice the noise.
inline int flat_step(const DisparityPlane& half, int scale, float noise) {
  double sum = 0, squares = 0;
  for (const int gray : half.pixels) {
    sum += gray - 1;
    squares += (gray - 1.0) * (gray - 1.0);
  }
  const double count = static_cast<double>(half.pixels.size());
  const double variance = squares / count - sum / count * (sum / count);
  const double deviation = std::sqrt(std::max(variance, 0.0)) / 4;
  const int step =
      static_cast<int>(std::round((scale == 2 ? 8 : 12) * std::min(1.0, deviation / 40)));
  return std::max(step, static_cast<int>(2 * noise));
}

using Pixels = std::vector<std::pair<int, int>>;  ///< columns and rows

/// The areas of at least 300 pixels of the view, each from top to bottom and from left to right.
inline std::vector<Pixels> flat_areas(const DisparityPlane& half, int scale, int step) {
  std::vector<Pixels> areas;
  GrayPlane seen(half.width, half.height);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      if (seen(x, y) != 0) continue;
      Pixels area = flood(half, step, {x, y}, seen);
      if (area.size() * scale * scale < 300) continue;
      std::sort(area.begin(), area.end(), [](auto a, auto b) {
        return std::pair{a.second, a.first} < std::pair{b.second, b.first};
      });
      areas.push_back(std::move(area));
    }
  }
  return areas;
}

struct PlaneVote {
  float x, y, disparity;
  int weight;
};

/// At most 1500 of the pixels with a confidence above 60; none if no pixel has one below 100 or if
/// fewer than 12 have one above 60.
inline std::vector<PlaneVote> plane_votes(const Pixels& area, int scale, const ConfidentMap& in) {
  std::vector<PlaneVote> all;
  bool doubted = false;
  for (const auto& pixel : area) {
    const int x = scale * pixel.first, y = scale * pixel.second;
    const int confidence = in.confidence(x, y);
    doubted = doubted || confidence < 100;
    if (confidence <= 60) continue;
    all.push_back({static_cast<float>(x), static_cast<float>(y),
                   static_cast<float>(in.map(x, y)) / 256, confidence - 60});
  }
  if (!doubted || all.size() < 12) return {};
  const std::size_t taken = std::min<std::size_t>(all.size(), 1500);
  std::vector<PlaneVote> votes;
  for (std::size_t i = 0; i < taken; ++i) votes.push_back(all[i * all.size() / taken]);
  return votes;
}

struct VotedPlane {
  float a = 0, b = 0, c = 0;
  float at(float x, float y) const { return a * x + b * y + c; }
  bool fits(const PlaneVote& vote) const {
    return std::abs(at(vote.x, vote.y) - vote.disparity) <= std::max(1.0F, 0.02F * vote.disparity);
  }
};

inline int agreeing(const std::vector<PlaneVote>& votes, const VotedPlane& plane) {
  int weight = 0;
  for (const PlaneVote& vote : votes) weight += plane.fits(vote) ? vote.weight : 0;
  return weight;
}

/// The plane through three votes if it is not too steep and they are not in a line.
inline bool plane_through(const PlaneVote& u, const PlaneVote& v, const PlaneVote& w,
                          VotedPlane& plane) {
  const float spread = (v.x - u.x) * (w.y - u.y) - (w.x - u.x) * (v.y - u.y);
  if (std::abs(spread) < 100) return false;
  const float z1 = v.disparity - u.disparity, z2 = w.disparity - u.disparity;
  plane.a = (z1 * (w.y - u.y) - z2 * (v.y - u.y)) / spread;
  plane.b = ((v.x - u.x) * z2 - (w.x - u.x) * z1) / spread;
  plane.c = u.disparity - plane.a * u.x - plane.b * u.y;
  return std::abs(plane.a) <= 0.5F && std::abs(plane.b) <= 1;
}

/// The best of 40 planes, the first 10 of which are level.
inline VotedPlane voted_plane(const std::vector<PlaneVote>& votes) {
  VotedPlane best;
  int most = -1;
  std::uint32_t state = 20;
  const auto any = [&]() -> const PlaneVote& {
    state = state * 1664525 + 1013904223;
    return votes[std::uint64_t{state} * votes.size() >> 32];
  };
  for (int trial = 0; trial < 40; ++trial) {
    const PlaneVote& u = any();
    const PlaneVote& v = any();
    const PlaneVote& w = any();
    VotedPlane plane = {0, 0, u.disparity};
    if (trial >= 10 && !plane_through(u, v, w, plane)) continue;
    if (agreeing(votes, plane) <= most) continue;
    most = agreeing(votes, plane);
    best = plane;
  }
  return best;
}

/// Weighted least squares of the votes that agree; a slope of 1 costs as much as 5 px of each vote.
inline VotedPlane least_squares(const std::vector<PlaneVote>& votes, const VotedPlane& plane) {
  double w = 0, x = 0, y = 0, d = 0, xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
  for (const PlaneVote& vote : votes) {
    if (!plane.fits(vote)) continue;
    const double weight = vote.weight, vx = vote.x, vy = vote.y, vd = vote.disparity;
    w += weight;
    x += weight * vx;
    y += weight * vy;
    d += weight * vd;
    xx += weight * vx * vx;
    xy += weight * vx * vy;
    yy += weight * vy * vy;
    xd += weight * vx * vd;
    yd += weight * vy * vd;
  }
  if (w == 0) return plane;
  xx += 25 * w - x * x / w;
  yy += 25 * w - y * y / w;
  xy -= x * y / w;
  xd -= x * d / w;
  yd -= y * d / w;
  const double det = xx * yy - xy * xy;
  const double a = (xd * yy - yd * xy) / det, b = (yd * xx - xd * xy) / det;
  return {static_cast<float>(a), static_cast<float>(b),
          static_cast<float>((d - a * x - b * y) / w)};
}

/// The disparities of a plane, limited.
struct AcceptedPlane {
  VotedPlane plane;
  float least = 1e9F;
  float most = -1e9F;

  float at(int x, int y) const {
    const float disparity = plane.at(static_cast<float>(x), static_cast<float>(y));
    return std::min(std::max(disparity, least), most);
  }
};

/// The plane on which half of the votes of an area agree, if there is one.
inline std::optional<AcceptedPlane> accepted_plane(const Pixels& area, int scale,
                                                   const ConfidentMap& in) {
  const std::vector<PlaneVote> votes = plane_votes(area, scale, in);
  if (votes.empty()) return {};
  AcceptedPlane accepted = {voted_plane(votes)};
  for (int i = 0; i < 2; ++i) accepted.plane = least_squares(votes, accepted.plane);
  long all = 0;
  for (const PlaneVote& vote : votes) {
    all += vote.weight;
    if (!accepted.plane.fits(vote)) continue;
    accepted.least = std::min(accepted.least, vote.disparity - 4);
    accepted.most = std::max(accepted.most, vote.disparity + 4);
  }
  if (2L * agreeing(votes, accepted.plane) < all) return {};
  return accepted;
}

/// Calls body(x, y, disparity) for the pixels of all flat areas that have a plane.
template <typename Body>
void for_each_flat_pixel(const GrayPlane& left, int scale, float noise, const ConfidentMap& in,
                         Body&& body) {
  const DisparityPlane sums = reduced_sums(left, scale);
  if (sums.pixels.empty()) return;
  const int width = in.map.width, height = in.map.height;
  for (const Pixels& area : flat_areas(sums, scale, flat_step(sums, scale, noise))) {
    const std::optional<AcceptedPlane> plane = accepted_plane(area, scale, in);
    if (!plane) continue;
    for (const auto& pixel : area) {
      const int first_x = scale * pixel.first, first_y = scale * pixel.second;
      // The last pixel of a reduced row or column stands for the rest of the row or column.
      const int end_x = pixel.first == sums.width - 1 ? width : first_x + scale;
      const int end_y = pixel.second == sums.height - 1 ? height : first_y + scale;
      for (int y = first_y; y < end_y; ++y) {
        for (int x = first_x; x < end_x; ++x) body(x, y, plane->at(x, y));
      }
    }
  }
}

/// Gives the doubted pixels of the left view's flat areas the planes of the believed ones, and
/// marks them in `replaced`.
inline ConfidentMap complete_flat_areas(const GrayPlane& left, float noise, const ConfidentMap& in,
                                        GrayPlane& replaced) {
  ConfidentMap out = in;
  replaced = GrayPlane(in.map.width, in.map.height);
  for_each_flat_pixel(left, 2, noise, in, [&](int x, int y, float disparity) {
    if (in.confidence(x, y) >= 100) return;
    out.map(x, y) = std::max(1, static_cast<int>(std::lround(disparity * 256)));
    replaced(x, y) = 1;
  });
  return out;
}

/// What a disparity gains that agrees with the plane of its area.
inline int plane_bonus(float noise, int grid_level) {
  if (grid_level > 1 || noise >= 3) return 0;
  return noise <= 1 ? 20 : static_cast<int>(10 * (3 - noise));
}

/// Raises the confidence of the disparities in flat areas that agree with the areas' planes, and
/// lowers that of those that contradict them, down to `least`; what has less is left alone.
inline ConfidentMap check_flat_areas(const GrayPlane& left, int scale, int least, float noise,
                                     int grid_level, const ConfidentMap& in) {
  ConfidentMap out = in;
  for_each_flat_pixel(left, scale, noise, in, [&](int x, int y, float disparity) {
    if (in.confidence(x, y) < least) return;
    const float found = static_cast<float>(in.map(x, y)) / 256;
    const float distance = std::abs(found - disparity);
    int rated = in.confidence(x, y);
    if (distance <= std::max(1.5F, 0.02F * found)) rated += plane_bonus(noise, grid_level);
    if (distance > std::max(3.0F, 0.06F * found)) rated -= 60;
    out.confidence(x, y) = static_cast<std::uint8_t>(std::clamp(rated, least, 255));
  });
  return out;
}

}  // namespace mtstereo::reference
