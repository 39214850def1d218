// SPDX-License-Identifier: LGPL-2.1-or-later
// temporal=hold and filter before a moving camera: how much less their maps flicker along the
// motion than with off, at what density and errors. On rendered scenes, whose motion is known
// exactly, and on a real road if MTSTEREO_TEST_DATA names a folder with one: there the optical
// flow of the left views is the motion.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mtstereo/matcher.hpp"
#include "pairs.hpp"
#include "tools/eval/flicker.hpp"
#include "tools/eval/moving_edges.hpp"
#include "tools/render/rig.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::tests::moving_test {
namespace {

namespace fs = std::filesystem;

constexpr double kInterval = 1.0 / 15;  ///< between two frames [s]
constexpr int kFrames = 8;
constexpr int kLead = 2;  ///< frames that are not measured
constexpr int kMaxDisparity = 64;
constexpr int kRoadFrames = 20;
constexpr int kRoadMaxDisparity = 100;

GrayView view_of(const cv::Mat& image) {
  return {image.ptr<std::uint8_t>(), image.cols, image.rows,
          static_cast<std::ptrdiff_t>(image.step)};
}

/// The frames of a scene, and where the camera was.
class Clip {
 public:
  explicit Clip(const std::string& name) {
    const render::CameraPath path = render::make_scene(name, 1).camera;
    for (int i = 0; i < kFrames; ++i) {
      frames_.push_back(rendered_pair(name, kInterval * i));
      back_.push_back(path.pose_at(kInterval * (i - 1)).inverse() * path.pose_at(kInterval * i));
    }
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
    const Eigen::Vector3d was = back_[i] * point;
    const cv::Point2d place = camera_.project(was / was.z());
    const cv::Point pixel(cvRound(place.x), cvRound(place.y));
    const cv::Mat& truth = frames_[i - 1].truth.disparity;
    if (!cv::Rect({}, truth.size()).contains(pixel)) return std::nullopt;
    const bool same = std::abs(truth.at<float>(pixel) - reach_ / was.z()) < 1;
    return same ? std::optional(pixel) : std::nullopt;
  }

 private:
  std::vector<eval::LoadedPair> frames_;
  std::vector<Eigen::Isometry3d> back_;  ///< from the camera of a frame to that of the one before
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
eval::Flicker figures_of(const Clip& clip, const char* temporal, double noise) {
  Parameters parameters;
  EXPECT_TRUE(parameters.set("temporal", temporal).ok());
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, kMaxDisparity).ok());
  Matcher matcher = std::move(Matcher::create(parameters).value());
  std::vector<eval::Flicker> frames;
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
                        .avgerr = errors.avgerr,
                        .edges = eval::wrong_at_edges(map, clip[i].truth.disparity)});
    }
    last = map;
  }
  return eval::mean(frames);
}

/// Those of each scene, and at the end their mean.
std::vector<eval::Flicker> all_figures(const std::vector<Clip>& clips, const char* temporal,
                                       double noise) {
  std::vector<eval::Flicker> all;
  for (const Clip& clip : clips) all.push_back(figures_of(clip, temporal, noise));
  const eval::Flicker mean = eval::mean(all);
  std::printf(
      "  %s, noise %.0f: come and go %.1f %%, density %.1f %%, D-all %.2f %%, avgerr %.3f px, %.2f "
      "%% wrong at edges\n",
      temporal, noise, mean.come_and_go, mean.density, mean.d_all, mean.avgerr, mean.edges);
  all.push_back(mean);
  return all;
}

/// `steady` and `off` are figures as all_figures() returns them. Single scenes may have a few more
/// errors, their mean may not.
void expect_no_more_errors(const std::vector<eval::Flicker>& steady,
                           const std::vector<eval::Flicker>& off) {
  EXPECT_LE(steady.back().d_all, off.back().d_all);
  EXPECT_LE(steady.back().avgerr, off.back().avgerr);
  EXPECT_LE(steady.back().edges, off.back().edges);
  for (std::size_t i = 0; i < off.size(); ++i) {
    EXPECT_LE(steady[i].d_all, off[i].d_all + 0.03) << "scene " << i;
    EXPECT_LE(steady[i].avgerr, off[i].avgerr + 0.005) << "scene " << i;
    EXPECT_LE(steady[i].edges, off[i].edges + 0.1) << "scene " << i;
  }
}

// Feature: steady maps of still scenes, and before a moving camera
TEST(MovingCamera, HoldAndFilterReduceTheFlickerAndTheErrors) {
  const std::vector<Clip> clips = {Clip("street"), Clip("garden"), Clip("room")};
  const std::map<double, double> lost_density = {{1, 0.95}, {5, 3.25}, {10, 10}};
  for (const auto& [noise, lost] : lost_density) {
    SCOPED_TRACE("noise " + std::to_string(noise));
    const std::vector<eval::Flicker> off = all_figures(clips, "off", noise);
    const std::vector<eval::Flicker> hold = all_figures(clips, "hold", noise);
    expect_no_more_errors(hold, off);
    EXPECT_LE(hold.back().come_and_go, 0.68 * off.back().come_and_go);
    EXPECT_GE(hold.back().density, off.back().density - lost);
    if (noise < 2) continue;  // the views are taken as they are
    const std::vector<eval::Flicker> filter = all_figures(clips, "filter", noise);
    expect_no_more_errors(filter, off);
    EXPECT_LE(filter.back().come_and_go, 0.55 * off.back().come_and_go);
    EXPECT_GE(filter.back().density, off.back().density + 0.35);
    EXPECT_LE(filter.back().d_all, off.back().d_all - 0.1);
    EXPECT_LE(filter.back().avgerr, off.back().avgerr - 0.03);
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

TEST(MovingCamera, HoldReducesTheFlickerOfARoad) {
  const fs::path folder = fs::path(data_folder()) / "kitti_sequence";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no test data";
  const Road road(folder);
  EXPECT_LE(come_and_go_of(road, "hold"), 0.69 * come_and_go_of(road, "off"));
}

}  // namespace
}  // namespace mtstereo::tests::moving_test
