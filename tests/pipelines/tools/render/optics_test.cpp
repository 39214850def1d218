// SPDX-License-Identifier: LGPL-2.1-or-later
// Blur that grows from the center of a view to its corners.
#include "tools/render/optics.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tools/render/render.hpp"

namespace mtstereo::render::optics_test {
namespace {

// Noise has the same energy everywhere and at all frequencies.
cv::Mat noise(int width = 320, int height = 200) {
  cv::Mat image(height, width, CV_32FC1);
  cv::RNG random(1);
  random.fill(image, cv::RNG::NORMAL, 0.5, 0.1);
  return image;
}

// Energy of the high frequencies of a part of the image.
double detail(const cv::Mat& image, const cv::Rect& part) {
  cv::Mat edges;
  cv::Laplacian(image, edges, CV_32F);
  const double size = cv::norm(edges(part), cv::NORM_L2);
  return size * size / part.area();
}

constexpr int kPart = 40;

double center_detail(const cv::Mat& image) {
  return detail(image, {(image.cols - kPart) / 2, (image.rows - kPart) / 2, kPart, kPart});
}

double corner_detail(const cv::Mat& image) {
  return detail(image, {image.cols - kPart, image.rows - kPart, kPart, kPart});
}

TEST(Optics, RimShareIsZeroInTheCenterAndOneInTheCorners) {
  const cv::Size size(81, 41);
  EXPECT_EQ(rim_share(size, 40, 20), 0);
  for (const int x : {0, 80}) {
    for (const int y : {0, 40}) EXPECT_DOUBLE_EQ(rim_share(size, x, y), 1);
  }
  EXPECT_DOUBLE_EQ(rim_share(size, 60, 10), 0.25);
  EXPECT_EQ(rim_share({1, 1}, 0, 0), 0);
}

TEST(Optics, DetailFallsMoreAtTheRim) {
  const cv::Mat sharp = noise();
  const cv::Mat seen = after_lens(sharp, 0.5, 1.5);
  const double center = center_detail(seen) / center_detail(sharp);
  const double corner = corner_detail(seen) / corner_detail(sharp);
  EXPECT_LT(center, 0.5);
  EXPECT_LT(corner, 0.1 * center);
  EXPECT_GT(corner, 0);
}

TEST(Optics, BlurGrowsSteadily) {
  const cv::Mat seen = after_lens(noise(), 0.3, 2);
  double last = 1e9;
  for (int x = 160; x + kPart <= 320; x += kPart) {
    const double now = detail(seen, {x, 100 - kPart / 2, kPart, kPart});
    EXPECT_LT(now, last) << "column " << x;
    last = now;
  }
}

TEST(Optics, EndsOfTheBlurAreThoseOfAGaussian) {
  const cv::Mat sharp = noise(161, 101);
  const cv::Mat seen = after_lens(sharp, 0.6, 1.2);
  for (const auto& [deviation, at] : {std::pair(0.6, cv::Point(80, 50)), {1.8, {160, 100}}}) {
    cv::Mat expected;
    cv::GaussianBlur(sharp, expected, {}, deviation, deviation, cv::BORDER_REPLICATE);
    EXPECT_NEAR(seen.at<float>(at), expected.at<float>(at), 1e-5) << deviation;
  }
}

TEST(Optics, WithoutRimBlurIsTheSameEverywhere) {
  const cv::Mat sharp = noise();
  EXPECT_EQ(cv::norm(after_lens(sharp, 0, 0), sharp, cv::NORM_INF), 0);
  const cv::Mat seen = after_lens(sharp, 0.8, 0);
  EXPECT_NEAR(center_detail(seen) / corner_detail(seen), 1, 0.2);
}

TEST(Optics, ConstantLightStaysConstantInAllSizes) {
  for (const auto& size : {cv::Size(1, 1), {1, 9}, {17, 1}, {33, 15}, {16, 16}}) {
    const cv::Mat flat(size, CV_32FC3, cv::Scalar(0.2, 0.5, 0.7));
    const cv::Mat seen = after_lens(flat, 0.7, 10);
    ASSERT_EQ(seen.size(), size);
    EXPECT_LT(cv::norm(seen, flat, cv::NORM_INF), 1e-5) << size;
  }
}

TEST(Optics, RimBlurKeepsTheTruthAndSoftensTheCorners) {
  const Scene scene = make_scene("street", 1);
  Settings s;
  s.width = 320, s.height = 180, s.noise = 0, s.samples = 1;
  const StereoFrame sharp = render(scene, 0, s);
  s.rim_blur = 2;
  const StereoFrame soft = render(scene, 0, s);
  EXPECT_EQ(cv::norm(sharp.truth, soft.truth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(sharp.occluded, soft.occluded, cv::NORM_INF), 0);
  for (const auto& [before, after] :
       {std::pair(sharp.left, soft.left), {sharp.right, soft.right}}) {
    EXPECT_GT(center_detail(after), 0.8 * center_detail(before));
    EXPECT_LT(corner_detail(after), 0.2 * corner_detail(before));
  }
}

}  // namespace
}  // namespace mtstereo::render::optics_test
