// SPDX-License-Identifier: LGPL-2.1-or-later
// temporal=hold and filter on still scenes with fresh noise in every frame: how much less their
// maps flicker than with off, at what density and errors. On rendered scenes, and on real pairs if
// MTSTEREO_TEST_DATA names a folder with them.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "mtstereo/matcher.hpp"
#include "pairs.hpp"
#include "tools/eval/flicker.hpp"

namespace mtstereo::tests::hold_test {
namespace {

GrayView view_of(const cv::Mat& image) {
  return {image.ptr<std::uint8_t>(), image.cols, image.rows,
          static_cast<std::ptrdiff_t>(image.step)};
}

/// The flicker of the last frames of a stream.
eval::Flicker flicker_of(const eval::LoadedPair& pair, const char* temporal, const char* mode,
                         int max_disparity, double noise) {
  Parameters parameters;
  EXPECT_TRUE(parameters.set("temporal", temporal).ok());
  EXPECT_TRUE(parameters.set("mode", mode).ok());
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, max_disparity).ok());
  Matcher matcher = std::move(Matcher::create(parameters).value());
  eval::FlickerWindow window;
  // Without the past, the maps do not depend on the frames before those that are measured.
  const int first = temporal == std::string("off") ? eval::kFlickerLead : 0;
  for (int frame = first; frame < eval::kFlickerLead + eval::kFlickerFrames; ++frame) {
    eval::LoadedPair noisy{pair.left.clone(), pair.right.clone(), {}};
    eval::add_flicker_noise(noise, frame, noisy.left, noisy.right);
    const Result<FrameResult> result = matcher.compute(view_of(noisy.left), view_of(noisy.right));
    if (!result.ok()) {
      ADD_FAILURE() << result.error().message;
      return {};
    }
    const cv::Mat map = eval::to_float(result->disparity);
    window.add(map, pair.truth);
  }
  return *window.measure();
}

/// The mean flicker over pairs with temporal=off and with another value.
struct Compared {
  eval::Flicker off, on;
};

void print(const char* name, const eval::Flicker& flicker) {
  std::printf("  %s: come and go %.1f %%, density %.1f %%, D-all %.2f %%, avgerr %.3f px\n", name,
              flicker.come_and_go, flicker.density, flicker.d_all, flicker.avgerr);
}

/// Limits for what it changes.
struct Limits {
  double flicker;  ///< factor
  double density;  ///< least change [%]
  double d_all;    ///< largest change [%]
  double avgerr;   ///< largest change [px]
};

void expect_within(const Compared& mean, const Limits& limits) {
  print("off ", mean.off);
  print("on  ", mean.on);
  EXPECT_LE(mean.on.come_and_go, limits.flicker * mean.off.come_and_go);
  EXPECT_GE(mean.on.density, mean.off.density + limits.density);
  EXPECT_LE(mean.on.d_all, mean.off.d_all + limits.d_all);
  EXPECT_LE(mean.on.avgerr, mean.off.avgerr + limits.avgerr);
}

/// A pair and its range of disparities.
struct Scene {
  eval::LoadedPair pair;
  int max_disparity;
};

/// The mean flicker over scenes. Each is measured once for all tests.
eval::Flicker mean_flicker(const std::vector<Scene>& scenes, const char* temporal, const char* mode,
                           double noise) {
  using Key = std::tuple<const Scene*, std::string, std::string, double>;
  static std::map<Key, eval::Flicker> measured;
  const Key key(scenes.data(), temporal, mode, noise);
  if (const auto found = measured.find(key); found != measured.end()) return found->second;
  std::vector<eval::Flicker> flicker;
  for (const Scene& scene : scenes) {
    flicker.push_back(flicker_of(scene.pair, temporal, mode, scene.max_disparity, noise));
  }
  return measured[key] = eval::mean(flicker);
}

Compared compare(const std::vector<Scene>& scenes, const char* mode, double noise,
                 const char* temporal = "hold") {
  return {mean_flicker(scenes, "off", mode, noise), mean_flicker(scenes, temporal, mode, noise)};
}

std::vector<Scene> render_scenes() {
  std::vector<Scene> scenes;
  for (const char* const name : {"street", "garden", "room"}) {
    scenes.push_back({rendered_pair(name, 0), 64});
  }
  return scenes;
}

const std::vector<Scene>& rendered() {
  static const std::vector<Scene> scenes = render_scenes();
  return scenes;
}

// Feature: steady maps of still scenes, and before a moving camera
TEST(HoldOnRenderedScenes, ReducesTheFlicker) {
  expect_within(compare(rendered(), "semi-dense", 1), {0.33, -0.75, 0, 0});
}

TEST(HoldOnRenderedScenes, ReducesTheFlickerOfModeDense) {
  expect_within(compare(rendered(), "dense", 1), {0.56, -1.95, -0.05, 0});
}

// Feature: steady maps of still scenes, and before a moving camera
TEST(FilterOnRenderedScenes, ReducesTheFlicker) {
  expect_within(compare(rendered(), "semi-dense", 1, "filter"), {0.225, -0.45, 0.02, 0});
  expect_within(compare(rendered(), "semi-dense", 5, "filter"), {0.2, 3.5, -0.2, -0.05});
}

/// The five real pairs; none without test data.
std::vector<Scene> load_real() {
  std::vector<Scene> scenes;
  const std::string folder = data_folder();
  if (folder.empty()) return scenes;
  for (const eval::StereoPair& pair : ten_pairs(folder)) {
    for (const char* const name : {"Teddy", "Books", "playground_1l", "000046_10", "0000"}) {
      if (!pair.name.ends_with(name)) continue;
      scenes.push_back({eval::load_pair(pair), *pair.max_disparity});
    }
  }
  EXPECT_EQ(5U, scenes.size());
  return scenes;
}

const std::vector<Scene>& real() {
  static const std::vector<Scene> scenes = load_real();
  return scenes;
}

TEST(HoldOnRealPairs, ReducesTheFlicker) {
  const std::vector<Scene>& scenes = real();
  if (scenes.empty()) GTEST_SKIP() << "no test data";
  expect_within(compare(scenes, "semi-dense", 1), {0.35, -1.6, 0.01, 0});
  expect_within(compare(scenes, "semi-dense", 3), {0.4, -2.5, -0.03, -0.01});
}

TEST(FilterOnRealPairs, ReducesTheFlickerAndTheErrors) {
  const std::vector<Scene>& scenes = real();
  if (scenes.empty()) GTEST_SKIP() << "no test data";
  expect_within(compare(scenes, "semi-dense", 1, "filter"), {0.17, 0.3, 0, -0.01});
  expect_within(compare(scenes, "semi-dense", 3, "filter"), {0.2, 2, -0.02, -0.04});
  expect_within(compare(scenes, "dense", 1, "filter"), {0.3, 0, -0.06, -0.03});
}

}  // namespace
}  // namespace mtstereo::tests::hold_test
