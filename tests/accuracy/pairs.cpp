// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "element_matcher.hpp"
#include "tools/render/render.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::tests {
namespace {

namespace fs = std::filesystem;

struct Collection {
  const char* folder;
  eval::Layout layout;
  int max_disparity;  ///< if the data set does not state it [px]
};

std::vector<eval::StereoPair> pairs_of(const fs::path& folder,
                                       const std::vector<Collection>& collections) {
  std::vector<eval::StereoPair> pairs;
  for (const Collection& collection : collections) {
    eval::DataSet set = eval::find_pairs(folder / collection.folder, collection.layout);
    EXPECT_TRUE(set.problems.empty());
    for (eval::StereoPair& pair : set.pairs) {
      if (collection.max_disparity > 0) pair.max_disparity = collection.max_disparity;
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

}  // namespace

std::string data_folder() {
  const char* folder = std::getenv("MTSTEREO_TEST_DATA");
  return folder != nullptr && fs::is_directory(folder) ? folder : "";
}

std::vector<eval::StereoPair> ten_pairs(const std::string& folder) {
  return pairs_of(folder, {{"middlebury", eval::Layout::kMiddlebury, 0},
                           {"kitti2015", eval::Layout::kKitti2015, 100},
                           {"sceneflow", eval::Layout::kFlyingThings, 192},
                           {"eth3d", eval::Layout::kEth3d, 64}});
}

std::vector<eval::StereoPair> further_pairs(const std::string& folder) {
  return pairs_of(fs::path(folder) / "more",
                  {{"middlebury_v3_quarter", eval::Layout::kMiddlebury, 0},
                   {"middlebury2006_third", eval::Layout::kMiddlebury, 0},
                   {"kitti2015", eval::Layout::kKitti2015, 128}});
}

render::Settings rendered_settings(const std::string& scene) {
  render::Settings settings;
  settings.width = 480;
  settings.height = 270;
  return render::complete(render::make_scene(scene, 1), settings);
}

namespace {

eval::LoadedPair render_pair(const std::string& scene, double time) {
  const render::StereoFrame frame =
      render::render(render::make_scene(scene, 1), time, rendered_settings(scene));
  eval::LoadedPair pair{frame.left, frame.right, {frame.truth, {}}};
  for (float& disparity : cv::Mat_<float>(pair.truth.disparity)) {
    if (!std::isfinite(disparity)) disparity = std::numeric_limits<float>::quiet_NaN();
  }
  return pair;
}

}  // namespace

const eval::LoadedPair& rendered_pair(const std::string& scene, double time) {
  static std::map<std::pair<std::string, double>, eval::LoadedPair> rendered;
  const auto [place, missing] = rendered.try_emplace({scene, time});
  if (missing) place->second = render_pair(scene, time);
  return place->second;
}

eval::Evaluation mean_of(const std::vector<eval::Evaluation>& evaluations) {
  std::vector<eval::WeightedEvaluation> weighted;
  for (const eval::Evaluation& evaluation : evaluations) weighted.push_back({&evaluation, 1});
  return eval::mean(weighted);
}

eval::Evaluation evaluate_with_element(const eval::LoadedPair& pair, const std::string& properties,
                                       int max_disparity) {
  const cv::Mat disparity = match_with_element(
      pair.left, pair.right, properties + " max-disparity=" + std::to_string(max_disparity));
  EXPECT_FALSE(disparity.empty()) << "the element gave no result";
  return disparity.empty() ? eval::Evaluation{} : eval::evaluate(disparity, pair);
}

}  // namespace mtstereo::tests
