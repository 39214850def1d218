// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/sharpness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "mtstereo/alignment.hpp"

namespace mtstereo {
namespace {

constexpr int kResponseBlock = 8;  // side of the blocks in which noise is measured [px]
constexpr int kBlockStep = 16;     // from block to block [px]

/// Mean absolute response of the difference of two Laplacians in a block, or -1 if the block says
/// nothing about noise: it is constant, or clipped.
float block_response(GrayView view, int x0, int y0) {
  int sum = 0, least = 255, most = 0;
  for (int y = y0; y < y0 + kResponseBlock; ++y) {
    const std::uint8_t* above = view.row(y - 1);
    const std::uint8_t* here = view.row(y);
    const std::uint8_t* below = view.row(y + 1);
    for (int x = x0; x < x0 + kResponseBlock; ++x) {
      sum += std::abs(above[x - 1] - 2 * above[x] + above[x + 1] - 2 * here[x - 1] + 4 * here[x] -
                      2 * here[x + 1] + below[x - 1] - 2 * below[x] + below[x + 1]);
      least = std::min<int>(least, here[x]);
      most = std::max<int>(most, here[x]);
    }
  }
  if (least == most || least == 0 || most == 255) return -1;
  return static_cast<float>(sum) / (kResponseBlock * kResponseBlock);
}

/// Sums over the patches: squared differences of adjacent pixels, and squared differences from the
/// mean of the patch.
struct Contrast {
  double gradients = 0;
  double variance = 0;
  double pixels = 0;
};

void add_patch(GrayView view, int x0, int y0, Contrast& contrast) {
  std::int64_t gradients = 0, sum = 0, squares = 0;
  for (int y = y0; y < y0 + kSharpnessPatch; ++y) {
    const std::uint8_t* here = view.row(y);
    const std::uint8_t* below = view.row(y + 1);
    int row_gradients = 0, row_sum = 0, row_squares = 0;
    for (int x = x0; x < x0 + kSharpnessPatch; ++x) {
      const int dx = here[x + 1] - here[x], dy = below[x] - here[x];
      row_gradients += dx * dx + dy * dy;
      row_sum += here[x];
      row_squares += here[x] * here[x];
    }
    gradients += row_gradients;
    sum += row_sum;
    squares += row_squares;
  }
  constexpr double kPixels = kSharpnessPatch * kSharpnessPatch;
  const auto total = static_cast<double>(sum);
  contrast.gradients += static_cast<double>(gradients);
  contrast.variance += static_cast<double>(squares) - total * total / kPixels;
  contrast.pixels += kPixels;
}

/// The patches that lie inside both views.
template <typename Body>
void for_each_patch(GrayView view, std::span<const Match> matches, Body&& body) {
  constexpr int kHalf = kSharpnessPatch / 2;
  const auto inside = [&](int x, int y) {
    return x >= kHalf && y >= kHalf && x + kHalf < view.width && y + kHalf < view.height;
  };
  for (const Match& match : matches) {
    const int xl = static_cast<int>(match.x_left), yl = static_cast<int>(match.y_left);
    const int xr = static_cast<int>(std::lround(match.x_right));
    const int yr = static_cast<int>(std::lround(match.y_left + match.rows));
    if (inside(xl, yl) && inside(xr, yr)) body(xl - kHalf, yl - kHalf, xr - kHalf, yr - kHalf);
  }
}

/// The sharpness of one view at its patches: the root of gradients over variance, both without the
/// share of the noise; 0 if nothing remains.
double sharpness_of(GrayView view, bool is_left, std::span<const Match> matches,
                    SharpnessScratch& scratch) {
  Contrast contrast;
  for_each_patch(view, matches, [&](int xl, int yl, int xr, int yr) {
    add_patch(view, is_left ? xl : xr, is_left ? yl : yr, contrast);
  });
  const double noise = noise_of(view, scratch);
  const double square = noise * noise * contrast.pixels;
  // Each of the two differences contains the noise of two pixels.
  const double gradients = contrast.gradients - 4 * square, variance = contrast.variance - square;
  constexpr double kLeastRest = 0.1;
  if (gradients <= kLeastRest * contrast.gradients || variance <= kLeastRest * contrast.variance) {
    return 0;
  }
  return std::sqrt(gradients / variance);
}

/// The sigma of the blur after which a view has this sharpness.
float blur_to(GrayView view, bool is_left, double sharpness, std::span<const Match> matches,
              SharpnessScratch& scratch) {
  scratch.blurred.resize(view.width, view.height);
  float low = 0, high = kLargestBlur;
  constexpr int kSteps = 7;
  for (int step = 0; step < kSteps; ++step) {
    const float sigma = (low + high) / 2;
    blur_rows(view, gaussian_kernel(sigma), 0, view.height, scratch.blur, scratch.blurred);
    const bool sharper =
        sharpness_of(scratch.blurred.view(), is_left, matches, scratch) > sharpness;
    (sharper ? low : high) = sigma;
  }
  return (low + high) / 2;
}

}  // namespace

double noise_of(GrayView view, SharpnessScratch& scratch) {
  const int columns = (view.width - 2 - kResponseBlock) / kBlockStep + 1;
  const int rows = (view.height - 2 - kResponseBlock) / kBlockStep + 1;
  if (view.width < kResponseBlock + 2 || view.height < kResponseBlock + 2) return 0;
  scratch.noise.resize(static_cast<std::size_t>(columns) * rows);
  int count = 0;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const float response = block_response(view, 1 + i * kBlockStep, 1 + j * kBlockStep);
      if (response >= 0) scratch.noise[count++] = response;
    }
  }
  constexpr int kFewestBlocks = 20;
  if (count < kFewestBlocks) return 0;
  float* const tenth = scratch.noise.data() + count / 10;
  std::nth_element(scratch.noise.data(), tenth, scratch.noise.data() + count);
  constexpr double kGain = 6;  // root of the sum of the squared weights of the operator
  return std::sqrt(std::numbers::pi / 2) * *tenth / kGain;
}

void spread_patches(int width, int height, std::vector<Match>& places) {
  constexpr int kColumns = 24, kRows = 16;
  places.clear();
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      const int x = width * (2 * i + 1) / (2 * kColumns), y = height * (2 * j + 1) / (2 * kRows);
      places.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(x), 0, 0});
    }
  }
}

SharpnessDifference compare_sharpness(GrayView left, GrayView right, std::span<const Match> matches,
                                      SharpnessScratch& scratch) {
  SharpnessDifference difference;
  int patches = 0;
  for_each_patch(left, matches, [&](int, int, int, int) { ++patches; });
  if (patches < kFewestPatches) return difference;
  const double of_left = sharpness_of(left, true, matches, scratch);
  const double of_right = sharpness_of(right, false, matches, scratch);
  if (of_left <= 0 || of_right <= 0) return difference;
  difference.ratio = of_left / of_right;
  if (difference.ratio > kSharpnessLimit) {
    difference.left_blur = blur_to(left, true, of_right, matches, scratch);
  } else if (difference.ratio < 1 / kSharpnessLimit) {
    difference.right_blur = blur_to(right, false, of_left, matches, scratch);
  }
  return difference;
}

}  // namespace mtstereo
