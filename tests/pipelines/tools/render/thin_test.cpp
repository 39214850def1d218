// SPDX-License-Identifier: LGPL-2.1-or-later
// Thin structures in front of a slanted wall.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "tools/render/raw.hpp"
#include "tools/render/render.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::render::thin_test {
namespace {

constexpr ThinKind kKinds[] = {ThinKind::kPosts, ThinKind::kLeaning, ThinKind::kRails,
                               ThinKind::kWires, ThinKind::kFence,   ThinKind::kStems};

Settings camera(int width = 640) {
  Settings s;
  s.width = width, s.height = width * 3 / 5, s.noise = 0, s.samples = 1;
  return s;
}

cv::Mat truth_of(const Scene& scene, const Settings& given) {
  const Settings settings = complete(scene, given);
  return render_truth(scene, 0, settings, rectification_of(settings)).disparity;
}

/// 255 at the structures.
cv::Mat things_of(Scene scene, const Settings& settings) {
  const cv::Mat truth = truth_of(scene, settings);
  scene.objects.resize(1);
  return truth - truth_of(scene, settings) > 1;
}

/// The widths of the runs of set pixels that lie inside of the rows.
std::vector<int> widths(const cv::Mat& mask) {
  std::vector<int> found;
  for (int y = 0; y < mask.rows; ++y) {
    int begin = -1;
    for (int x = 1; x < mask.cols; ++x) {
      const bool is = mask.at<std::uint8_t>(y, x) != 0, was = mask.at<std::uint8_t>(y, x - 1) != 0;
      if (is && !was) begin = x;
      if (!is && was && begin >= 0) found.push_back(x - begin);
    }
  }
  return found;
}

double mean_of(const std::vector<int>& values) {
  double sum = 0;
  for (const int value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(Thin, BarsHaveTheGivenWidthAlongARow) {
  for (const double width : {2.0, 3.0, 8.0}) {
    for (const ThinKind kind : {ThinKind::kPosts, ThinKind::kLeaning}) {
      const std::vector<int> found = widths(things_of(make_thin({kind, width}, 1), camera()));
      ASSERT_GT(found.size(), 500u);
      EXPECT_NEAR(mean_of(found), width, 0.5);
    }
  }
}

TEST(Thin, LevelBarsHaveTheGivenWidthAlongAColumn) {
  for (const ThinKind kind : {ThinKind::kRails, ThinKind::kWires}) {
    const std::vector<int> found = widths(things_of(make_thin({kind, 3}, 2), camera()).t());
    ASSERT_GT(found.size(), 500u);
    EXPECT_NEAR(mean_of(found), 3, 0.5);
  }
}

TEST(Thin, ThingsAreNearerThanTheWallAndDifferFromIt) {
  for (const ThinKind kind : kKinds) {
    Scene scene = make_thin({kind, 4}, 3);
    const cv::Mat truth = truth_of(scene, camera());
    double least = 0, most = 0;
    cv::minMaxLoc(truth, &least, &most);
    EXPECT_GT(most, 15);
    EXPECT_LT(most, 64);
    scene.objects.resize(1);
    cv::minMaxLoc(truth_of(scene, camera()), &least, &most);
    EXPECT_GT(least, 1);
    EXPECT_LT(most, 17);
  }
}

TEST(Thin, LooksTheSameInEverySize) {
  const Scene scene = make_thin({ThinKind::kPosts, 8}, 1);
  const double large = mean_of(widths(things_of(scene, camera(640))));
  EXPECT_NEAR(mean_of(widths(things_of(scene, camera(320)))), large / 2, 0.5);
}

TEST(Thin, RefusesInvalidWidths) {
  EXPECT_THROW(make_thin({ThinKind::kPosts, 0}, 1), std::invalid_argument);
  EXPECT_THROW(make_thin({ThinKind::kPosts, 21}, 1), std::invalid_argument);
  EXPECT_THROW(make_thin({ThinKind::kPosts, std::nan("")}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace mtstereo::render::thin_test
