// SPDX-License-Identifier: LGPL-2.1-or-later
// When maps count as nearly black, and what is said about them.
#include "matcher/engine/black_maps.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mtstereo::plugin::black_maps_test {
namespace {

TEST(BlackMaps, HaveAMeanDensityOfManyPairs) {
  BlackMaps maps;
  for (int round = 0; round < 2; ++round) {
    for (int i = 1; i < BlackMaps::kPairs; ++i) EXPECT_FALSE(maps.mean(0.02, false)) << i;
    const auto mean = maps.mean(0.02 + 0.6, false);
    ASSERT_TRUE(mean);
    EXPECT_NEAR(*mean, 0.03, 1e-9);
  }
}

TEST(BlackMaps, AreCountedFromTheLastExplanationOn) {
  BlackMaps maps;
  for (int i = 0; i < 200; ++i) EXPECT_FALSE(maps.mean(0, true));
  for (int i = 1; i < BlackMaps::kPairs; ++i) EXPECT_FALSE(maps.mean(0, false));
  EXPECT_FALSE(maps.mean(0, true));
  EXPECT_FALSE(maps.mean(0, false));
}

TEST(BlackMaps, AreNotCountedAfterTheReport) {
  BlackMaps maps;
  maps.report();
  for (int i = 0; i < 200; ++i) EXPECT_FALSE(maps.mean(0, false)) << i;
}

/// Views with this largest gray value, and 0.
std::string text_of(double density, bool sparse, std::uint8_t most) {
  std::vector<std::uint8_t> pixels(64 * 48, 0);
  pixels.back() = most;
  const GrayView view{pixels.data(), 64, 48, 64};
  return black_maps_text(density, sparse, view, view);
}

TEST(BlackMaps, AreWarnedOfByTheDensityOfTheirMode) {
  const std::string text = text_of(0.012, false, 200);
  EXPECT_NE(text.find("in 1.2 % of the pixels"), std::string::npos) << text;
  EXPECT_NE(text.find("--check"), std::string::npos) << text;
  EXPECT_EQ(text_of(0.05, false, 200), "");
  EXPECT_EQ(text_of(0.01, true, 200), "");
  EXPECT_NE(text_of(0.009, true, 200), "");
}

TEST(BlackMaps, OfViewsWithFewGrayValuesGetAnotherRemedy) {
  const std::string text = text_of(0.5, false, 15);
  EXPECT_NE(text.find("no more than 16 gray values"), std::string::npos) << text;
  EXPECT_NE(text.find("of 16 bits"), std::string::npos) << text;
  EXPECT_EQ(text_of(0.5, false, 16), "");
  EXPECT_EQ(text_of(0.51, false, 15), "");
}

}  // namespace
}  // namespace mtstereo::plugin::black_maps_test
