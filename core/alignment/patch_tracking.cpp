// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/patch_tracking.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace mtstereo {
namespace {

constexpr int kHalf = kTrackedPatch / 2;
constexpr int kPixels = kTrackedPatch * kTrackedPatch;
constexpr int kIterations = 12;
constexpr float kConverged = 0.01F;  // [px]

using Patch = std::array<float, kPixels>;

void subtract_mean(Patch& patch) {
  float sum = 0;
  for (const float value : patch) sum += value;
  for (float& value : patch) value -= sum / kPixels;
}

/// The left patch: gray values and gradients [gray values per px], each without its mean.
struct Template {
  Patch gray, gradient_x, gradient_y;
};

Template template_at(GrayView view, int x, int y) {
  Template patch;
  for (int j = 0, i = 0; j < kTrackedPatch; ++j) {
    const std::uint8_t* above = view.row(y + j - kHalf - 1) + x - kHalf;
    const std::uint8_t* here = view.row(y + j - kHalf) + x - kHalf;
    const std::uint8_t* below = view.row(y + j - kHalf + 1) + x - kHalf;
    for (int k = 0; k < kTrackedPatch; ++k, ++i) {
      patch.gray[i] = here[k];
      patch.gradient_x[i] = static_cast<float>(here[k + 1] - here[k - 1]) / 2;
      patch.gradient_y[i] = static_cast<float>(below[k] - above[k]) / 2;
    }
  }
  subtract_mean(patch.gray);
  subtract_mean(patch.gradient_x);
  subtract_mean(patch.gradient_y);
  return patch;
}

/// The patch around a position, interpolated linearly. The position must be inside.
void interpolate(GrayView view, float x, float y, Patch& patch) {
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
  const float w00 = (1 - fx) * (1 - fy), w10 = fx * (1 - fy), w01 = (1 - fx) * fy, w11 = fx * fy;
  for (int j = 0, i = 0; j < kTrackedPatch; ++j) {
    const std::uint8_t* upper = view.row(top + j - kHalf) + left - kHalf;
    const std::uint8_t* lower = view.row(top + j - kHalf + 1) + left - kHalf;
    for (int k = 0; k < kTrackedPatch; ++k, ++i) {
      patch[i] = w00 * static_cast<float>(upper[k]) + w10 * static_cast<float>(upper[k + 1]) +
                 w01 * static_cast<float>(lower[k]) + w11 * static_cast<float>(lower[k + 1]);
    }
  }
}

float dot(const Patch& a, const Patch& b) {
  // Eight sums, so that compilers vectorize the loop without changing the order of additions.
  std::array<float, 8> sums{};
  constexpr int kWhole = kPixels / 8 * 8;
  for (int i = 0; i < kWhole; i += 8) {
    for (int k = 0; k < 8; ++k) sums[k] += a[i + k] * b[i + k];
  }
  for (int i = kWhole; i < kPixels; ++i) sums[0] += a[i] * b[i];
  float sum = 0;
  for (const float part : sums) sum += part;
  return sum;
}

bool is_inside(GrayView view, float x, float y) {
  constexpr float kMargin = kHalf + 2;
  return x >= kMargin && y >= kMargin && x < static_cast<float>(view.width) - kMargin &&
         y < static_cast<float>(view.height) - kMargin;
}

/// The right patch as a linear combination of the left patch, its gradients and a constant.
struct Regression {
  Eigen::Vector3f weights;  ///< of the gray values and of the gradients along x and y
  float rest;               ///< sum of the squares of what is not explained
  float total;              ///< sum of the squares of the right patch, without its mean
};

Regression regress(const Template& left, const Eigen::LDLT<Eigen::Matrix3f>& normal, Patch& right) {
  subtract_mean(right);
  const Eigen::Vector3f products(dot(left.gray, right), dot(left.gradient_x, right),
                                 dot(left.gradient_y, right));
  Regression fit;
  fit.weights = normal.solve(products);
  fit.total = dot(right, right);
  fit.rest = std::max(fit.total - fit.weights.dot(products), 0.0F);
  return fit;
}

Eigen::Matrix3f normal_matrix(const Template& patch) {
  Eigen::Matrix3f normal;
  const std::array<const Patch*, 3> columns = {&patch.gray, &patch.gradient_x, &patch.gradient_y};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k <= i; ++k) normal(i, k) = normal(k, i) = dot(*columns[i], *columns[k]);
  }
  return normal;
}

}  // namespace

std::optional<Match> track_patch(GrayView left, GrayView right, int x, int y, float x_right,
                                 float y_right, float reach) {
  if (!is_inside(left, static_cast<float>(x), static_cast<float>(y))) return {};
  const Template patch = template_at(left, x, y);
  const Eigen::LDLT<Eigen::Matrix3f> normal(normal_matrix(patch));
  // What the gray values and each gradient have of their own: without it there is no unique place.
  constexpr float kLeastSquare = 0.05F * kPixels;
  if (normal.info() != Eigen::Success || normal.vectorD().minCoeff() < kLeastSquare) return {};
  Patch other;
  float px = x_right, py = y_right;
  for (int i = 0; i < kIterations; ++i) {
    if (!is_inside(right, px, py)) return {};
    interpolate(right, px, py, other);
    const Regression fit = regress(patch, normal, other);
    // The right patch is the left one times a factor, moved by (dx, dy).
    const float factor = fit.weights[0];
    if (!(factor > 0.05F)) return {};
    const float dx = fit.weights[1] / factor, dy = fit.weights[2] / factor;
    px -= std::clamp(dx, -1.0F, 1.0F);
    py -= std::clamp(dy, -1.0F, 1.0F);
    if (!(std::abs(px - x_right) <= reach && std::abs(py - y_right) <= reach)) return {};
    if (std::abs(dx) > kConverged || std::abs(dy) > kConverged) continue;
    if (fit.rest > (1 - kLeastCorrelation * kLeastCorrelation) * fit.total) return {};
    const float noise = fit.rest / (kPixels - 4) / (factor * factor);
    const float variance = noise * normal.solve(Eigen::Vector3f::UnitZ())[2];
    return Match{static_cast<float>(x), static_cast<float>(y), px, py - static_cast<float>(y),
                 std::max(variance, kSmallestDeviation * kSmallestDeviation)};
  }
  return {};
}

}  // namespace mtstereo
