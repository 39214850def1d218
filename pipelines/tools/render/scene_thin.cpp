// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tools/render/scene.hpp"

namespace mtstereo::render {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

// Positions and lengths are in px of an image that is 640 px wide; the camera sees the same
// image in every size.
constexpr double kWidth = 640, kHeight = 384, kFocal = 0.85 * kWidth;
constexpr double kBaseline = 0.1;
constexpr int kThings = 8;

double distance_at(double disparity) { return kFocal * kBaseline / disparity; }

/// A place in the image, as seen from the left camera.
struct Place {
  double x, y, disparity;

  double meters(double px) const { return px * distance_at(disparity) / kFocal; }
  Vector3d point() const {
    return {meters(x - kWidth / 2), meters(y - kHeight / 2), distance_at(disparity)};
  }
};

double either(SceneBuilder& b) { return b.random(0, 1) < 0.5 ? -1 : 1; }

// The background: grain at every scale of the image, on a plane that turns away to one side.
void add_background(SceneBuilder& b) {
  Texture t;
  const double z = distance_at(b.random(7, 11));
  t.mean = 0.5, t.noise_contrast = b.random(0.12, 0.3), t.noise_size = 0.1 * z, t.octaves = 7;
  t.persistence = 0.7;
  b.rectangle({0, 0, z}, 10 * z, 10 * z, t, b.random(-0.55, 0.55));
}

// Brighter or darker than the wall; of one gray value in half of the cases, with grain in the
// others.
Texture paint(SceneBuilder& b, const Place& place) {
  Texture t;
  t.mean = 0.5 + either(b) * b.random(0.1, 0.4);
  t.noise_contrast = b.random(0, 1) < 0.5 ? 0 : b.random(0.15, 0.4);
  t.noise_size = place.meters(b.random(6, 24)), t.octaves = 4;
  return t;
}

// A flat bar, upright but for its lean to the right [rad].
Object& bar(SceneBuilder& b, const Place& middle, double width, double length, double lean,
            const Texture& texture) {
  Object& o =
      b.rectangle(middle.point(), middle.meters(width / 2), middle.meters(length / 2), texture);
  o.pose.rotate(AngleAxisd(lean, Vector3d::UnitZ()));
  return o;
}

/// Where the i-th of the structures is: side by side, or one below the other.
Place place_of(SceneBuilder& b, int i, bool side_by_side) {
  const double along = (i + b.random(0.25, 0.75)) / kThings;
  const double x = side_by_side ? 40 + 580 * along : b.random(260, 400);
  const double y = side_by_side ? b.random(0.4, 0.6) * kHeight : kHeight * along;
  return {x, y, b.random(17, 52)};
}

void add_bar(SceneBuilder& b, ThinKind kind, double width, int i) {
  const bool upright = kind == ThinKind::kPosts || kind == ThinKind::kLeaning;
  const Place place = place_of(b, i, upright);
  const double length = upright ? b.random(150, 320) : b.random(250, 480);
  double slope = 0;
  if (kind == ThinKind::kLeaning) slope = either(b) * b.random(0.2, 0.6);
  if (kind == ThinKind::kWires) slope = either(b) * b.random(0.06, 0.2);
  const double lean = (upright ? 0 : kQuarterTurn) - std::atan(slope);
  // The width along a row, or along a column, is the given one.
  bar(b, place, width * std::cos(std::atan(slope)), length, lean, paint(b, place));
}

void add_fence(SceneBuilder& b, double width, int i) {
  const double middle = 150 + 320 * i;
  const Place place{middle, b.random(170, 210), b.random(17, 40)};
  Object& o = b.rectangle(place.point(), place.meters(120), place.meters(b.random(70, 120)),
                          paint(b, place));
  o.cutout = Cutout::kBars;
  o.cutout_period = place.meters(3 * width), o.cutout_solid = 1.0 / 3;
}

// A stem in pieces that turn to and fro, with a leaf on some of them.
void add_stem(SceneBuilder& b, double width, int i) {
  constexpr double kPiece = 30;
  Place place = place_of(b, i, true);
  place.y = b.random(0.75, 0.9) * kHeight;
  const Texture texture = paint(b, place);
  double lean = b.random(-0.25, 0.25);
  for (int k = 0; k < 8; ++k) {
    bar(b, place, width, kPiece + width, lean, texture);
    lean += b.random(-0.2, 0.2);
    place.x += kPiece * std::sin(lean), place.y -= kPiece * std::cos(lean);
    if (b.random(0, 1) > 0.3) continue;
    Object& leaf = bar(b, place, 10, 30, b.random(0.6, 1.2) * either(b), texture);
    leaf.cutout = Cutout::kLeaf;
    std::swap(leaf.size.x(), leaf.size.y());
    leaf.pose.rotate(AngleAxisd(kQuarterTurn, Vector3d::UnitZ()));
  }
}

}  // namespace

Scene make_thin(const Thin& thin, std::uint32_t seed) {
  if (!(thin.width >= 0.5 && thin.width <= 20)) {
    throw std::invalid_argument("the width must be 0.5 to 20 px");
  }
  SceneBuilder b("thin", hash(seed, static_cast<std::uint32_t>(thin.kind), 0x7417u));
  b.scene().baseline = kBaseline;
  b.scene().ambient = 0.7;
  add_background(b);
  const int count = thin.kind == ThinKind::kFence ? 2 : kThings;
  for (int i = 0; i < count; ++i) {
    if (thin.kind == ThinKind::kFence) {
      add_fence(b, thin.width, i);
    } else if (thin.kind == ThinKind::kStems) {
      add_stem(b, thin.width, i);
    } else {
      add_bar(b, thin.kind, thin.width, i);
    }
  }
  return b.scene();
}

}  // namespace mtstereo::render
