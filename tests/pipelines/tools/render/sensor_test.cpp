// SPDX-License-Identifier: LGPL-2.1-or-later
// Noise, exposure, determinism, odd sizes and invalid settings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>

#include "tools/render/render.hpp"

namespace mtstereo::render::sensor_test {
namespace {

Settings small() {
  Settings s;
  s.width = 160, s.height = 90, s.samples = 1;
  return s;
}

bool same(const StereoFrame& a, const StereoFrame& b) {
  const auto equal = [](const cv::Mat& p, const cv::Mat& q) {
    if (p.size() != q.size() || p.type() != q.type()) return false;
    for (int y = 0; y < p.rows; ++y) {
      if (std::memcmp(p.ptr(y), q.ptr(y), static_cast<std::size_t>(p.cols) * p.elemSize()) != 0) {
        return false;
      }
    }
    return true;
  };
  return equal(a.left, b.left) && equal(a.right, b.right) && equal(a.truth, b.truth) &&
         equal(a.occluded, b.occluded);
}

TEST(Sensor, ResultDoesNotDependOnTheNumberOfThreads) {
  const Scene scene = make_scene("garden", 1);
  Settings s = small();
  s.threads = 1;
  const StereoFrame one = render(scene, 0.3, s);
  for (const int threads : {2, 5, 0}) {
    s.threads = threads;
    EXPECT_TRUE(same(one, render(scene, 0.3, s))) << threads << " threads";
  }
}

TEST(Sensor, NoiseHasTheRequestedDeviation) {
  // A uniform gray wall: only the noise varies.
  SceneBuilder b("gray", 1);
  Texture flat;
  flat.noise_contrast = 0;
  b.rectangle({0, 0, 3}, 50, 50, flat);
  for (const double asked : {1.0, 2.0, 5.0}) {
    Settings s = small();
    s.noise = asked;
    const StereoFrame f = render(b.scene(), 0, s);
    cv::Scalar mean, deviation;
    cv::meanStdDev(f.left, mean, deviation);
    const double rounding = 1.0 / 12;
    EXPECT_NEAR(deviation[0], std::sqrt(asked * asked + rounding), 0.05 * asked);
    s.noise = 0;
    EXPECT_NEAR(mean[0], render(b.scene(), 0, s).left.at<std::uint8_t>(5, 5), 0.7);
  }
}

TEST(Sensor, NoiseDiffersBetweenViewsFramesAndSeeds) {
  SceneBuilder b("gray", 1);
  Texture flat;
  flat.noise_contrast = 0;
  b.rectangle({0, 0, 3}, 50, 50, flat);
  Settings s = small();
  s.noise = 3;
  const StereoFrame first = render(b.scene(), 0, s);
  const auto different = [&](const cv::Mat& other) {
    return cv::countNonZero(first.left != other) > other.rows * other.cols / 2;
  };
  EXPECT_TRUE(different(first.right));
  EXPECT_TRUE(different(render(b.scene(), 0.04, s).left));
  s.seed = 2;
  EXPECT_TRUE(different(render(b.scene(), 0, s).left));
}

TEST(Sensor, NoiseAndExposureDoNotChangeTheTruth) {
  const Scene scene = make_scene("room", 1);
  Settings s = small();
  s.noise = 0;
  const StereoFrame clean = render(scene, 0, s);
  s.noise = 4, s.exposure = 1.3;
  const StereoFrame noisy = render(scene, 0, s);
  EXPECT_EQ(cv::norm(clean.truth, noisy.truth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(clean.occluded, noisy.occluded, cv::NORM_INF), 0);
}

TEST(Sensor, ExposureBrightensOnlyTheRightView) {
  const Scene scene = make_scene("room", 1);
  Settings s = small();
  s.noise = 0;
  const StereoFrame plain = render(scene, 0, s);
  s.exposure = 1.2;
  const StereoFrame bright = render(scene, 0, s);
  EXPECT_EQ(cv::norm(plain.left, bright.left, cv::NORM_INF), 0);
  EXPECT_NEAR(cv::mean(bright.right)[0] / cv::mean(plain.right)[0], 1.2, 0.02);
}

// A uniform wall of one gray value in front of the cameras.
Scene gray_wall(double gray = 0.5) {
  SceneBuilder b("gray", 1);
  Texture flat;
  flat.mean = gray, flat.noise_contrast = 0;
  b.rectangle({0, 0, 3}, 50, 50, flat);
  b.scene().ambient = 1;
  return b.scene();
}

TEST(Sensor, ShotNoiseGrowsWithTheSignal) {
  for (const double gray : {0.1, 0.4, 0.8}) {
    Settings s = small();
    s.noise = 2, s.shot_noise = 0.1;
    cv::Scalar mean, deviation;
    cv::meanStdDev(render(gray_wall(gray), 0, s).left, mean, deviation);
    const double expected = std::sqrt(4 + 0.1 * 255 * gray + 1.0 / 12);
    EXPECT_NEAR(deviation[0], expected, 0.05 * expected) << "gray value " << gray;
  }
}

TEST(Sensor, GainAmplifiesSignalAndNoise) {
  Settings s = small();
  s.light = 0.1, s.gain = 4, s.noise = 2;
  cv::Scalar mean, deviation;
  cv::meanStdDev(render(gray_wall(), 0, s).right, mean, deviation);
  EXPECT_NEAR(mean[0], 0.4 * 127.5, 0.3);
  EXPECT_NEAR(deviation[0], 8, 0.4);
}

TEST(Sensor, LightBeyondWhiteIsClippedInBothViews) {
  Settings s = small();
  s.noise = 0, s.light = 3;
  const StereoFrame f = render(gray_wall(), 0, s);
  EXPECT_EQ(cv::countNonZero(f.left == 255), f.left.rows * f.left.cols);
  EXPECT_EQ(cv::countNonZero(f.right == 255), f.right.rows * f.right.cols);
  EXPECT_TRUE(std::isfinite(f.truth.at<float>(4, 4)));
}

TEST(Sensor, VignetteDarkensTheCornersOnly) {
  Settings s = small();
  s.width = 161, s.height = 91, s.noise = 0, s.vignette = 0.5;
  const StereoFrame f = render(gray_wall(), 0, s);
  EXPECT_EQ(f.left.at<std::uint8_t>(45, 80), 128);
  EXPECT_NEAR(f.left.at<std::uint8_t>(0, 0), 64, 1);
  EXPECT_EQ(f.left.at<std::uint8_t>(0, 0), f.right.at<std::uint8_t>(90, 160));
}

TEST(Sensor, CompressionLosesDetailAndKeepsTheTruth) {
  const Scene scene = make_scene("garden", 1);
  for (const bool color : {false, true}) {
    Settings s = small();
    s.noise = 0, s.color = color;
    const StereoFrame clean = render(scene, 0, s);
    double last = 0;
    for (const int quality : {95, 50, 10}) {
      s.jpeg = quality;
      const StereoFrame lossy = render(scene, 0, s);
      ASSERT_EQ(lossy.left.type(), clean.left.type());
      const double error = cv::norm(lossy.left, clean.left, cv::NORM_L1);
      EXPECT_GT(error, last) << "quality " << quality;
      EXPECT_EQ(cv::norm(lossy.truth, clean.truth, cv::NORM_INF), 0);
      last = error;
    }
  }
}

TEST(Sensor, OddSizesAreRendered) {
  const Scene scene = make_scene("street", 1);
  const int sizes[][2] = {{1, 1}, {1, 9}, {17, 1}, {33, 15}, {16, 16}, {31, 47}};
  for (const auto& size : sizes) {
    Settings s = small();
    s.width = size[0], s.height = size[1];
    const StereoFrame f = render(scene, 0, s);
    const cv::Size expected(size[0], size[1]);
    EXPECT_EQ(f.left.size(), expected);
    EXPECT_EQ(f.right.size(), expected);
    EXPECT_EQ(f.truth.size(), expected);
    EXPECT_EQ(f.occluded.size(), expected);
  }
}

TEST(Sensor, ColorAndGrayAgree) {
  const Scene scene = make_scene("garden", 1);
  Settings s = small();
  s.noise = 0;
  const StereoFrame gray = render(scene, 0, s);
  s.color = true;
  const StereoFrame color = render(scene, 0, s);
  ASSERT_EQ(color.left.type(), CV_8UC3);
  ASSERT_EQ(gray.left.type(), CV_8UC1);
  for (int x = 0; x < s.width; ++x) {
    const auto p = color.left.at<cv::Vec3b>(60, x);
    const double luma = 0.114 * p[0] + 0.587 * p[1] + 0.299 * p[2];
    ASSERT_NEAR(gray.left.at<std::uint8_t>(60, x), luma, 1.01) << "column " << x;
  }
}

struct Wrong {
  const char* name;
  void (*spoil)(Settings&);
};

class InvalidSettings : public ::testing::TestWithParam<Wrong> {};

TEST_P(InvalidSettings, AreRejectedByName) {
  Settings s = small();
  GetParam().spoil(s);
  EXPECT_NE(check(s).find(GetParam().name), std::string::npos) << "message: " << check(s);
  EXPECT_THROW(render(Scene(), 0, s), std::invalid_argument);
}

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    All, InvalidSettings,
    ::testing::Values(Wrong{"width", [](Settings& s) { s.width = 0; }},
                      Wrong{"width", [](Settings& s) { s.width = 16385; }},
                      Wrong{"height", [](Settings& s) { s.height = -3; }},
                      Wrong{"focal", [](Settings& s) { s.focal = -1; }},
                      Wrong{"focal", [](Settings& s) { s.focal = kNotANumber; }},
                      Wrong{"baseline", [](Settings& s) { s.baseline = -0.1; }},
                      Wrong{"baseline", [](Settings& s) { s.baseline = kNotANumber; }},
                      Wrong{"noise", [](Settings& s) { s.noise = 1000; }},
                      Wrong{"noise", [](Settings& s) { s.noise = kNotANumber; }},
                      Wrong{"exposure", [](Settings& s) { s.exposure = 0; }},
                      Wrong{"shot-noise", [](Settings& s) { s.shot_noise = -1; }},
                      Wrong{"shot-noise", [](Settings& s) { s.shot_noise = kNotANumber; }},
                      Wrong{"light", [](Settings& s) { s.light = 0; }},
                      Wrong{"gain", [](Settings& s) { s.gain = 1000; }},
                      Wrong{"vignette", [](Settings& s) { s.vignette = 1.1; }},
                      Wrong{"blur", [](Settings& s) { s.blur = 11; }},
                      Wrong{"rim-blur", [](Settings& s) { s.rim_blur = -0.1; }},
                      Wrong{"rim-blur", [](Settings& s) { s.rim_blur = 11; }},
                      Wrong{"rim-blur", [](Settings& s) { s.rim_blur = kNotANumber; }},
                      Wrong{"jpeg", [](Settings& s) { s.jpeg = 101; }},
                      Wrong{"jpeg", [](Settings& s) { s.jpeg = -1; }},
                      Wrong{"roll", [](Settings& s) { s.rig.roll = 11; }},
                      Wrong{"pitch", [](Settings& s) { s.rig.pitch = -11; }},
                      Wrong{"yaw", [](Settings& s) { s.rig.yaw = kNotANumber; }},
                      Wrong{"focal-ratio", [](Settings& s) { s.rig.focal_ratio = 0; }},
                      Wrong{"row-offset", [](Settings& s) { s.rig.row_offset = 101; }},
                      Wrong{"samples", [](Settings& s) { s.samples = 0; }},
                      Wrong{"threads", [](Settings& s) { s.threads = -1; }}),
    [](const auto& info) {
      std::string name = info.param.name;
      std::replace(name.begin(), name.end(), '-', '_');
      return name + std::to_string(info.index);
    });

TEST(Settings, MessageStatesTheValueAndTheRange) {
  Settings s;
  s.rig.focal_ratio = 1.25;
  EXPECT_EQ(check(s), "focal-ratio is 1.25; it must be 0.9 to 1.1");
}

TEST(Settings, DefaultsAreValid) { EXPECT_EQ(check(Settings()), ""); }

}  // namespace
}  // namespace mtstereo::render::sensor_test
