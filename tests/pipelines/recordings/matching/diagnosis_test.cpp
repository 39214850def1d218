// SPDX-License-Identifier: LGPL-2.1-or-later
// The rows of the table of situations in docs/alignment.md, on rendered cameras; real ones are in
// diagnosis_data_test.cpp.
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "recordings/inputs/view_rectifier.hpp"
#include "recordings/matching/view_checks.hpp"
#include "recordings/support/rig_views.hpp"

namespace mtstereo::run {

// For the messages of the tests.
void PrintTo(const ViewDiagnosis& found, std::ostream* out) {
  *out << diagnosis_text(found, "calibration", true) << " (" << found.matched << ", "
       << found.better << ")";
}

}  // namespace mtstereo::run

namespace mtstereo::run::diagnosis_test {
namespace {

using testing::random_rig;
using testing::raw_views;
using testing::RawViews;

constexpr const char* kScenes[] = {"street", "garden", "room"};

ViewSamples samples_of(const RawViews& views, const StereoCalibration& rig) {
  ViewSamples samples;
  samples.samples.push_back({views.left, views.right, {}});
  samples.max_disparity = 96;
  samples.calibration = rig;
  return samples;
}

class Rigs : public ::testing::TestWithParam<int> {
 protected:
  StereoCalibration rig_ = random_rig(GetParam());
  RawViews views_ = raw_views(rig_, kScenes[GetParam() % 3]);
  ViewSamples samples_ = samples_of(views_, rig_);

  void expect(ViewProblem problem) const {
    const ViewDiagnosis found = diagnose(samples_);
    EXPECT_EQ(found.problem, problem) << ::testing::PrintToString(found);
    EXPECT_EQ(diagnosis_text(found, "file", true).empty(), problem == ViewProblem::kNone);
  }
  ViewSample& sample() { return samples_.samples.front(); }
};

class GoodRigs : public Rigs {};

TEST_P(GoodRigs, HaveNoProblem) { expect(ViewProblem::kNone); }

INSTANTIATE_TEST_SUITE_P(Random, GoodRigs, ::testing::Range(0, 32));

class WrongViews : public Rigs {};

TEST_P(WrongViews, Exchanged) {
  std::swap(sample().left, sample().right);
  expect(ViewProblem::kSwapped);
}

TEST_P(WrongViews, OfDifferentScenes) {
  sample().right = raw_views(rig_, kScenes[(GetParam() + 1) % 3]).right;
  expect(ViewProblem::kUnknown);
}

TEST_P(WrongViews, TheSameTwice) {
  sample().right = sample().left;
  expect(ViewProblem::kSameView);
  std::vector<unsigned char> coded;
  cv::imencode(".jpg", sample().left, coded, {cv::IMWRITE_JPEG_QUALITY, 80});
  const cv::Mat again = cv::imdecode(coded, cv::IMREAD_GRAYSCALE);
  for (const double range : {1.0, 219 / 255.0}) {
    cv::Mat right;
    again.convertTo(right, CV_8U, range, range < 1 ? 16 : 0);
    sample().right = right;
    EXPECT_GT(cv::norm(sample().left, sample().right, cv::NORM_L1), sample().left.total());
    expect(ViewProblem::kSameView);
  }
}

TEST_P(WrongViews, Turned) {
  const cv::Mat right = sample().right;
  for (const auto& [problem, code] :
       {std::pair(ViewProblem::kUpsideDown, -1), std::pair(ViewProblem::kMirrored, 1),
        std::pair(ViewProblem::kFlipped, 0)}) {
    cv::Mat turned;
    cv::flip(right, turned, code);
    sample().right = turned;
    expect(problem);
  }
}

TEST_P(WrongViews, NotRectified) {
  samples_.calibration.reset();
  expect(ViewProblem::kNotRectified);
  std::swap(sample().left, sample().right);
  expect(ViewProblem::kNotRectified);
}

TEST_P(WrongViews, RectifiedForOtherCameras) {
  samples_.calibration = random_rig(GetParam() + 2);
  expect(ViewProblem::kWrongCalibration);
}

TEST_P(WrongViews, WithoutTexture) {
  sample().left.setTo(90);
  sample().right.setTo(90);
  expect(ViewProblem::kTooLittleTexture);
}

INSTANTIATE_TEST_SUITE_P(Random, WrongViews, ::testing::Values(1, 3));

TEST(SmallRange, IsFoundWithTheOneThatSuffices) {
  const StereoCalibration rig = random_rig(1);
  ViewSamples samples = samples_of(raw_views(rig, "garden"), rig);
  samples.max_disparity = 3;
  const ViewDiagnosis found = diagnose(samples);
  EXPECT_EQ(found.problem, ViewProblem::kRangeTooSmall) << ::testing::PrintToString(found);
  samples.max_disparity = found.max_disparity;
  EXPECT_EQ(diagnose(samples).problem, ViewProblem::kNone);
}

TEST(Rows, FarOffEverywhereAreNamed) {
  const StereoCalibration rig = random_rig(1);
  const RawViews raw = raw_views(rig, "garden");
  const cv::Mat left = ViewRectifier(rig, Rectifier::Side::kLeft).apply(raw.left);
  const cv::Mat right = ViewRectifier(rig, Rectifier::Side::kRight).apply(raw.right);
  constexpr int kLower = 14;
  cv::Mat lower(right.size(), CV_8U, cv::Scalar(0));
  right.rowRange(0, right.rows - kLower).copyTo(lower.rowRange(kLower, right.rows));
  ViewSamples samples = samples_of({left, lower}, rig);
  samples.calibration.reset();
  const ViewDiagnosis found = diagnose(samples);
  EXPECT_EQ(found.problem, ViewProblem::kNotRectified) << ::testing::PrintToString(found);
  EXPECT_NEAR(found.least_rows, kLower, 1);
  EXPECT_NEAR(found.most_rows, kLower, 1);
}

// The moving scene; frames are 0.2 s apart.
TEST(Steps, AreFound) {
  const StereoCalibration rig = random_rig(0);
  constexpr double kStep = 0.2;
  const auto at = [&](int frame) { return raw_views(rig, "street", kStep * frame); };
  for (const int late : {-2, 1}) {
    ViewSamples samples = samples_of({at(3).left, at(3 + late).right}, rig);
    for (const int frames : {-2, -1, 1, 2}) {
      samples.samples[0].shifted.push_back({frames, at(3 + late + frames).right});
    }
    const ViewDiagnosis found = diagnose(samples);
    EXPECT_EQ(found.problem, ViewProblem::kOutOfStep) << ::testing::PrintToString(found);
    EXPECT_EQ(found.frames, -late);
  }
}

}  // namespace
}  // namespace mtstereo::run::diagnosis_test
