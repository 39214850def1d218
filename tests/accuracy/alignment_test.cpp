// SPDX-License-Identifier: LGPL-2.1-or-later
// Self-alignment on rendered scenes, whose rows are exact, and on real pairs if MTSTEREO_TEST_DATA
// names a folder with them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "mtstereo/mtstereo.hpp"
#include "tools/eval/datasets.hpp"
#include "tools/render/render.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::tests::alignment_test {
namespace {

namespace fs = std::filesystem;

struct Pair {
  std::string name;
  cv::Mat left;
  cv::Mat right;
  int max_disparity = 100;
};

GrayView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step[0])};
}

AlignmentTracker tracker() { return std::move(AlignmentTracker::create().value()); }

void inspect(AlignmentTracker& tracker, const Pair& pair) {
  EXPECT_TRUE(tracker.watch(view_of(pair.left), view_of(pair.right)).ok());
  EXPECT_TRUE(tracker.inspect(view_of(pair.left), view_of(pair.right), pair.max_disparity).ok());
}

/// The tracker after one inspection of the pair.
AlignmentTracker inspected(const Pair& pair) {
  AlignmentTracker alignment = tracker();
  inspect(alignment, pair);
  return alignment;
}

/// The names of the problems that a tracker reports.
std::string problems_of(const AlignmentTracker& alignment) {
  std::string names;
  for (int i = 0; i < kPairProblems; ++i) {
    const auto problem = static_cast<PairProblem>(i);
    if (alignment.has(problem)) names += std::string(" ") + problem_name(problem);
  }
  return names;
}

/// The right view lowered and rolled about its center.
cv::Mat moved(const cv::Mat& right, double rows, double degrees) {
  cv::Mat turn = cv::getRotationMatrix2D(
      cv::Point2f((right.cols - 1) / 2.0F, (right.rows - 1) / 2.0F), -degrees, 1);
  turn.at<double>(1, 2) += rows;
  cv::Mat out;
  cv::warpAffine(right, out, turn, right.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return out;
}

cv::Mat blurred(const cv::Mat& view, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(view, out, {}, sigma);
  return out;
}

double difference(const RowField& a, const RowField& b, const cv::Mat& view) {
  return RowField{a.offset - b.offset, a.roll - b.roll, a.stretch - b.stretch,
                  a.product - b.product, a.square - b.square}
      .rms(view.cols, view.rows);
}

TEST(RenderedScenes, AreNotCorrected) {
  for (const std::string& name : render::scene_names()) {
    AlignmentTracker alignment = tracker();
    for (const double time : {0.0, 1.0, 2.0}) {
      render::Settings settings;
      settings.width = 480;
      settings.height = 270;
      const render::StereoFrame frame = render::render(render::make_scene(name, 1), time, settings);
      inspect(alignment, {name, frame.left, frame.right, 64});
      EXPECT_EQ(FieldStatus::kTrusted, alignment.findings().status) << name;
      EXPECT_EQ(ViewCorrection(), alignment.correction()) << name;
      EXPECT_EQ("", problems_of(alignment)) << name;
    }
  }
}

class RealPairs : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("MTSTEREO_TEST_DATA");
    if (folder == nullptr || !fs::is_directory(folder)) {
      GTEST_SKIP() << "no real pairs: MTSTEREO_TEST_DATA names no folder with them";
    }
    folder_ = folder;
    add("middlebury", eval::Layout::kMiddlebury, 0);
    add("kitti2015", eval::Layout::kKitti2015, 100);
    add("sceneflow", eval::Layout::kFlyingThings, 192);
    add("eth3d", eval::Layout::kEth3d, 64);
    ASSERT_EQ(pairs_.size(), 10u);
  }

  void add(const char* name, eval::Layout layout, int max_disparity) {
    for (const eval::StereoPair& pair : eval::find_pairs(folder_ / name, layout).pairs) {
      const eval::LoadedPair loaded = eval::load_pair(pair);
      pairs_.push_back({pair.name, loaded.left, loaded.right,
                        max_disparity > 0 ? max_disparity : pair.max_disparity.value()});
    }
  }

  fs::path folder_;
  std::vector<Pair> pairs_;
};

TEST_F(RealPairs, HaveNoProblemsAndSmallFields) {
  for (const Pair& pair : pairs_) {
    const AlignmentTracker alignment = inspected(pair);
    EXPECT_EQ(FieldStatus::kTrusted, alignment.findings().status) << pair.name;
    EXPECT_EQ("", problems_of(alignment)) << pair.name;
    EXPECT_LT(alignment.correction().rows.rms(pair.left.cols, pair.left.rows), 0.35) << pair.name;
    const bool exact = pair.max_disparity == 192;  // the rendered ones
    EXPECT_TRUE(!exact || alignment.correction() == ViewCorrection()) << pair.name;
  }
}

TEST_F(RealPairs, ThatAreMovedAreAligned) {
  double sum = 0;
  for (Pair pair : pairs_) {
    const RowField own = inspected(pair).correction().rows;
    pair.right = moved(pair.right, 1, 0.3);
    RowField expected = own;
    expected.offset += 1;
    expected.roll += std::tan(0.3 * CV_PI / 180) * pair.left.cols / 2;
    const AlignmentTracker alignment = inspected(pair);
    const double error = difference(expected, alignment.correction().rows, pair.left);
    EXPECT_LT(error, 0.15) << pair.name;
    EXPECT_EQ("", problems_of(alignment)) << pair.name;
    sum += error;
  }
  EXPECT_LT(sum / static_cast<double>(pairs_.size()), 0.06);
}

TEST_F(RealPairs, OfUnequalSharpnessAreEvenedOut) {
  for (const double sigma : {1.0, 1.5}) {
    for (Pair pair : pairs_) {
      pair.right = blurred(pair.right, sigma);
      const AlignmentTracker alignment = inspected(pair);
      EXPECT_NEAR(sigma, alignment.correction().left_blur, 0.15) << pair.name;
      EXPECT_EQ(" sharpness-differs", problems_of(alignment)) << pair.name;
      pair.left = blurred(pair.left, sigma);
      EXPECT_EQ(0, inspected(pair).correction().left_blur) << pair.name << ", both blurred";
    }
  }
}

TEST_F(RealPairs, ThatAreSwappedAreRecognizedAndNotCorrected) {
  for (Pair pair : pairs_) {
    std::swap(pair.left, pair.right);
    const AlignmentTracker alignment = inspected(pair);
    EXPECT_EQ(" swapped", problems_of(alignment)) << pair.name;
    EXPECT_EQ(ViewCorrection(), alignment.correction()) << pair.name;
  }
}

TEST_F(RealPairs, ThatDoNotBelongTogetherAreRecognizedAndNotCorrected) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Pair other = pairs_[i], turned = pairs_[i];
    cv::resize(pairs_[(i + 1) % pairs_.size()].right, other.right, other.left.size());
    cv::Mat upside_down;
    cv::flip(turned.right, upside_down, -1);
    turned.right = upside_down;
    for (const Pair& pair : {other, turned}) {
      AlignmentTracker alignment = tracker();
      for (int k = 0; k < 3; ++k) inspect(alignment, pair);
      EXPECT_EQ(" not-a-pair", problems_of(alignment)) << pair.name;
      EXPECT_EQ(ViewCorrection(), alignment.correction()) << pair.name;
    }
  }
}

class Sequence : public testing::Test {
 protected:
  static constexpr int kFrames = 20;

  void SetUp() override {
    const char* folder = std::getenv("MTSTEREO_TEST_DATA");
    if (folder == nullptr || !fs::is_directory(fs::path(folder) / "kitti_sequence")) {
      GTEST_SKIP() << "no sequence: MTSTEREO_TEST_DATA names no folder with one";
    }
    for (int i = 0; i < kFrames; ++i) {
      const std::string number = std::to_string(1000000 + i).substr(1);
      const auto read = [&](const char* side) {
        const fs::path path = fs::path(folder) / "kitti_sequence" / side / (number + ".png");
        return cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
      };
      frames_.push_back({number, read("image_l"), read("image_r"), 100});
      ASSERT_FALSE(frames_.back().left.empty() || frames_.back().right.empty()) << number;
    }
  }

  double density(const Pair& pair, const ViewCorrection& correction) {
    Parameters parameters;
    EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, pair.max_disparity).ok());
    Matcher matcher = std::move(Matcher::create(parameters).value());
    EXPECT_TRUE(matcher.set_correction(correction).ok());
    const auto result = matcher.compute(view_of(pair.left), view_of(pair.right));
    EXPECT_TRUE(result.ok());
    return result.ok() ? 100 * result->statistics.density : 0;
  }

  std::vector<Pair> frames_;
};

TEST_F(Sequence, IsAlignedSteadilyAndGainsDensity) {
  AlignmentTracker alignment = tracker();
  for (const Pair& pair : frames_) {
    inspect(alignment, pair);
    EXPECT_NEAR(5.2, alignment.correction().rows.product, 0.5);
    EXPECT_TRUE(alignment.trusted());
    EXPECT_EQ("", problems_of(alignment));
  }
  EXPECT_GE(alignment.views(), 6);
  double gain = 0;
  for (const int frame : {0, 10, 19}) {
    gain += density(frames_[frame], alignment.correction()) - density(frames_[frame], {});
  }
  EXPECT_GT(gain / 3, 3.6) << "points";
}

TEST_F(Sequence, OutOfStepIsRecognizedAndNotCorrected) {
  for (const int late : {1, 2, 3}) {
    AlignmentTracker alignment = tracker();
    for (int i = 0; i + late < kFrames; ++i) {
      Pair pair = frames_[i];
      pair.right = frames_[i + late].right;
      inspect(alignment, pair);
      EXPECT_EQ(RowField(), alignment.correction().rows) << late << ", " << i;
    }
    EXPECT_EQ(" out-of-step", problems_of(alignment)) << late;
  }
}

}  // namespace
}  // namespace mtstereo::tests::alignment_test
