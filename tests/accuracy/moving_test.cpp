// SPDX-License-Identifier: LGPL-2.1-or-later
// temporal=hold and filter before a moving camera: how much less their maps flicker along the
// motion than with off, at what density and errors. On rendered scenes, whose motion is known
// exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "mtstereo/matcher.hpp"
#include "pairs.hpp"
#include "tools/eval/flicker.hpp"
#include "tools/render/rig.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::tests::moving_test {
namespace {

constexpr double kInterval = 1.0 / 15;  ///< between two frames [s]
constexpr int kFrames = 8;
constexpr int kLead = 2;  ///< frames that are not measured
constexpr int kMaxDisparity = 64;

GrayView view_of(const cv::Mat& image) {
  return {image.ptr<std::uint8_t>(), image.cols, image.rows,
          static_cast<std::ptrdiff_t>(image.step)};
}

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
double come_and_go(const Clip& clip, int frame, const cv::Mat& last, const cv::Mat& now) {
  double any = 0, one = 0;
  for (int y = 0; y < now.rows; ++y) {
    for (int x = 0; x < now.cols; ++x) {
      const std::optional<cv::Point> before = clip.before(frame, x, y);
      if (!before) continue;
      const bool is = !std::isnan(now.at<float>(y, x)), was = !std::isnan(last.at<float>(*before));
      any += is || was;
      one += is != was;
    }
  }
  return 100 * one / any;
}

/// Means over the frames of a clip.
eval::Flicker flicker_of(const Clip& clip, const char* temporal, double noise) {
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
                        .come_and_go = come_and_go(clip, i, last, map),
                        .d_all = errors.d_all,
                        .avgerr = errors.avgerr});
    }
    last = map;
  }
  return eval::mean(frames);
}

void print(const char* name, const eval::Flicker& flicker) {
  std::printf("  %s: come and go %.1f %%, density %.1f %%, D-all %.2f %%, avgerr %.3f px\n", name,
              flicker.come_and_go, flicker.density, flicker.d_all, flicker.avgerr);
}

/// The mean over the scenes.
eval::Flicker mean_of(const std::vector<Clip>& clips, const char* temporal, double noise) {
  std::vector<eval::Flicker> all;
  for (const Clip& clip : clips) all.push_back(flicker_of(clip, temporal, noise));
  print(temporal, eval::mean(all));
  return eval::mean(all);
}

TEST(MovingCamera, HoldAndFilterReduceTheFlickerAndTheErrors) {
  const std::vector<Clip> clips = {Clip("street"), Clip("garden"), Clip("room")};
  for (const double noise : {1.0, 5.0}) {
    const eval::Flicker off = mean_of(clips, "off", noise), hold = mean_of(clips, "hold", noise);
    EXPECT_LE(hold.come_and_go, 0.65 * off.come_and_go) << "noise " << noise;
    EXPECT_GE(hold.density, off.density - 0.5 * noise) << "noise " << noise;
    EXPECT_LE(hold.d_all, off.d_all) << "noise " << noise;
    EXPECT_LE(hold.avgerr, off.avgerr) << "noise " << noise;
    if (noise < 2) continue;  // the views are taken as they are
    const eval::Flicker filter = mean_of(clips, "filter", noise);
    EXPECT_LE(filter.come_and_go, 0.65 * off.come_and_go);
    EXPECT_GE(filter.density, off.density + 2);
    EXPECT_LE(filter.d_all, off.d_all - 0.1);
    EXPECT_LE(filter.avgerr, off.avgerr - 0.03);
  }
}

}  // namespace
}  // namespace mtstereo::tests::moving_test
