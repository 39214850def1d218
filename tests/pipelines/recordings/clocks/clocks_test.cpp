// SPDX-License-Identifier: LGPL-2.1-or-later
// Feature: two recorders that were started apart

// Offset and drift of two recordings of rendered scenes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lib/outputs/user_error.hpp"
#include "moving_views.hpp"
#include "recordings/clocks/frame_pairs.hpp"
#include "recordings/matching/piece.hpp"
#include "support/temporary_folder.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::run::clocks_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kRate = 12;
constexpr double kTenth = 0.1 / kRate;  // of a frame [s]
constexpr int kFrames = 96;             // of a recording: 8 s
constexpr double kLength = kFrames / kRate;

Shooting street(bool right, double start) {
  Shooting shooting;
  shooting.scene = render::make_scene("street", 1);
  // The leaves of the trees take a fifth of the time, and are too small for these views.
  std::erase_if(shooting.scene.objects,
                [](const render::Object& object) { return object.texture.noise_size < 0.1; });
  shooting.right = right;
  shooting.start = start;
  shooting.rate = kRate;
  shooting.frames = kFrames;
  return shooting;
}

class Clocks : public ::testing::Test {
 protected:
  // Views that several tests use are rendered once.
  static const Shot& left() {
    static const Shot shot = shoot(street(false, 0));
    return shot;
  }
  static const Shot& right_with(double start) {
    static const Shot together = shoot(street(true, 0));
    static const Shot later = shoot(street(true, 0.4));
    return start == 0 ? together : later;
  }

  ClockEstimate estimate(const Source& left, const Source& right) {
    Recording recording;
    recording.name = "street";
    recording.left = left;
    recording.right = right;
    return estimate_clocks(recording, index_frames(left, 0), index_frames(right, 0));
  }
  ClockEstimate estimate(const Shot& left, const Shot& right) {
    return estimate(write_images(left, folder_ / "left"), write_images(right, folder_ / "right"));
  }
  // The message with which recordings are refused.
  std::string refusal(const Shot& left, const Shot& right) {
    try {
      const ClockEstimate found = estimate(left, right);
      return "no refusal, but " + found.explanation;
    } catch (const UserError& error) {
      return error.what();
    }
  }

  test::TemporaryFolder folder_;
};

// The error of an estimate at both ends of the overlap [s].
double worst_error(const ClockEstimate& found, double offset, double drift, double from,
                   double to) {
  const auto error = [&](double time) {
    return std::abs(found.relation.offset - offset + (found.relation.drift - drift) * time);
  };
  return std::max(error(from), error(to));
}

TEST_F(Clocks, FindsNothingWhereThereIsNothing) {
  const ClockEstimate found = estimate(left(), right_with(0));
  EXPECT_EQ(found.relation.offset, 0) << found.explanation;
  EXPECT_EQ(found.relation.drift, 0) << found.explanation;
  EXPECT_TRUE(found.confirmed) << found.explanation;
  EXPECT_THAT(found.explanation, HasSubstr("in step"));
}

TEST_F(Clocks, FindsFourTenthsOfASecondInCompressedVideos) {
  const ClockEstimate found = estimate(write_video(left(), folder_ / "left.mp4", 200),
                                       write_video(right_with(0.4), folder_ / "right.mp4", 200));
  EXPECT_LT(worst_error(found, -0.4, 0, 0.4, kLength), kTenth) << found.explanation;
  EXPECT_EQ(found.relation.drift, 0) << found.explanation;
  EXPECT_TRUE(found.confirmed) << found.explanation;
  EXPECT_THAT(found.explanation, HasSubstr("no drift is found (standard deviation"));
}

TEST_F(Clocks, FindsSevenSecondsAndADrift) {
  // A slower camera, so that the street is long enough: the clocks drift by a seventh of a frame.
  constexpr double kStart = 7.0123, kSlowRate = 10, kDrift = 540e-6;
  constexpr int kMany = 320;
  Shooting slow = street(false, 0);
  slow.scene.camera.velocity = {0, 0, 0.7};
  slow.rate = kSlowRate;
  slow.size = {128, 72};
  slow.frames = kMany;
  const Shot left = shoot(slow);
  slow.right = true;
  slow.start = kStart;
  // The clock of the right recorder is faster: frames are nearer to each other than it says.
  slow.rate = kSlowRate * (1 + kDrift);
  const ClockEstimate found = estimate(left, shoot(slow));
  // What the left one shows at the time t is at (t - kStart) * (1 + kDrift) in the right one.
  EXPECT_LT(worst_error(found, -kStart * (1 + kDrift), kDrift, 7, 32), 0.1 / kSlowRate)
      << found.explanation;
  EXPECT_NEAR(found.relation.drift, kDrift, 180e-6) << found.explanation;
  EXPECT_LT(found.drift_uncertainty.value_or(1), 180e-6) << found.explanation;
  EXPECT_TRUE(found.confirmed) << found.explanation;
}

TEST_F(Clocks, FindsTheOffsetInSpiteOfNoiseAndExposure) {
  const ClockEstimate found = estimate(degraded(left(), 1, 6), degraded(right_with(0.4), 0.6, 6));
  EXPECT_LT(worst_error(found, -0.4, 0, 0.4, kLength), kTenth) << found.explanation;
  EXPECT_EQ(found.relation.drift, 0) << found.explanation;
}

TEST_F(Clocks, FindsTheOffsetInSpiteOfAPause) {
  // All motion stops for two seconds, three seconds after the left recording was started.
  constexpr int kFrom = 36, kPause = 24;
  const Shot stops = changed(left(), [](int number, const cv::Mat& frame) {
    if (number < kFrom) return frame;
    return left()
        .frames[static_cast<std::size_t>(number < kFrom + kPause ? kFrom : number - kPause)];
  });
  // In the right view, that is between two frames of the recording that was started later.
  const Shot stops_too = changed(right_with(0.4), [](int number, const cv::Mat& frame) {
    const double time = 0.4 + number / kRate;
    if (time < kFrom / kRate) return frame;
    if (time < (kFrom + kPause) / kRate) return right_with(0).frames[kFrom];
    return right_with(0.4).frames[static_cast<std::size_t>(number - kPause)];
  });
  const ClockEstimate found = estimate(degraded(stops, 1, 1), degraded(stops_too, 1, 1));
  EXPECT_LT(worst_error(found, -0.4, 0, 0.4, kLength), kTenth) << found.explanation;
}

TEST_F(Clocks, FindsTheOffsetOfAFixedCamera) {
  // Only the walkers and a car move, and they are small.
  Shooting shooting = street(false, 0);
  shooting.scene.camera.velocity = shooting.scene.camera.swing = {0, 0, 0};
  shooting.scene.camera.yaw_swing = 0;
  shooting.size = {256, 144};
  const Shot left = shoot(shooting);
  shooting.right = true;
  shooting.start = 0.4;
  const ClockEstimate found = estimate(left, shoot(shooting));
  EXPECT_LT(worst_error(found, -0.4, 0, 0.4, kLength), kTenth) << found.explanation;
  EXPECT_EQ(found.relation.drift, 0) << found.explanation;
}

TEST_F(Clocks, RefusesStaticRecordings) {
  const auto still = [](int /*number*/, const cv::Mat& /*frame*/) { return left().frames[0]; };
  const Shot both = degraded(changed(left(), still), 1, 3);
  EXPECT_THAT(refusal(both, both), HasSubstr("both recordings are static"));
  EXPECT_THAT(refusal(left(), both), HasSubstr("the right recording is static"));
  EXPECT_THAT(refusal(both, right_with(0)), HasSubstr("--sync"));
}

TEST_F(Clocks, RefusesPeriodicMotion) {
  // Two seconds of the street again and again.
  const auto repeated = [](const Shot& shot) {
    const auto repeat = [&](int number, const cv::Mat& /*frame*/) {
      const int phase = number % 24;
      return shot.frames[static_cast<std::size_t>(phase < 12 ? phase : 24 - phase)];
    };
    return degraded(changed(shot, repeat), 1, 1);
  };
  EXPECT_THAT(refusal(repeated(left()), repeated(right_with(0))), HasSubstr("periodic"));
}

TEST_F(Clocks, RefusesUnrelatedRecordings) {
  Shooting garden = street(true, 0);
  garden.scene = render::make_scene("garden", 1);
  garden.frames = kFrames * 3 / 4;
  EXPECT_THAT(refusal(left(), shoot(garden)), HasSubstr("unrelated"));
}

TEST_F(Clocks, RefusesRecordingsWithoutOverlap) {
  Shot early = left(), late = right_with(0);
  early.frames.resize(kFrames / 2);
  late.frames.erase(late.frames.begin(), late.frames.begin() + kFrames / 2);
  EXPECT_THAT(refusal(early, late), HasSubstr("unrelated"));
}

TEST_F(Clocks, RefusesRecordingsOfSingleFrames) {
  Shot one = left();
  one.frames.resize(2);
  EXPECT_THAT(refusal(one, one), HasSubstr("too few frames"));
}

// More frames than the diagnosis tries without a look at the motion.
TEST_F(Clocks, NameTheFramesThatRecordingsAreOutOfStep) {
  Shot late = right_with(0);
  late.frames.erase(late.frames.begin(), late.frames.begin() + kFrames / 4);
  const std::pair<const Shot*, const char*> shots[] = {{&right_with(0.4), "5 frames earlier"},
                                                       {&late, "24 frames earlier"}};
  for (const auto& [right, text] : shots) {
    Recording recording;
    recording.name = "street";
    recording.left = write_images(left(), folder_ / "left");
    recording.right = write_images(*right, folder_ / text);
    WorkOptions options;
    options.parameters = {{"max-disparity", "16"}};
    const Work work = prepare(recording, options, std::nullopt, false);
    EXPECT_THAT(work.doubt, HasSubstr("not taken at the same time"));
    EXPECT_THAT(work.doubt, HasSubstr(text));
    EXPECT_THAT(work.doubt, HasSubstr("--sync auto"));
  }
}

TEST_F(Clocks, AreNoMatterOfUnrelatedRecordings) {
  Shooting garden = street(true, 0);
  garden.scene = render::make_scene("garden", 1);
  garden.frames = kFrames / 2;
  Recording recording;
  recording.name = "street";
  recording.left = write_images(left(), folder_ / "left");
  recording.right = write_images(shoot(garden), folder_ / "right");
  const Work work = prepare(recording, {}, std::nullopt, false);
  for (const std::string& remark : work.remarks) {
    EXPECT_THAT(remark, Not(HasSubstr("not taken at the same time")));
  }
}

}  // namespace
}  // namespace mtstereo::run::clocks_test
