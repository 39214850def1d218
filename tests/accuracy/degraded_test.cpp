// SPDX-License-Identifier: LGPL-2.1-or-later
// Regression tests of the accuracy on degraded images, as cameras deliver them: on real pairs with
// ground truth, in builds without a sanitizer, and on rendered scenes. All pairs are matched by the
// element; for the density at equal error by the library, whose confidence is swept. After a change
// of the matcher, "degraded-test | grep '^    {'" in a release build prints all rows of both tables
// of degraded_figures.hpp, in their order.
#include <gst/gst.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "degraded_figures.hpp"
#include "pairs.hpp"
#include "support/sanitizers.hpp"
#include "tools/eval/curve_means.hpp"
#include "tools/eval/degrade.hpp"
#include "tools/eval/runner.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::tests::degraded_test {
namespace {

/// How far the figures may be from those in the table.
struct Margins {
  double error;    ///< share of an error
  double avgerr;   ///< in addition [px]
  double d_all;    ///< in addition [points]
  double density;  ///< [points]
  double flat;     ///< share of the pixels in flat areas
};
constexpr Margins kRealMargins{0.04, 0.005, 0.05, 0.6, 0.05};
// Compilers round the colors of rendered scenes differently.
constexpr Margins kRenderedMargins{0.1, 0.01, 0.15, 1.5, 0.1};
constexpr double kFlatPixels = 100;  // in addition

/// Pairs that are read or rendered once for all kinds and modes, or degraded once for all modes.
using Images = std::vector<eval::DegradedPair>;

Images load(const std::vector<eval::StereoPair>& pairs, std::size_t count) {
  EXPECT_EQ(pairs.size(), count);
  Images images;
  for (const eval::StereoPair& pair : pairs) {
    images.push_back({eval::load_pair(pair), pair.max_disparity.value()});
  }
  return images;
}

/// The real pairs of a set.
std::vector<eval::StereoPair> real_pairs(Pairs pairs) {
  return pairs == Pairs::kTen ? ten_pairs(data_folder()) : further_pairs(data_folder());
}

Images images_of(Pairs pairs) {
  if (pairs == Pairs::kTen) return load(real_pairs(pairs), 10);
  if (pairs == Pairs::kFurther) return load(real_pairs(pairs), 17);
  Images images;
  for (const std::string& scene : render::scene_names()) {
    images.push_back({rendered_pair(scene, 0), 64});
  }
  return images;
}

/// The images of a degradation, made once for all modes.
class DegradedImages {
 public:
  const Images& get(Pairs pairs, const std::string& kind) {
    const std::pair key(pairs, kind);
    if (key == key_) return degraded_;
    if (!clean_.contains(pairs)) clean_.emplace(pairs, images_of(pairs));
    degraded_.clear();
    key_ = key;
    if (kind == eval::kCleanKind) return degraded_ = clean_.at(pairs);
    for (const eval::DegradedPair& pair : clean_.at(pairs)) {
      degraded_.push_back(
          eval::degrade(eval::parse_degradation(kind), pair.images, pair.max_disparity));
    }
    return degraded_;
  }

 private:
  std::map<Pairs, Images> clean_;
  std::pair<Pairs, std::string> key_;
  Images degraded_;
};

/// Prints the measured figures as a row of the table.
void print_row(const DegradedFigures& row, const eval::Evaluation& mean) {
  std::printf("    {%s, \"%s\", \"%s\", %.3f, %.2f, %.1f, %lld},\n", code_of(row.pairs), row.kind,
              row.properties, mean.all.avgerr, mean.all.d_all, mean.density,
              static_cast<long long>(mean.flat_answers.value_or(0)));
}

/// The reason why a set cannot be matched here; empty if it can.
std::string obstacle_of(Pairs pairs) {
  if (pairs == Pairs::kRendered) return "";
  if (test::kSanitized) return "real pairs take too long with a sanitizer";
  if (!data_folder().empty()) return "";
  return "no pairs with ground truth: MTSTEREO_TEST_DATA names no folder with them";
}

class Degraded : public testing::TestWithParam<DegradedFigures> {
 protected:
  void SetUp() override {
    const std::string obstacle = obstacle_of(GetParam().pairs);
    if (!obstacle.empty()) GTEST_SKIP() << obstacle;
    if (GetParam().kind == std::string(eval::kCleanKind)) return;
    const auto missing = eval::degradation_obstacle(eval::parse_degradation(GetParam().kind));
    if (missing) GTEST_SKIP() << *missing;
  }
  static DegradedImages images_;
};

DegradedImages Degraded::images_;

// Feature: accuracy tests
TEST_P(Degraded, KeepTheirAccuracy) {
  const DegradedFigures& row = GetParam();
  std::vector<eval::Evaluation> evaluations;
  for (const eval::DegradedPair& pair : images_.get(row.pairs, row.kind)) {
    evaluations.push_back(evaluate_with_element(pair.images, row.properties, pair.max_disparity));
  }
  const eval::Evaluation mean = mean_of(evaluations);
  print_row(row, mean);
  const Margins& margin = row.pairs == Pairs::kRendered ? kRenderedMargins : kRealMargins;
  EXPECT_LE(mean.all.avgerr, row.avgerr * (1 + margin.error) + margin.avgerr);
  EXPECT_LE(mean.all.d_all, row.d_all * (1 + margin.error) + margin.d_all);
  EXPECT_GE(mean.density, row.density - margin.density);
  EXPECT_LE(static_cast<double>(mean.flat_answers.value()),
            static_cast<double>(row.flat_answers) * (1 + margin.flat) + kFlatPixels);
}

std::string name_of(const testing::TestParamInfo<DegradedFigures>& info) {
  const DegradedFigures& row = info.param;
  const std::string pairs = code_of(row.pairs);
  std::string name = pairs.substr(pairs.find("::k") + 3) + "_" + row.kind + "_" + row.properties;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class EqualError : public testing::TestWithParam<Pairs> {
 protected:
  void SetUp() override {
    const std::string obstacle = obstacle_of(GetParam());
    if (!obstacle.empty()) GTEST_SKIP() << obstacle;
  }
};

// Feature: accuracy tests
TEST_P(EqualError, KeepsTheDensity) {
  std::vector<EqualErrorFigures> rows;
  std::map<std::string, eval::CurveCollector> collectors;
  eval::RunSettings settings;
  settings.warm_up = 0;
  settings.curve = true;
  ASSERT_TRUE(settings.parameters.set("min-confidence", "0").ok());
  for (const EqualErrorFigures& row : kEqualErrorFigures) {
    if (row.pairs != GetParam()) continue;
    rows.push_back(row);
    collectors.emplace(row.kind, std::vector<std::string>{eval::kOwnMethod});
    if (row.kind == std::string(eval::kCleanKind)) continue;
    settings.degradations.push_back(eval::parse_degradation(row.kind));
  }
  eval::Runner runner(settings);
  const std::vector<eval::StereoPair> pairs = real_pairs(GetParam());
  for (const eval::StereoPair& pair : pairs) {
    for (const eval::PairReport& report : runner.run_kinds(pair)) {
      EXPECT_TRUE(report.failures.empty()) << report.failures.front();
      collectors.at(report.kind).add(pair.name, report.sweeps);
    }
  }
  for (const EqualErrorFigures& row : rows) {
    const eval::CurveMeans means = collectors.at(row.kind).means();
    ASSERT_EQ(means.pairs, pairs.size()) << row.kind;
    const double density = eval::density_at(means.methods.at(0).sweep, 1, eval::kDAllMeasure);
    std::printf("    {%s, \"%s\", %.1f},\n", code_of(row.pairs), row.kind, density);
    EXPECT_GE(density, row.density - kRealMargins.density) << row.kind;
  }
}

INSTANTIATE_TEST_SUITE_P(RealPairs, EqualError, testing::Values(Pairs::kTen, Pairs::kFurther),
                         [](const testing::TestParamInfo<Pairs>& info) {
                           return info.param == Pairs::kTen ? "Ten" : "Further";
                         });

INSTANTIATE_TEST_SUITE_P(Images, Degraded, testing::ValuesIn(kDegradedFigures), name_of);

}  // namespace
}  // namespace mtstereo::tests::degraded_test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  gst_init(&argc, &argv);
  return RUN_ALL_TESTS();
}
