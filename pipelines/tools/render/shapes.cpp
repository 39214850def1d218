// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace mtstereo::render {
namespace {

bool solid(const Object& o, double u, double v) {
  const auto in_bar = [&o](double x) {
    const double p = x / o.cutout_period;
    return p - std::floor(p) < o.cutout_solid;
  };
  switch (o.cutout) {
    case Cutout::kNone:
      return true;
    case Cutout::kBars:
      return in_bar(u) || std::abs(std::abs(v) - 0.8 * o.size.y()) < 0.06 * o.size.y();
    case Cutout::kMesh:
      return in_bar(u) || in_bar(v);
    case Cutout::kLeaf: {
      const double along = u / o.size.x();
      return std::abs(v) <= o.size.y() * (1 - along * along);
    }
  }
  return true;
}

std::optional<Hit> hit_rectangle(const Object& o, const Eigen::Vector3d& origin,
                                 const Eigen::Vector3d& d, double near) {
  if (d.z() == 0) return std::nullopt;
  const double t = -origin.z() / d.z();
  if (!(t > near)) return std::nullopt;
  const double u = origin.x() + t * d.x(), v = origin.y() + t * d.y();
  if (std::abs(u) > o.size.x() || std::abs(v) > o.size.y() || !solid(o, u, v)) return std::nullopt;
  return Hit{t, Eigen::Vector3d::UnitZ(), u, v};
}

// Texture coordinates of a point on a side whose normal is along `axis`. The offset gives opposite
// sides different textures.
std::pair<double, double> side_coordinates(const Eigen::Vector3d& p, int axis) {
  const double offset = 7.3 * (axis + 1) + (p[axis] < 0 ? 31.7 : 0.0);
  switch (axis) {
    case 0:
      return {p.z() + offset, p.y()};
    case 1:
      return {p.x() + offset, p.z()};
    default:
      return {p.x() + offset, p.y()};
  }
}

std::optional<Hit> hit_box(const Object& o, const Eigen::Vector3d& origin, const Eigen::Vector3d& d,
                           double near) {
  double t_in = -std::numeric_limits<double>::infinity();
  double t_out = std::numeric_limits<double>::infinity();
  int axis_in = 0, axis_out = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) {
      if (std::abs(origin[axis]) > o.size[axis]) return std::nullopt;
      continue;
    }
    const double inverse = 1 / d[axis];
    double a = (-o.size[axis] - origin[axis]) * inverse;
    double b = (o.size[axis] - origin[axis]) * inverse;
    if (a > b) std::swap(a, b);
    if (a > t_in) t_in = a, axis_in = axis;
    if (b < t_out) t_out = b, axis_out = axis;
  }
  if (t_in > t_out) return std::nullopt;
  const bool outside = t_in > near;
  const double t = outside ? t_in : t_out;
  const int axis = outside ? axis_in : axis_out;
  if (!(t > near)) return std::nullopt;
  const Eigen::Vector3d p = origin + t * d;
  const auto [u, v] = side_coordinates(p, axis);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  normal[axis] = p[axis] < 0 ? -1 : 1;
  return Hit{t, normal, u, v};
}

// The smallest root above `near` of a t^2 + 2 b t + c = 0.
std::optional<double> first_root(double a, double b, double c, double near) {
  const double discriminant = b * b - a * c;
  if (a == 0 || discriminant < 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double first = (-b - root) / a, second = (-b + root) / a;
  if (first > near) return first;
  if (second > near) return second;
  return std::nullopt;
}

std::optional<Hit> hit_sphere(const Object& o, const Eigen::Vector3d& origin,
                              const Eigen::Vector3d& d, double near) {
  const double radius = o.size.x();
  const auto t =
      first_root(d.squaredNorm(), origin.dot(d), origin.squaredNorm() - radius * radius, near);
  if (!t) return std::nullopt;
  const Eigen::Vector3d p = origin + *t * d;
  int axis = 0;
  p.cwiseAbs().maxCoeff(&axis);
  const auto [u, v] = side_coordinates(p, axis);
  return Hit{*t, p / radius, u, v};
}

std::optional<Hit> hit_cylinder(const Object& o, const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& d, double near) {
  const double radius = o.size.x();
  const double a = d.x() * d.x() + d.z() * d.z();
  const double b = origin.x() * d.x() + origin.z() * d.z();
  const double c = origin.x() * origin.x() + origin.z() * origin.z() - radius * radius;
  auto t = first_root(a, b, c, near);
  if (t && std::abs(origin.y() + *t * d.y()) > o.size.y()) t = first_root(a, b, c, *t);
  if (!t) return std::nullopt;
  const Eigen::Vector3d p = origin + *t * d;
  if (std::abs(p.y()) > o.size.y()) return std::nullopt;
  return Hit{*t, Eigen::Vector3d(p.x() / radius, 0, p.z() / radius),
             std::atan2(p.x(), p.z()) * radius, p.y()};
}

}  // namespace

namespace {

// A time on a path: the index of a pose, and the way to the next one, 0 .. 1.
struct PathPlace {
  std::size_t index;
  double along;
};

PathPlace place_at(const Path& path, double time) {
  constexpr double kRounding = 1e-9;  // [s]
  const double period = path.rest + path.move;
  const double passed = std::max(0.0, std::floor((time + kRounding) / period));
  const auto index = static_cast<std::size_t>(passed);
  if (index + 1 >= path.poses.size()) return {path.poses.size() - 1, 0};
  const double moving = time - passed * period - path.rest;
  return {index, moving <= kRounding ? 0 : std::min(moving / path.move, 1.0)};
}

}  // namespace

Eigen::Isometry3d Path::at(double time) const {
  const auto [index, along] = place_at(*this, time);
  if (along == 0) return poses[index];
  const Eigen::Isometry3d &from = poses[index], &to = poses[index + 1];
  const double s = along * along * (3 - 2 * along);  // starts and stops softly
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate((1 - s) * from.translation() + s * to.translation());
  pose.rotate(Eigen::Quaterniond(from.linear()).slerp(s, Eigen::Quaterniond(to.linear())));
  return pose;
}

bool Path::rests_at(double time) const { return place_at(*this, time).along == 0; }

Eigen::Isometry3d Object::pose_at(double time) const {
  if (motion.path) return motion.path->at(time);
  constexpr double kTurn = 2 * std::numbers::pi;
  const double sway = std::sin(kTurn * (motion.swing_rate * time + motion.swing_phase)) -
                      std::sin(kTurn * motion.swing_phase);
  Eigen::Isometry3d moved = pose;
  moved.pretranslate(motion.velocity * time + motion.swing * sway);
  moved.rotate(Eigen::AngleAxisd(motion.spin * time, Eigen::Vector3d::UnitY()));
  return moved;
}

std::optional<Hit> intersect(const Object& object, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction, double near) {
  switch (object.shape) {
    case Shape::kRectangle:
      return hit_rectangle(object, origin, direction, near);
    case Shape::kBox:
      return hit_box(object, origin, direction, near);
    case Shape::kSphere:
      return hit_sphere(object, origin, direction, near);
    case Shape::kCylinder:
      return hit_cylinder(object, origin, direction, near);
  }
  return std::nullopt;
}

Eigen::Vector3d bounding_box(const Object& object) {
  const Eigen::Vector3d& s = object.size;
  switch (object.shape) {
    case Shape::kRectangle:
      return {s.x(), s.y(), 0};
    case Shape::kBox:
      return s;
    case Shape::kSphere:
      return Eigen::Vector3d::Constant(s.x());
    case Shape::kCylinder:
      return {s.x(), s.y(), s.x()};
  }
  return s;
}

}  // namespace mtstereo::render
