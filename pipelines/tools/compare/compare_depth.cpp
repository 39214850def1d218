// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/compare/compare_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "lib/images/images.hpp"
#include "tools/compare/frame_files.hpp"
#include "tools/eval/pfm.hpp"

namespace mtstereo::apps {
namespace {

namespace fs = std::filesystem;

/// The pixels whose true depth is in one range.
struct Range {
  double from, to;            // [m]
  std::uint64_t known = 0;    // pixels with a true depth
  std::vector<float> errors;  // of those with a depth, relative to the true one
};

cv::Mat read_depth(const fs::path& file) {
  const cv::Mat depth = images::read(file, cv::IMREAD_UNCHANGED);
  if (depth.type() != CV_16UC1) {
    throw std::runtime_error(file.string() + ": is not a gray PNG image with 16 bits");
  }
  return depth;
}

void add_frame(const cv::Mat& depth, const cv::Mat& truth, std::array<Range, 5>& ranges) {
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double exact = truth.at<float>(y, x);
      if (!std::isfinite(exact) || exact <= 0) continue;
      for (Range& range : ranges) {
        if (exact < range.from || exact >= range.to) continue;
        ++range.known;
        const double found = depth.at<std::uint16_t>(y, x) / 1000.0;
        if (found > 0) range.errors.push_back(static_cast<float>(std::abs(found / exact - 1)));
      }
    }
  }
}

/// The error that this share of the pixels does not exceed [%].
double quantile(std::vector<float>& errors, double share) {
  const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), errors.begin() + index, errors.end());
  return 100.0 * errors[static_cast<std::size_t>(index)];
}

void print(Range& range) {
  if (range.known == 0) return;
  const double density =
      100.0 * static_cast<double>(range.errors.size()) / static_cast<double>(range.known);
  std::printf("%4.0f .. %-4.0f %10.1f", range.from, range.to, density);
  if (range.errors.empty()) {
    std::printf("\n");
  } else {
    std::printf(" %11.2f %11.2f\n", quantile(range.errors, 0.5), quantile(range.errors, 0.9));
  }
}

}  // namespace

void print_depth_errors(const fs::path& depths, const fs::path& truths) {
  const auto depth_files = by_name(depths, ".png");
  const auto truth_files = by_name(truths, ".pfm");
  std::array<Range, 5> ranges{
      Range{0, 5, 0, {}}, {5, 10, 0, {}}, {10, 20, 0, {}}, {20, 40, 0, {}}, {40, 65, 0, {}}};
  for (const auto& [name, truth_file] : truth_files) {
    const fs::path& file = partner(depth_files, depths, name);
    const cv::Mat depth = read_depth(file);
    const cv::Mat truth = eval::read_pfm(truth_file);
    if (depth.size() != truth.size()) {
      throw std::runtime_error(file.string() + ": has another size than " + truth_file.string());
    }
    add_frame(depth, truth, ranges);
  }
  std::printf("%-12s %10s %11s %11s\n", "depth m", "density %", "median %", "90 % below");
  for (Range& range : ranges) print(range);
}

}  // namespace mtstereo::apps
