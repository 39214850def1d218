// SPDX-License-Identifier: LGPL-2.1-or-later
// Bayer mosaic, demosaicing, noise reduction and sharpening.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tools/render/processing.hpp"
#include "tools/render/render.hpp"

namespace mtstereo::render::mosaic_test {
namespace {

const cv::Scalar kColor(40, 120, 200);  // blue, green, red

Settings small() {
  Settings s;
  s.width = 160, s.height = 90, s.samples = 1, s.mosaic = true;
  return s;
}

// A uniform, colored wall in front of the cameras: blue 40 %, green 50 %, red 60 % of white.
Scene wall() {
  SceneBuilder b("wall", 1);
  Texture flat;
  flat.mean = 1, flat.noise_contrast = 0, flat.color = {0.4f, 0.5f, 0.6f};
  b.rectangle({0, 0, 3}, 50, 50, flat);
  b.scene().ambient = 1;
  return b.scene();
}

double deviation_of(const cv::Mat& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0];
}

cv::Mat noisy(const cv::Scalar& mean, double deviation) {
  cv::Mat image(120, 160, CV_32FC3);
  cv::RNG random(1);
  random.fill(image, cv::RNG::NORMAL, mean, cv::Scalar::all(deviation));
  return image;
}

cv::Mat luma_of(const cv::Mat& image) {
  cv::Mat luma;
  cv::cvtColor(image, luma, cv::COLOR_BGR2GRAY);
  return luma;
}

TEST(Mosaic, HasTheColorsInTheOrderOfBayer) {
  const cv::Mat mosaic = mosaic_of(cv::Mat(3, 4, CV_32FC3, kColor), 0);
  ASSERT_EQ(mosaic.type(), CV_16UC1);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      const int channel = 2 - (x & 1) - (y & 1);  // red, green / green, blue
      EXPECT_EQ(mosaic.at<std::uint16_t>(y, x), 256 * kColor[channel]) << x << ", " << y;
    }
  }
}

TEST(Mosaic, ClipsAtBlackAndWhite) {
  const cv::Mat mosaic = mosaic_of(cv::Mat(2, 2, CV_32FC3, cv::Scalar(-3, 255, 900)), 2);
  EXPECT_EQ(mosaic.size(), cv::Size(6, 6));
  EXPECT_EQ(mosaic.at<std::uint16_t>(0, 0), 256 * 255);
  EXPECT_EQ(mosaic.at<std::uint16_t>(1, 0), 256 * 255);
  EXPECT_EQ(mosaic.at<std::uint16_t>(1, 1), 0);
}

TEST(Mosaic, ConstantColorStaysConstantInAllSizes) {
  const cv::Size sizes[] = {{1, 1}, {1, 9}, {17, 1}, {2, 2}, {3, 3}, {33, 15}, {16, 16}, {31, 48}};
  for (const cv::Size& size : sizes) {
    const cv::Mat flat(size, CV_32FC3, kColor);
    for (const double expected_noise : {0.0, 2.0}) {
      const cv::Mat image = through_mosaic(flat, expected_noise);
      ASSERT_EQ(image.size(), size);
      ASSERT_EQ(image.type(), CV_32FC3);
      EXPECT_LT(cv::norm(image, flat, cv::NORM_INF), 0.05) << size;
    }
  }
}

TEST(Mosaic, RendersAConstantWallInAllSizes) {
  const int sizes[][2] = {{1, 1}, {1, 9}, {17, 1}, {33, 15}, {16, 16}, {31, 47}};
  for (const auto& size : sizes) {
    for (const bool color : {false, true}) {
      Settings s = small();
      s.width = size[0], s.height = size[1], s.noise = 0, s.rim_blur = 2, s.color = color;
      const StereoFrame f = render(wall(), 0, s);
      s.mosaic = false;
      const StereoFrame plain = render(wall(), 0, s);
      ASSERT_EQ(f.left.size(), cv::Size(size[0], size[1]));
      ASSERT_EQ(f.left.type(), color ? CV_8UC3 : CV_8UC1);
      EXPECT_LE(cv::norm(f.left, plain.left, cv::NORM_INF), 1);
      EXPECT_LE(cv::norm(f.right, plain.right, cv::NORM_INF), 1);
    }
  }
}

// The noise before the mosaic is that of the options, and the camera reduces it.
TEST(Mosaic, NoiseIsReducedButNotRemoved) {
  for (const double noise : {1.0, 3.0, 6.0}) {
    cv::Mat greens = mosaic_of(noisy(kColor, noise), 0);
    greens = greens.reshape(1, greens.rows / 2).colRange(1, greens.cols);  // blue is left out
    std::vector<float> values;
    for (int y = 0; y < greens.rows; ++y) {
      for (int x = 0; x < greens.cols; x += 2) values.push_back(greens.at<std::uint16_t>(y, x));
    }
    EXPECT_NEAR(deviation_of(cv::Mat(values)), 256 * noise, 0.05 * 256 * noise);
    const cv::Mat seen = luma_of(through_mosaic(noisy(kColor, noise), noise));
    EXPECT_LT(deviation_of(seen), 0.75 * noise);
    EXPECT_GT(deviation_of(seen), 0.2 * noise);
    EXPECT_NEAR(cv::mean(seen)[0], cv::mean(luma_of(cv::Mat(1, 1, CV_32FC3, kColor)))[0], 0.2);
  }
}

TEST(Mosaic, ExpectsTheNoiseOfTheSensor) {
  // The same noise, of three sources.
  const auto seen = [](double noise, double shot, double light, double gain) {
    Settings s = small();
    s.noise = noise, s.shot_noise = shot, s.light = light, s.gain = gain;
    return deviation_of(render(wall(), 0, s).left);
  };
  const double constant = seen(4, 0, 1, 1);
  EXPECT_GT(constant, 0.8);
  EXPECT_LT(constant, 3);
  EXPECT_NEAR(seen(1, 0, 0.25, 4), constant, 0.1 * constant);
  EXPECT_NEAR(seen(0, 16 / 127.5, 1, 1), constant, 0.1 * constant);
}

TEST(Mosaic, EdgesAreKeptAndSharpened) {
  cv::Mat edge = noisy(cv::Scalar::all(60), 2);
  edge.colRange(80, 160) += cv::Scalar::all(120);
  cv::GaussianBlur(edge, edge, {}, 0.8, 0.8);
  cv::Mat profile;
  cv::reduce(luma_of(through_mosaic(edge, 2)), profile, 0, cv::REDUCE_AVG);
  EXPECT_NEAR(profile.at<float>(60), 60, 1);
  EXPECT_NEAR(profile.at<float>(100), 180, 1);
  double least = 0, most = 0;
  cv::minMaxLoc(profile, &least, &most);
  EXPECT_GT(most - least, 120 + 4);
  EXPECT_GT(profile.at<float>(82) - profile.at<float>(77), 100);
}

TEST(Mosaic, FineTextureIsLost) {
  const Scene scene = make_scene("street", 1);
  Settings s = small();
  s.width = 320, s.height = 180, s.noise = 2;
  const auto detail = [](const cv::Mat& image) {
    cv::Mat edges;
    cv::Laplacian(image, edges, CV_32F);
    return cv::norm(edges, cv::NORM_L1);
  };
  const double processed = detail(render(scene, 0, s).left);
  s.mosaic = false, s.noise = 0;
  EXPECT_LT(processed, detail(render(scene, 0, s).left));
}

TEST(Mosaic, KeepsTheTruthAndIsTheSameInEveryRun) {
  const Scene scene = make_scene("garden", 1);
  Settings s = small();
  s.noise = 2, s.shot_noise = 0.05, s.color = true, s.threads = 1;
  const StereoFrame first = render(scene, 0.3, s);
  s.threads = 3;
  const StereoFrame again = render(scene, 0.3, s);
  EXPECT_EQ(cv::norm(first.left, again.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(first.right, again.right, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(first.left, render_view(scene, 0.3, s, false), cv::NORM_INF), 0);
  s.seed = 2;
  EXPECT_GT(cv::norm(first.left, render(scene, 0.3, s).left, cv::NORM_INF), 0);
  s.mosaic = false;
  const StereoFrame plain = render(scene, 0.3, s);
  EXPECT_EQ(cv::norm(first.truth, plain.truth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(first.occluded, plain.occluded, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace mtstereo::render::mosaic_test
