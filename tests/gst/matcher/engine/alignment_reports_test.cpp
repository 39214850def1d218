// SPDX-License-Identifier: LGPL-2.1-or-later
// Warnings about pairs with a problem, rendered and real ones; and none about good pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "support/rendered.hpp"
#include "support/sanitizers.hpp"
#include "tools/eval/datasets.hpp"

namespace mtstereo::test::alignment_reports_test {
namespace {

namespace fs = std::filesystem;

/// Every pair is inspected, so that short clips suffice. The maps do not matter.
const std::string kProperties = "preset=fast max-disparity=64 alignment-interval=1";

/// The warnings about a clip, and the problems that `stats` names at its end.
struct Reaction {
  std::vector<std::string> warnings;
  std::string problems;
};

Reaction reaction_to(const std::vector<Pair>& pairs, const std::string& properties = "") {
  StereoHarness harness(kProperties + " " + properties);
  harness.caps(raw_caps("GRAY8", pairs[0].left.width, pairs[0].left.height));
  match_all(harness, pairs);
  Reaction reaction;
  for (const Report& report : harness.warnings()) reaction.warnings.push_back(report.text);
  reaction.problems = gst_structure_get_string(stats_structure(harness.element()).get(), "problem");
  EXPECT_EQ(harness.further_errors(0), 0);
  return reaction;
}

void expect_only(PairProblem problem, const std::vector<Pair>& pairs,
                 const std::string& properties = "") {
  const Reaction reaction = reaction_to(pairs, properties);
  EXPECT_EQ(reaction.warnings, std::vector<std::string>{problem_text(problem)});
  EXPECT_EQ(reaction.problems, problem_name(problem));
}

void expect_none(const std::vector<Pair>& pairs, const std::string& name) {
  const Reaction reaction = reaction_to(pairs);
  EXPECT_EQ(reaction.warnings, std::vector<std::string>{}) << name;
  EXPECT_EQ(reaction.problems, "") << name;
}

/// Changes every pair of a clip.
template <typename Change>
std::vector<Pair> changed(std::vector<Pair> pairs, Change change) {
  for (Pair& pair : pairs) change(pair);
  return pairs;
}

/// Left views from one time on, right views from another.
std::vector<Pair> apart(const std::vector<Pair>& pairs, std::size_t frames) {
  std::vector<Pair> result;
  for (std::size_t i = 0; i + frames < pairs.size(); ++i) {
    result.push_back({pairs[i].left, pairs[i + frames].right});
  }
  return result;
}

void blacken(GrayImage& image) {
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{0});
}

// --- rendered pairs ---

/// Eight pairs of good cameras, which are rendered once.
const std::vector<Pair>& clip(const std::string& scene) {
  static std::map<std::string, std::vector<Pair>> clips;
  std::vector<Pair>& pairs = clips[scene];
  if (pairs.empty()) pairs = rendered_pairs(scene, 8, 0.2);
  return pairs;
}

const std::vector<Pair>& street() { return clip("street"); }

class GoodScene : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (kSanitized && GetParam() != std::string("street")) {
      GTEST_SKIP() << "one scene suffices with a sanitizer";
    }
  }
};

TEST_P(GoodScene, CausesNoWarning) { expect_none(clip(GetParam()), "good cameras"); }

TEST_P(GoodScene, CausesNoWarningFromABadSensor) {
  render::Settings settings = rendered_settings();
  settings.noise = 3, settings.shot_noise = 0.05, settings.vignette = 0.3, settings.exposure = 0.8;
  expect_none(rendered_pairs(GetParam(), 5, 0.2, settings), "noise");
  settings.jpeg = 40;
  expect_none(rendered_pairs(GetParam(), 5, 0.2, settings), "compression");
}

TEST_P(GoodScene, CausesNoWarningIfItIsOutOfLine) {
  render::Rig rig;
  rig.row_offset = 2, rig.roll = 0.3;
  expect_none(rendered_pairs(GetParam(), 5, 0.2, rendered_settings(rig)), "out of line");
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoodScene, testing::Values("street", "garden", "room"));

// Feature: exchanged views are detected
TEST(Warning, NamesSwappedViews) {
  for (const std::string& scene : render::scene_names()) {
    const auto first = clip(scene).begin();
    expect_only(PairProblem::kSwapped,
                changed({first, first + 4}, [](Pair& pair) { std::swap(pair.left, pair.right); }));
  }
}

TEST(Warning, NamesViewsOfDifferentScenes) {
  std::vector<Pair> pairs = street();
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].right = clip("room")[i].right;
  expect_only(PairProblem::kNotAPair, pairs);
}

TEST(Warning, NamesViewsOfDifferentTimes) {
  // A single pair of moving cameras that is out of step can look swapped at first.
  const Reaction reaction = reaction_to(apart(rendered_pairs("street", 10, 0.25), 2));
  ASSERT_FALSE(reaction.warnings.empty());
  EXPECT_EQ(reaction.warnings.back(), problem_text(PairProblem::kOutOfStep));
  EXPECT_EQ(reaction.problems, problem_name(PairProblem::kOutOfStep));
}

TEST(Warning, NamesABlurredView) {
  expect_only(PairProblem::kSharpnessDiffers,
              changed(street(), [](Pair& pair) { pair.right = blurred(pair.right, 1.5); }));
  expect_only(PairProblem::kSharpnessDiffers,
              changed(street(), [](Pair& pair) { pair.left = blurred(pair.left, 1.5); }));
}

TEST(Warning, NamesABlackView) {
  expect_only(PairProblem::kLeftBlank, changed(street(), [](Pair& pair) { blacken(pair.left); }));
  expect_only(PairProblem::kRightBlank, changed(street(), [](Pair& pair) { blacken(pair.right); }));
}

TEST(Warning, NamesOneStreamOnBothPads) {
  const Reaction reaction =
      reaction_to(changed(street(), [](Pair& pair) { pair.right = pair.left; }));
  ASSERT_EQ(reaction.warnings.size(), 1u);
  EXPECT_NE(reaction.warnings[0].find("the same image"), std::string::npos);
  EXPECT_EQ(reaction.problems, "one-image");
}

TEST(Warning, IsNotPostedForEqualViewsWithoutContent) {
  const auto black = [](Pair& pair) {
    blacken(pair.left);
    blacken(pair.right);
  };
  expect_none(changed(street(), black), "black");
}

TEST(Warning, NamesAFrozenView) {
  const std::vector<Pair> pairs = rendered_pairs("street", 12, 0.02);
  const Pair still = pairs[0];
  // With an inspection of every pair, they are found to be out of step first.
  expect_only(PairProblem::kLeftFrozen, changed(pairs, [&](Pair& pair) { pair.left = still.left; }),
              "alignment-interval=30");
  expect_only(PairProblem::kRightFrozen,
              changed(pairs, [&](Pair& pair) { pair.right = still.right; }),
              "alignment-interval=30");
}

TEST(Warning, IsRepeatedOnlyAfterTheProblemDisappeared) {
  StereoHarness harness(kProperties);
  harness.caps(raw_caps("GRAY8", kRenderedWidth, kRenderedHeight));
  const std::vector<Pair> wrong =
      changed(street(), [](Pair& pair) { std::swap(pair.left, pair.right); });
  GstClockTime time = 0;
  const auto warnings = [&](const std::vector<Pair>& pairs) {
    match_all(harness, pairs, time);
    time += pairs.size() * kFrame;
    return harness.warnings().size();
  };
  EXPECT_EQ(warnings(wrong), 1u);
  EXPECT_EQ(warnings(wrong), 0u);
  EXPECT_EQ(warnings(street()), 0u);
  EXPECT_EQ(warnings(wrong), 1u);
}

TEST(Warning, IsPostedByMonitorToo) {
  EXPECT_EQ(reaction_to({swapped(street()[0])}, "alignment=monitor").warnings.size(), 1u);
}

TEST(Warning, IsNotPostedWithoutInspection) {
  EXPECT_TRUE(reaction_to({swapped(street()[0])}, "alignment=off").warnings.empty());
  EXPECT_TRUE(reaction_to({swapped(street()[0])}, "preset=paper").warnings.empty());
}

// --- real pairs ---

class RealStreams : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "real pairs take too long with a sanitizer";
    const char* folder = std::getenv("MTSTEREO_TEST_DATA");
    if (folder == nullptr || !fs::is_directory(folder)) {
      GTEST_SKIP() << "no real pairs: MTSTEREO_TEST_DATA names no folder with them";
    }
    folder_ = folder;
  }

  /// The ten pairs with ground truth.
  std::vector<Pair> still_pairs() const {
    const std::pair<const char*, eval::Layout> collections[] = {
        {"middlebury", eval::Layout::kMiddlebury},
        {"kitti2015", eval::Layout::kKitti2015},
        {"sceneflow", eval::Layout::kFlyingThings},
        {"eth3d", eval::Layout::kEth3d}};
    std::vector<Pair> pairs;
    for (const auto& [name, layout] : collections) {
      for (const eval::StereoPair& files : eval::find_pairs(folder_ / name, layout).pairs) {
        const eval::LoadedPair loaded = eval::load_pair(files);
        pairs.push_back(pair_of(loaded.left, loaded.right));
      }
    }
    EXPECT_EQ(pairs.size(), 10u);
    return pairs;
  }

  std::vector<Pair> sequence() const {
    std::vector<Pair> pairs;
    for (int i = 0; i < 20; ++i) {
      const std::string name = (i < 10 ? "00000" : "0000") + std::to_string(i) + ".png";
      const auto read = [&](const char* side) {
        return cv::imread((folder_ / "kitti_sequence" / side / name).string(),
                          cv::IMREAD_GRAYSCALE);
      };
      pairs.push_back(pair_of(read("image_l"), read("image_r")));
    }
    return pairs;
  }

  fs::path folder_;
};

// Feature: misaligned rows are detected and corrected
TEST_F(RealStreams, CauseNoWarningIfTheyAreGood) {
  int number = 0;
  for (const Pair& pair : still_pairs()) {
    expect_none(std::vector<Pair>(4, pair), "pair " + std::to_string(number++));
  }
  expect_none(sequence(), "sequence");
}

// Feature: exchanged views are detected
TEST_F(RealStreams, CauseAWarningIfTheViewsAreSwapped) {
  for (const Pair& pair : still_pairs()) {
    expect_only(PairProblem::kSwapped, std::vector<Pair>(4, swapped(pair)));
  }
}

}  // namespace
}  // namespace mtstereo::test::alignment_reports_test
