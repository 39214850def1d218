// SPDX-License-Identifier: LGPL-2.1-or-later
// temporal=hold and filter before a moving camera: how much less their maps flicker along the
// motion than with off, at what density and errors. On rendered scenes, whose motion is known
// exactly, and on a real road if MTSTEREO_TEST_DATA names a folder with one: there the optical
// flow of the left views is the motion.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mtstereo/matcher.hpp"
#include "pairs.hpp"
#include "tools/eval/flicker.hpp"
#include "tools/render/rig.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::tests::moving_test {
namespace {

namespace fs = std::filesystem;

constexpr double kInterval = 1.0 / 15;  ///< between two frames [s]
constexpr int kFrames = 8;
constexpr int kLead = 2;  ///< frames that are not measured
constexpr int kMaxDisparity = 64;
constexpr float kJump = 2;     ///< between neighboring pixels [px of disparity]
constexpr int kEdgeReach = 5;  ///< of the pixels near a jump [px]
constexpr float kWrong = 3;    ///< error of a wrong disparity [px]
constexpr int kRoadFrames = 20;
constexpr int kRoadMaxDisparity = 100;

GrayView view_of(const cv::Mat& image) {
  return {image.ptr<std::uint8_t>(), image.cols, image.rows,
          static_cast<std::ptrdiff_t>(image.step)};
}

/// Not 0 where the true disparity jumps within kEdgeReach.
cv::Mat edges_of(const cv::Mat& truth) {
  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
  const int side = 2 * kEdgeReach + 1;
  cv::Mat change, edges;
  cv::morphologyEx(cv::max(truth, 0), change, cv::MORPH_GRADIENT, cross);
  cv::dilate(change > kJump, edges, cv::Mat::ones(side, side, CV_8UC1));
  return edges;
}

/// Of the known pixels at the edges, the share that is wrong [%].
double wrong_at_edges(const cv::Mat& map, const cv::Mat& truth) {
  cv::Mat known = edges_of(truth) & (map == map) & (truth == truth);
  const int all = cv::countNonZero(known);
  return 100.0 * cv::countNonZero(known & (cv::abs(map - truth) > kWrong)) / all;
}

/// What is measured of a stream.
struct Figures {
  eval::Flicker flicker;
  double wrong_at_edges = 0;
};

/// The frames of a scene, and where the camera was.
class Clip {
 public:
  explicit Clip(const std::string& name) : path_(render::make_scene(name, 1).camera) {
    for (int i = 0; i < kFrames; ++i) frames_.push_back(rendered_pair(name, kInterval * i));
    const render::Settings settings = rendered_settings(name);
    camera_ = render::left_camera(settings);
    reach_ = camera_.focal * settings.baseline;
  }
  const eval::LoadedPair& operator[](int i) const { return frames_[i]; }

  /// The pixel of frame i - 1 that shows the same point as a pixel of frame i; none if the point
  /// was hidden or outside, or moves.
  std::optional<cv::Point> before(int i, int x, int y) const {
    const float disparity = frames_[i].truth.disparity.at<float>(y, x);
    if (std::isnan(disparity)) return std::nullopt;
    const Eigen::Vector3d point = reach_ / disparity * camera_.direction(x, y);
    const Eigen::Vector3d was =
        path_.pose_at(kInterval * (i - 1)).inverse() * path_.pose_at(kInterval * i) * point;
    const cv::Point2d place = camera_.project(was / was.z());
    const cv::Point pixel(cvRound(place.x), cvRound(place.y));
    const cv::Mat& truth = frames_[i - 1].truth.disparity;
    if (!cv::Rect({}, truth.size()).contains(pixel)) return std::nullopt;
    const bool same = std::abs(truth.at<float>(pixel) - reach_ / was.z()) < 1;
    return same ? std::optional(pixel) : std::nullopt;
  }

 private:
  std::vector<eval::LoadedPair> frames_;
  render::CameraPath path_;
  render::Camera camera_;
  double reach_ = 0;  ///< disparity times depth [px m]
};

/// Of the points that either of two successive maps knows, the share that one does not know [%].
/// `before_pixel` finds the pixels of the last map.
template <typename Before>
double come_and_go(const Before& before_pixel, const cv::Mat& last, const cv::Mat& now) {
  double any = 0, one = 0;
  for (int y = 0; y < now.rows; ++y) {
    for (int x = 0; x < now.cols; ++x) {
      const std::optional<cv::Point> before = before_pixel(x, y);
      if (!before) continue;
      const bool is = !std::isnan(now.at<float>(y, x)), was = !std::isnan(last.at<float>(*before));
      any += is || was;
      one += is != was;
    }
  }
  return 100 * one / any;
}

/// Means over the frames of a clip.
Figures figures_of(const Clip& clip, const char* temporal, double noise) {
  Parameters parameters;
  EXPECT_TRUE(parameters.set("temporal", temporal).ok());
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, kMaxDisparity).ok());
  Matcher matcher = std::move(Matcher::create(parameters).value());
  std::vector<eval::Flicker> frames;
  double wrong = 0;
  cv::Mat last;
  for (int i = 0; i < kFrames; ++i) {
    cv::Mat left = clip[i].left.clone(), right = clip[i].right.clone();
    eval::add_flicker_noise(noise, i, left, right);
    const Result<FrameResult> result = matcher.compute(view_of(left), view_of(right));
    if (!result.ok()) {
      ADD_FAILURE() << result.error().message;
      return {};
    }
    const cv::Mat map = eval::to_float(result->disparity);
    if (i >= kLead) {
      const eval::Metrics errors = eval::evaluate(map, clip[i].truth).all;
      frames.push_back({.density = errors.known_density,
                        .come_and_go = come_and_go(
                            [&](int x, int y) { return clip.before(i, x, y); }, last, map),
                        .d_all = errors.d_all,
                        .avgerr = errors.avgerr});
      wrong += wrong_at_edges(map, clip[i].truth.disparity);
    }
    last = map;
  }
  return {eval::mean(frames), wrong / (kFrames - kLead)};
}

/// The mean over the scenes.
Figures mean_of(const std::vector<Clip>& clips, const char* temporal, double noise) {
  std::vector<eval::Flicker> all;
  double wrong = 0;
  for (const Clip& clip : clips) {
    const Figures figures = figures_of(clip, temporal, noise);
    all.push_back(figures.flicker);
    wrong += figures.wrong_at_edges / static_cast<double>(clips.size());
  }
  const eval::Flicker mean = eval::mean(all);
  std::printf(
      "  %s: come and go %.1f %%, density %.1f %%, D-all %.2f %%, avgerr %.3f px, %.2f %% wrong at "
      "edges\n",
      temporal, mean.come_and_go, mean.density, mean.d_all, mean.avgerr, wrong);
  return {mean, wrong};
}

TEST(MovingCamera, HoldAndFilterReduceTheFlickerAndTheErrors) {
  const std::vector<Clip> clips = {Clip("street"), Clip("garden"), Clip("room")};
  for (const double noise : {1.0, 5.0}) {
    const Figures off = mean_of(clips, "off", noise), hold = mean_of(clips, "hold", noise);
    EXPECT_LE(hold.flicker.come_and_go, 0.65 * off.flicker.come_and_go) << "noise " << noise;
    EXPECT_GE(hold.flicker.density, off.flicker.density - 0.6 * noise) << "noise " << noise;
    EXPECT_LE(hold.flicker.d_all, off.flicker.d_all) << "noise " << noise;
    EXPECT_LE(hold.flicker.avgerr, off.flicker.avgerr) << "noise " << noise;
    EXPECT_LE(hold.wrong_at_edges, off.wrong_at_edges + 0.1) << "noise " << noise;
    if (noise < 2) continue;  // the views are taken as they are
    const Figures filter = mean_of(clips, "filter", noise);
    EXPECT_LE(filter.flicker.come_and_go, 0.55 * off.flicker.come_and_go);
    EXPECT_GE(filter.flicker.density, off.flicker.density + 2);
    EXPECT_LE(filter.flicker.d_all, off.flicker.d_all - 0.1);
    EXPECT_LE(filter.flicker.avgerr, off.flicker.avgerr - 0.03);
    EXPECT_LE(filter.wrong_at_edges, off.wrong_at_edges);
  }
}

/// The frames of a camera on a real road, and the flow from each left view to the one before.
class Road {
 public:
  explicit Road(const fs::path& folder) {
    const auto flow = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
    for (int i = 0; i < kRoadFrames; ++i) {
      const std::string file = std::to_string(1000000 + i).substr(1) + ".png";
      left_.push_back(cv::imread(folder / "image_l" / file, cv::IMREAD_GRAYSCALE));
      right_.push_back(cv::imread(folder / "image_r" / file, cv::IMREAD_GRAYSCALE));
      back_.emplace_back();
      forth_.emplace_back();
      if (i == 0) continue;
      flow->calc(left_[i], left_[i - 1], back_[i]);
      flow->calc(left_[i - 1], left_[i], forth_[i]);
    }
  }
  GrayView left(int i) const { return view_of(left_[i]); }
  GrayView right(int i) const { return view_of(right_[i]); }

  /// The pixel of frame i - 1 that shows the same point as a pixel of frame i, if the flow back
  /// and forth agrees.
  std::optional<cv::Point> before(int i, int x, int y) const {
    const cv::Vec2f back = back_[i].at<cv::Vec2f>(y, x);
    const cv::Point pixel(cvRound(static_cast<float>(x) + back[0]),
                          cvRound(static_cast<float>(y) + back[1]));
    if (!cv::Rect({}, left_[i].size()).contains(pixel)) return std::nullopt;
    const cv::Vec2f loop = back + forth_[i].at<cv::Vec2f>(pixel);
    const bool same = std::abs(loop[0]) < 1 && std::abs(loop[1]) < 1;
    return same ? std::optional(pixel) : std::nullopt;
  }

 private:
  std::vector<cv::Mat> left_, right_;
  std::vector<cv::Mat> back_, forth_;  ///< of type CV_32FC2; none for the first frame
};

/// The mean of come_and_go() over the frames.
double come_and_go_of(const Road& road, const char* temporal) {
  Parameters parameters;
  EXPECT_TRUE(parameters.set("temporal", temporal).ok());
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, kRoadMaxDisparity).ok());
  Matcher matcher = std::move(Matcher::create(parameters).value());
  cv::Mat last;
  double sum = 0;
  for (int i = 0; i < kRoadFrames; ++i) {
    const Result<FrameResult> result = matcher.compute(road.left(i), road.right(i));
    if (!result.ok()) throw std::runtime_error(result.error().message);
    const cv::Mat map = eval::to_float(result->disparity);
    const auto before = [&](int x, int y) { return road.before(i, x, y); };
    if (i >= kLead) sum += come_and_go(before, last, map);
    last = map;
  }
  std::printf("  %s: come and go %.1f %%\n", temporal, sum / (kRoadFrames - kLead));
  return sum / (kRoadFrames - kLead);
}

TEST(MovingCamera, HoldReducesTheFlickerOfARoadByAThird) {
  const fs::path folder = fs::path(data_folder()) / "kitti_sequence";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no test data";
  const Road road(folder);
  EXPECT_LE(come_and_go_of(road, "hold"), 0.667 * come_and_go_of(road, "off"));
}

}  // namespace
}  // namespace mtstereo::tests::moving_test
