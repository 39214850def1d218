// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/flat_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/ramp.hpp"

namespace mtstereo {
namespace {

constexpr float kOne = kDisparityOne;

/// Three votes with a smaller area between them, doubled, are nearly in a line [px^2].
constexpr float kLeastSpread = 100;

/// Keeps slopes small, so that small areas stay level [px^2], and the matrix regular.
constexpr double kSlopeWeight = 25;

/// Numbers that look random, the same on every machine.
class Sequence {
 public:
  /// 0 .. count - 1.
  int below(int count) {
    state_ = state_ * 1664525 + 1013904223;
    return static_cast<int>(std::uint64_t{state_} * static_cast<std::uint32_t>(count) >> 32);
  }

 private:
  std::uint32_t state_ = 20;
};

/// Calls body(x, y) for the pixels of an area, with their first column and row in the map.
template <typename Body>
void for_each_pixel(const FlatAreas& areas, int area, Body&& body) {
  for (std::uint32_t i = areas.first[area]; i < areas.first[area + 1]; ++i) {
    const FlatSpan span = areas.spans[i];
    for (int x = span.begin; x < span.end; ++x) body(areas.scale * x, areas.scale * span.y);
  }
}

/// Takes the votes of an area; none if no pixel is doubted or too few vote.
void take_votes(const FlatAreas& areas, int area, const Image<std::int32_t>& map,
                const Image<std::uint8_t>& confidence, PlaneVotes& votes) {
  votes.count = 0;
  std::int64_t voters = 0;
  bool doubted = false;
  for_each_pixel(areas, area, [&](int x, int y) {
    voters += confidence.row(y)[x] > kLeastVoter;
    doubted |= confidence.row(y)[x] < kDoubted;
  });
  if (!doubted || voters < kFewestVotes) return;
  const std::int64_t taken = std::min<std::int64_t>(voters, kMostVotes);
  std::int64_t voter = 0, next = 0;
  for_each_pixel(areas, area, [&](int x, int y) {
    const int weight = confidence.row(y)[x] - kLeastVoter;
    if (weight <= 0 || voter++ != next) return;
    const float disparity = static_cast<float>(map.row(y)[x]) / kOne;
    const int vote = votes.count++;
    votes.x[vote] = static_cast<float>(x);
    votes.y[vote] = static_cast<float>(y);
    votes.disparity[vote] = disparity;
    votes.tolerance[vote] = std::max(1.0F, kVoteTolerance * disparity);
    votes.weight[vote] = weight;
    next = votes.count * voters / taken;
  });
}

bool agrees(const PlaneVotes& votes, int i, const FlatPlane& plane) {
  const float distance = plane.at(votes.x[i], votes.y[i]) - votes.disparity[i];
  return std::abs(distance) <= votes.tolerance[i];
}

/// The weight of the votes that agree; compilers vectorize the loop.
std::int32_t agreeing_weight(const PlaneVotes& votes, const FlatPlane& plane) {
  const float* __restrict__ x = votes.x.data();
  const float* __restrict__ y = votes.y.data();
  const float* __restrict__ disparity = votes.disparity.data();
  const float* __restrict__ tolerance = votes.tolerance.data();
  const std::int32_t* __restrict__ weight = votes.weight.data();
  std::int32_t sum = 0;
  for (int i = 0; i < votes.count; ++i) {
    const float distance = plane.at(x[i], y[i]) - disparity[i];
    sum += std::abs(distance) <= tolerance[i] ? weight[i] : 0;
  }
  return sum;
}

/// The plane through the votes i, j and k; false if they are nearly in a line or it is too steep.
bool propose(const PlaneVotes& votes, int i, int j, int k, FlatPlane& plane) {
  const float x1 = votes.x[j] - votes.x[i], y1 = votes.y[j] - votes.y[i];
  const float x2 = votes.x[k] - votes.x[i], y2 = votes.y[k] - votes.y[i];
  const float spread = x1 * y2 - x2 * y1;
  if (std::abs(spread) < kLeastSpread) return false;
  const float z1 = votes.disparity[j] - votes.disparity[i];
  const float z2 = votes.disparity[k] - votes.disparity[i];
  plane.slope_x = (z1 * y2 - z2 * y1) / spread;
  plane.slope_y = (x1 * z2 - x2 * z1) / spread;
  plane.at_origin = votes.disparity[i] - plane.slope_x * votes.x[i] - plane.slope_y * votes.y[i];
  return std::abs(plane.slope_x) <= kMostSlopeX && std::abs(plane.slope_y) <= kMostSlopeY;
}

/// The one of the planes through random votes with which most weight agrees.
FlatPlane best_proposal(const PlaneVotes& votes) {
  Sequence random;
  FlatPlane best;
  std::int32_t most = -1;
  for (int trial = 0; trial < kPlaneTrials; ++trial) {
    const int i = random.below(votes.count), j = random.below(votes.count);
    const int k = random.below(votes.count);
    FlatPlane plane;
    plane.at_origin = votes.disparity[i];
    if (trial >= kLevelTrials && !propose(votes, i, j, k, plane)) continue;
    const std::int32_t weight = agreeing_weight(votes, plane);
    if (weight <= most) continue;
    most = weight;
    best = plane;
  }
  return best;
}

/// Fits a plane to the votes that agree with it, by least squares.
void adjust(const PlaneVotes& votes, FlatPlane& plane) {
  double weight = 0, x = 0, y = 0, d = 0, xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
  for (int i = 0; i < votes.count; ++i) {
    if (!agrees(votes, i, plane)) continue;
    const double w = votes.weight[i];
    const double vote_x = votes.x[i], vote_y = votes.y[i], disparity = votes.disparity[i];
    weight += w;
    x += w * vote_x;
    y += w * vote_y;
    d += w * disparity;
    xx += w * vote_x * vote_x;
    xy += w * vote_x * vote_y;
    yy += w * vote_y * vote_y;
    xd += w * vote_x * disparity;
    yd += w * vote_y * disparity;
  }
  if (weight == 0) return;
  // Around the mean the offset does not depend on the slopes.
  xx += kSlopeWeight * weight - x * x / weight;
  yy += kSlopeWeight * weight - y * y / weight;
  xy -= x * y / weight;
  xd -= x * d / weight;
  yd -= y * d / weight;
  const double determinant = xx * yy - xy * xy;
  const double slope_x = (xd * yy - yd * xy) / determinant;
  const double slope_y = (yd * xx - xd * xy) / determinant;
  plane.slope_x = static_cast<float>(slope_x);
  plane.slope_y = static_cast<float>(slope_y);
  plane.at_origin = static_cast<float>((d - slope_x * x - slope_y * y) / weight);
}

/// Finds the range of the plane, and whether it is accepted.
void judge(const PlaneVotes& votes, FlatPlane& plane) {
  std::int64_t all = 0, agreeing = 0;
  for (int i = 0; i < votes.count; ++i) {
    all += votes.weight[i];
    if (!agrees(votes, i, plane)) continue;
    const float disparity = votes.disparity[i];
    plane.least = agreeing == 0 ? disparity : std::min(plane.least, disparity);
    plane.most = agreeing == 0 ? disparity : std::max(plane.most, disparity);
    agreeing += votes.weight[i];
  }
  plane.least -= kBeyondVotes;
  plane.most += kBeyondVotes;
  plane.accepted = 2 * agreeing >= all;
}

/// Calls body(x, disparity) for the pixels of row y in areas with an accepted plane, with what the
/// plane has there [px].
template <typename Body>
void for_each_plane(const FlatAreas& areas, const Buffer<FlatPlane>& planes, int y, int width,
                    Body&& body) {
  if (areas.count == 0) return;
  const SpeckleRuns& runs = areas.runs;
  const int row = std::min(y / areas.scale, runs.height - 1);
  for (std::uint32_t run = runs.first[row]; run < runs.last[row]; ++run) {
    const std::uint32_t number = areas.area[run];
    if (number == 0 || !planes[number - 1].accepted) continue;
    const FlatPlane& plane = planes[number - 1];
    const int end = runs.end[run] == runs.width ? width : areas.scale * runs.end[run];
    for (int x = areas.scale * runs.begin[run]; x < end; ++x) {
      const float disparity = plane.at(static_cast<float>(x), static_cast<float>(y));
      body(x, std::clamp(disparity, plane.least, plane.most));
    }
  }
}

}  // namespace

void PlaneVotes::resize() {
  for (Buffer<float>* values : {&x, &y, &disparity, &tolerance}) values->resize(kMostVotes);
  weight.resize(kMostVotes);
}

void fit_planes(const FlatAreas& areas, int first, int last, const Image<std::int32_t>& map,
                const Image<std::uint8_t>& confidence, PlaneVotes& votes,
                Buffer<FlatPlane>& planes) {
  for (int area = first; area < last; ++area) {
    FlatPlane plane;
    take_votes(areas, area, map, confidence, votes);
    if (votes.count > 0) {
      plane = best_proposal(votes);
      for (int i = 0; i < 2; ++i) adjust(votes, plane);
      judge(votes, plane);
    }
    planes[area] = plane;
  }
}

void complete_planes(const FlatAreas& areas, const Buffer<FlatPlane>& planes, int y0, int y1,
                     const Image<std::uint8_t>& confidence, Image<std::int32_t>& map,
                     Image<std::uint8_t>& replaced) {
  for (int y = y0; y < y1; ++y) {
    std::fill_n(replaced.row(y), map.width(), std::uint8_t{0});
    for_each_plane(areas, planes, y, map.width(), [&](int x, float disparity) {
      if (confidence.row(y)[x] >= kDoubted) return;
      map.row(y)[x] = std::max(1, static_cast<int>(std::lround(disparity * kOne)));
      replaced.row(y)[x] = 1;
    });
  }
}

int plane_bonus(float noise, int grid_level) {
  if (grid_level > kMostPlaneGrid) return 0;
  return static_cast<int>(kConfirmed * ramp(kNoPlaneNoise, kFullPlaneNoise, noise));
}

void check_planes(const FlatAreas& areas, const Buffer<FlatPlane>& planes, PlaneWeight weight,
                  int y0, int y1, const Image<std::int32_t>& map, Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) {
    for_each_plane(areas, planes, y, map.width(), [&](int x, float disparity) {
      const float found = static_cast<float>(map.row(y)[x]) / kOne;
      const float distance = std::abs(disparity - found);
      std::uint8_t& rated = confidence.row(y)[x];
      if (rated < weight.least) return;
      if (distance <= std::max(kPlaneAgrees, kVoteTolerance * found)) {
        rated = static_cast<std::uint8_t>(std::min(rated + weight.bonus, 255));
      } else if (distance > std::max(kPlaneDistance, kPlaneDistanceShare * found)) {
        rated = static_cast<std::uint8_t>(std::max(rated - kContradicted, weight.least));
      }
    });
  }
}

}  // namespace mtstereo
