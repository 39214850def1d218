// SPDX-License-Identifier: LGPL-2.1-or-later
// The accuracy that was reached, kept: on rendered scenes everywhere, and on real pairs with ground
// truth where MTSTEREO_TEST_DATA names a folder that has them. Everything goes through the element.
#include <gst/gst.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "element_matcher.hpp"
#include "eval/datasets.hpp"
#include "eval/metrics.hpp"
#include "render/render.hpp"
#include "render/scene.hpp"

namespace mtstereo::tests {
namespace {

namespace fs = std::filesystem;

/// Means over pairs, and what they have to keep.
struct Figures {
  double avgerr;   ///< [px]
  double d_all;    ///< [%]
  double density;  ///< [%]
};

void expect_kept(const eval::Evaluation& mean, const Figures& limit) {
  EXPECT_LE(mean.all.avgerr, limit.avgerr);
  EXPECT_LE(mean.all.d_all, limit.d_all);
  EXPECT_GE(mean.density, limit.density);
  std::printf("  avgerr %.3f px, D-all %.2f %%, density %.2f %%\n", mean.all.avgerr, mean.all.d_all,
              mean.density);
}

eval::Evaluation mean_of(const std::vector<eval::Evaluation>& evaluations) {
  std::vector<eval::WeightedEvaluation> weighted;
  for (const eval::Evaluation& evaluation : evaluations) weighted.push_back({&evaluation, 1});
  return eval::mean(weighted);
}

/// Both modes' limits of one collection of pairs.
struct Gate {
  const char* mode;
  Figures limit;
};

eval::Evaluation evaluate_pair(const cv::Mat& left, const cv::Mat& right,
                               const eval::GroundTruth& truth, const std::string& mode,
                               int max_disparity) {
  const cv::Mat disparity = match_with_element(
      left, right, "mode=" + mode + " max-disparity=" + std::to_string(max_disparity));
  EXPECT_FALSE(disparity.empty()) << "the element gave nothing";
  return disparity.empty() ? eval::Evaluation{} : eval::evaluate(disparity, truth);
}

class RenderedScenes : public testing::TestWithParam<Gate> {};

TEST_P(RenderedScenes, KeepTheirAccuracy) {
  std::vector<eval::Evaluation> evaluations;
  for (const std::string& name : render::scene_names()) {
    for (const double time : {0.0, 1.0}) {
      render::Settings settings;
      settings.width = 480;
      settings.height = 270;
      const render::StereoFrame frame = render::render(render::make_scene(name, 1), time, settings);
      eval::GroundTruth truth{frame.truth, {}};
      for (float& disparity : cv::Mat_<float>(truth.disparity)) {
        if (!std::isfinite(disparity)) disparity = std::numeric_limits<float>::quiet_NaN();
      }
      evaluations.push_back(evaluate_pair(frame.left, frame.right, truth, GetParam().mode, 64));
    }
  }
  expect_kept(mean_of(evaluations), GetParam().limit);
}

// Reached with the paper's parameters: 0.641 px, 6.06 %, 12.2 % and 1.09 px, 10.9 %, 44.8 %.
INSTANTIATE_TEST_SUITE_P(BothModes, RenderedScenes,
                         testing::Values(Gate{"sparse", {0.66, 6.3, 12.0}},
                                         Gate{"semi-dense", {1.12, 11.2, 44.0}}),
                         [](const auto& info) {
                           return info.param.mode == std::string("sparse") ? "Sparse" : "SemiDense";
                         });

class RealPairs : public testing::TestWithParam<Gate> {};

TEST_P(RealPairs, KeepTheirAccuracy) {
  const char* folder = std::getenv("MTSTEREO_TEST_DATA");
  if (folder == nullptr || !fs::is_directory(folder)) {
    GTEST_SKIP() << "no pairs with ground truth here: MTSTEREO_TEST_DATA names none";
  }
  struct Collection {
    const char* folder;
    eval::Layout layout;
    int max_disparity;  ///< where the data set does not tell [px]
  };
  const Collection collections[] = {{"middlebury", eval::Layout::kMiddlebury, 0},
                                    {"kitti2015", eval::Layout::kKitti2015, 100},
                                    {"sceneflow", eval::Layout::kFlyingThings, 192},
                                    {"eth3d", eval::Layout::kEth3d, 64}};
  std::vector<eval::Evaluation> evaluations;
  for (const Collection& collection : collections) {
    const eval::DataSet set =
        eval::find_pairs(fs::path(folder) / collection.folder, collection.layout);
    EXPECT_TRUE(set.problems.empty());
    for (const eval::StereoPair& pair : set.pairs) {
      const eval::LoadedPair loaded = eval::load_pair(pair);
      const int range =
          collection.max_disparity > 0 ? collection.max_disparity : pair.max_disparity.value();
      evaluations.push_back(
          evaluate_pair(loaded.left, loaded.right, loaded.truth, GetParam().mode, range));
    }
  }
  ASSERT_EQ(evaluations.size(), 10u);
  expect_kept(mean_of(evaluations), GetParam().limit);
}

// Reached with the paper's parameters: 0.834 px, 4.18 %, 10.3 % and 1.78 px, 10.5 %, 45.9 %.
INSTANTIATE_TEST_SUITE_P(BothModes, RealPairs,
                         testing::Values(Gate{"sparse", {0.86, 4.3, 10.1}},
                                         Gate{"semi-dense", {1.83, 10.8, 45.2}}),
                         [](const auto& info) {
                           return info.param.mode == std::string("sparse") ? "Sparse" : "SemiDense";
                         });

}  // namespace
}  // namespace mtstereo::tests

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  gst_init(&argc, &argv);
  return RUN_ALL_TESTS();
}
