// SPDX-License-Identifier: LGPL-2.1-or-later
// The rows of the table of situations in docs/alignment.md on real pairs, if MTSTEREO_TEST_DATA
// names a folder with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "recordings/inputs/view_match.hpp"
#include "recordings/matching/view_checks.hpp"

namespace mtstereo::run::diagnosis_data_test {
namespace {

namespace fs = std::filesystem;

struct Data {
  std::string name;
  fs::path left, right;
  int max_disparity;
  std::string calibration{};
};

std::vector<fs::path> sorted(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

cv::Mat small(const fs::path& file) {
  const cv::Mat view = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  cv::Mat result;
  const double scale = std::min(1.0, static_cast<double>(kMatchedWidth) / view.cols);
  cv::resize(view, result, {}, scale, scale, cv::INTER_AREA);
  return result;
}

ViewSamples samples_of(const Data& data) {
  const cv::Mat left = cv::imread(data.left.string(), cv::IMREAD_GRAYSCALE);
  ViewSamples samples;
  samples.scale = std::max(1.0, static_cast<double>(left.cols) / kMatchedWidth);
  samples.max_disparity = data.max_disparity;
  samples.samples.push_back({small(data.left), small(data.right), {}});
  if (!data.calibration.empty()) {
    samples.calibration = *read_calibration(data.calibration, left.cols, left.rows);
  }
  return samples;
}

class RealViews : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* const folder = std::getenv("MTSTEREO_TEST_DATA");
    if (folder == nullptr || !fs::is_directory(fs::path(folder) / "more/kitti_raw")) {
      GTEST_SKIP() << "no real pairs: MTSTEREO_TEST_DATA names no folder with them";
    }
    folder_ = folder;
    for (const char* const group :
         {"middlebury", "eth3d", "more/middlebury_v3_quarter", "more/middlebury2006_third"}) {
      for (const fs::path& pair : sorted(folder_ / group)) {
        data_.push_back({pair.string(), pair / "im0.png", pair / "im1.png", 100});
      }
    }
    add("kitti2015/training", "image_2", "image_3", 128);
    add("more/kitti2015/training", "image_0", "image_1", 128);
    add("kitti_sequence", "image_l", "image_r", 100, 5);
    calibration_ = (folder_ / "more/kitti_raw/calib_cam_to_cam.txt#gray").string();
    const std::size_t raw = data_.size();
    add("more/kitti_raw", "image_00", "image_01", 112);
    for (std::size_t i = raw; i < data_.size(); ++i) data_[i].calibration = calibration_;
  }
  // Every `step`-th pair of a folder.
  void add(const char* folder, const char* left, const char* right, int max_disparity,
           std::size_t step = 1) {
    const std::vector<fs::path> files = sorted(folder_ / folder / left);
    for (std::size_t i = 0; i < files.size(); i += step) {
      data_.push_back({files[i].string(), files[i], folder_ / folder / right / files[i].filename(),
                       max_disparity});
    }
  }
  // Some pairs of all kinds.
  std::vector<Data> some() const {
    std::vector<Data> chosen;
    for (std::size_t i = 0; i < data_.size(); i += 14) chosen.push_back(data_[i]);
    return chosen;
  }

  fs::path folder_;
  std::vector<Data> data_;
  std::string calibration_;
};

void expect(ViewProblem problem, const ViewSamples& samples, const std::string& name) {
  const ViewDiagnosis found = diagnose(samples);
  EXPECT_EQ(found.problem, problem) << name << ": " << diagnosis_text(found, "calibration", true);
}

TEST_F(RealViews, ThatAreGoodHaveNoProblem) {
  EXPECT_GE(data_.size(), 30u);
  for (const Data& data : data_) expect(ViewProblem::kNone, samples_of(data), data.name);
}

TEST_F(RealViews, ThatAreWrongAreNamed) {
  for (const Data& data : some()) {
    const ViewSamples good = samples_of(data);
    ViewSamples wrong = good;
    std::swap(wrong.samples[0].left, wrong.samples[0].right);
    expect(ViewProblem::kSwapped, wrong, data.name);
    wrong.samples[0].right = wrong.samples[0].left;
    expect(ViewProblem::kSameView, wrong, data.name);
    for (const auto& [problem, code] :
         {std::pair(ViewProblem::kUpsideDown, -1), std::pair(ViewProblem::kMirrored, 1),
          std::pair(ViewProblem::kFlipped, 0)}) {
      wrong = samples_of(data);
      cv::Mat turned;
      cv::flip(wrong.samples[0].right, turned, code);
      wrong.samples[0].right = turned;
      expect(problem, wrong, data.name);
    }
  }
}

TEST_F(RealViews, OfDifferentScenesAreNotGivenACause) {
  const std::vector<Data> chosen = some();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    ViewSamples wrong = samples_of(chosen[i]);
    const cv::Mat other = small(chosen[(i + 2) % chosen.size()].right);
    cv::resize(other, wrong.samples[0].right, wrong.samples[0].left.size());
    expect(ViewProblem::kUnknown, wrong, chosen[i].name);
  }
}

TEST_F(RealViews, BeyondTheRangeNameTheRangeThatSuffices) {
  ViewSamples samples = samples_of({"", folder_ / "middlebury/Motorcycle/im0.png",
                                    folder_ / "middlebury/Motorcycle/im1.png", 32});
  const ViewDiagnosis found = diagnose(samples);
  EXPECT_EQ(found.problem, ViewProblem::kRangeTooSmall);
  EXPECT_GE(found.max_disparity, 64);
  EXPECT_LE(found.max_disparity, 80);
  samples.max_disparity = found.max_disparity;
  expect(ViewProblem::kNone, samples, "with the range that suffices");
}

TEST_F(RealViews, ThatAreRawAreNotTakenForExchangedOnes) {
  int raws = 0;
  for (Data data : data_) {
    if (data.calibration.empty() || ++raws % 3 != 0) continue;
    data.calibration.clear();
    ViewSamples raw = samples_of(data);
    expect(ViewProblem::kNotRectified, raw, data.name);
    std::swap(raw.samples[0].left, raw.samples[0].right);
    expect(ViewProblem::kNotRectified, raw, data.name);
  }
}

TEST_F(RealViews, OfOtherCamerasDoNotFitTheCalibration) {
  int raws = 0;
  for (Data data : data_) {
    if (data.calibration.empty() || ++raws % 3 != 0) continue;
    ViewSamples samples = samples_of(data);
    // As if the file were that of a camera with a stronger lens that looks 2 degrees higher.
    samples.calibration->rectification.reset();
    samples.calibration->right.coefficients.assign({-0.1, 0, 0, 0});
    samples.calibration->rotation = {1, 0, 0, 0, 0.99939, -0.0349, 0, 0.0349, 0.99939};
    expect(ViewProblem::kWrongCalibration, samples, data.name);
  }
}

TEST_F(RealViews, OutOfStepAreFoundByTheFramesAround) {
  const std::vector<fs::path> left = sorted(folder_ / "kitti_sequence/image_l"),
                              right = sorted(folder_ / "kitti_sequence/image_r");
  for (const int late : {-2, -1, 0, 1, 2}) {
    ViewSamples samples = samples_of({"", left[8], right[8 + static_cast<std::size_t>(late)], 100});
    for (const int frames : {-3, -2, -1, 1, 2, 3}) {
      samples.samples[0].shifted.push_back(
          {frames, small(right[8 + static_cast<std::size_t>(late + frames)])});
    }
    const ViewDiagnosis found = diagnose(samples);
    EXPECT_EQ(found.problem, late == 0 ? ViewProblem::kNone : ViewProblem::kOutOfStep) << late;
    EXPECT_TRUE(late == 0 || found.frames == -late) << late << ", " << found.frames;
  }
}

}  // namespace
}  // namespace mtstereo::run::diagnosis_data_test
