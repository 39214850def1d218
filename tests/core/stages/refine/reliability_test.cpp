// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/reliability.hpp"

#include <gtest/gtest.h>

#include "reference/refine/reliability.hpp"
#include "support/random_ratings.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::reliability_test {
namespace {

using Rated = test::RandomRating;

GrayPlane rate(const Rated& rated, float noise, Inferred inferred, int band,
               const ReliabilityTable& table = kReliabilityTables[0][kAnyPart]) {
  const Image<std::int32_t> map = image_of(rated.in.map);
  Image<std::uint8_t> confidence = image_of(rated.in.confidence);
  const RatedViews views = rated.views(noise);
  ClueMaps clues;
  clues.resize(map.width(), map.height());
  ReliabilityScratch scratch;
  scratch.resize(map.width());
  ClueScratch gathering;
  gathering.resize(map.width());
  for (int y = 0; y < map.height(); y += band) {
    gather_clues(views, map, confidence, y, std::min(y + band, map.height()), gathering, clues);
  }
  for (int y = 0; y < map.height(); y += band) {
    rate_reliability(views, map, clues, table, inferred, y, std::min(y + band, map.height()),
                     scratch, confidence);
  }
  return copy_of(confidence);
}

void expect_reference(const Rated& rated, float noise) {
  for (const Inferred inferred : {Inferred::kApart, Inferred::kLikeMatched}) {
    const bool apart = inferred == Inferred::kApart;
    const ReliabilityTable& table = kReliabilityTables[apart ? 2 : 0][kAnyPart];
    const GrayPlane expected =
        reference::rate_reliability(rated.pair(noise), rated.in, table, apart);
    for (const int band : {3, 1 << 20}) {
      EXPECT_TRUE(same_image(expected, rate(rated, noise, inferred, band, table)))
          << rated.left.width << " columns, bands of " << band << " rows";
    }
  }
}

TEST(Reliability, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 90; ++width) {
      Rated rated(width, 1 + width % 41, width);
      rated.fine_detail = 0.003F * static_cast<float>(width);
      rated.grid_level = width % 5;
      rated.block_side = width % 2 == 0 ? 4 : 8;
      rated.clipped_from = width % 3 == 0 ? 40 : kNothingClipped;
      expect_reference(rated, 0.13F * static_cast<float>(width));
    }
  });
}

TEST(Reliability, EqualsReferenceWithPartnersOutsideOfTheRightView) {
  test::for_each_simd_target([] {
    Rated rated(61, 9, 3);
    for (int& disparity : rated.in.map.pixels) disparity = 3 * disparity + 40 * kDisparityOne;
    expect_reference(rated, 1);
  });
}

/// So the sums of entries fit into 16 bits.
TEST(Reliability, HasSmallEntries) {
  for (const TableParts& parts : kReliabilityTables) {
    for (const PartShares& shares :
         {PartShares{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 1, 0}, {1, 0, 0, 1}, {1, 1, 1, 1}}) {
      int largest = 0;
      for (const auto& column : table_for(parts, shares)) {
        int entry = 0;
        for (const int value : column) entry = std::max(entry, std::abs(value));
        largest += entry;
      }
      EXPECT_LT(largest, 1 << 15);
    }
  }
}

TEST(Reliability, AddsTheSharesOfTheParts) {
  TableParts parts{};
  parts[kAnyPart][kShareClue][3] = 100;
  parts[kSoftPart][kShareClue][3] = -40;
  parts[kNoisyPart][kShareClue][3] = 11;
  parts[kBlockyPart][kShareClue][3] = 10;
  bool halved = false;
  const auto entry = [&](float noise, float detail, int grid_level = 0) {
    RatedViews views = {{}, {}, noise, nullptr, 0, nullptr};
    views.fine_detail = detail;
    views.grid_level = grid_level;
    views.halved = halved;
    return table_for(parts, part_shares(views))[kShareClue][3];
  };
  EXPECT_EQ(entry(0, kUnknownDetail), 100);
  EXPECT_EQ(entry(3, 0.2F), 100);
  EXPECT_EQ(entry(0, 0.06F), 60);
  EXPECT_EQ(entry(0, 0), 60);
  EXPECT_EQ(entry(0, 0.13F), 80);
  EXPECT_EQ(entry(4, 0.2F), 106);
  EXPECT_EQ(entry(20, 0.2F), 111);
  EXPECT_EQ(entry(5, 0.03F), 71);
  EXPECT_EQ(entry(0, 0.2F, 1), 105);
  EXPECT_EQ(entry(0, 0.2F, 4), 110);
  halved = true;
  EXPECT_EQ(entry(3, 0.12F), 100);
  EXPECT_EQ(entry(0, 0.03F), 60);
  EXPECT_EQ(entry(0, 0.075F), 80);
}

TEST(Reliability, KeepsInferredDisparitiesApart) {
  const Rated rated(60, 40, 7);
  const GrayPlane out = rate(rated, 1, Inferred::kApart, 1 << 20);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    EXPECT_EQ(out.pixels[i] <= kMostInferred, rated.in.confidence.pixels[i] <= kMostInferred);
    EXPECT_GT(out.pixels[i], 0);
  }
}

/// A surface with a nearer one on its left, in views that show it without any difference.
Rated step_scene() {
  Rated rated(80, 30, 1);
  rated.unbalance();
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 80; ++x) {
      rated.in.map(x, y) = x < 40 ? 20 * 256 : 256;
      rated.in.confidence(x, y) = 200;
      rated.left(x, y) = static_cast<std::uint8_t>((x * 37 + y * 101) % 60);
    }
  }
  for (int y = 0; y < 30; ++y) {
    // With a little noise, as in real views.
    for (int x = 0; x < 79; ++x) rated.right(x, y) = rated.left(x + 1, y) + x % 3;
  }
  for (int y = 0; y < rated.tiles.height(); ++y) {
    for (int x = 0; x < rated.tiles.width(); ++x) rated.tiles.row(y)[x] = 16;
  }
  for (int y = 0; y < 15; ++y) {
    for (int x = 0; x < 40; ++x) {
      rated.guide_map.row(y)[x] = rated.in.map(2 * x, 2 * y) / 2;
      rated.guide_confidence.row(y)[x] = 200;
    }
  }
  return rated;
}

TEST(Reliability, DoubtsThePixelsBesideANearerSurface) {
  const GrayPlane out = rate(step_scene(), 1, Inferred::kLikeMatched, 1 << 20);
  EXPECT_LT(out(42, 15), out(70, 15));
}

TEST(Reliability, DoubtsWhatTheViewsContradict) {
  Rated rated = step_scene();
  const int before = rate(rated, 1, Inferred::kLikeMatched, 1 << 20)(65, 15);
  for (int y = 13; y <= 17; ++y) {
    for (int x = 60; x <= 70; ++x) rated.right(x, y) = 250;
  }
  EXPECT_LT(rate(rated, 1, Inferred::kLikeMatched, 1 << 20)(65, 15), before);
}

TEST(Reliability, GrowsWithTheSupport) {
  Rated rated = step_scene();
  int last = 0;
  for (const int support : {20, 90, 150, 220}) {
    for (std::uint8_t& value : rated.in.confidence.pixels) {
      value = static_cast<std::uint8_t>(support);
    }
    const int rating = rate(rated, 1, Inferred::kLikeMatched, 1 << 20)(70, 15);
    EXPECT_GE(rating, last) << support;
    last = rating;
  }
}

}  // namespace
}  // namespace mtstereo::reliability_test
