// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/agreement.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/agreement.hpp"
#include "support/compare.hpp"
#include "support/half_maps.hpp"

namespace mtstereo::agreement_test {
namespace {

/// The shares by both maps, counted in bands; odd rows have no result by the costs alone.
GrayPlane shared(const DisparityPlane& by_path, const DisparityPlane& by_cost, int width,
                 int height) {
  WindowVotes votes;
  votes.resize(width, height, 96);
  std::fill_n(votes.compared.data(), votes.compared.size(), std::uint8_t{77});
  std::fill_n(votes.agreeing.data(), votes.agreeing.size(), std::uint8_t{77});
  for (int y0 = 0; y0 < by_path.height; y0 += 64) {
    const int y1 = std::min(y0 + 64, by_path.height);
    clear_votes(y0, y1, votes);
    for (int y = y0; y < y1; ++y) {
      const std::int32_t* costs = y % 2 == 0 ? &by_cost(0, y) : nullptr;
      count_votes(&by_path(0, y), costs, by_path.width, y, votes);
    }
  }
  Image<std::uint8_t> shares;
  shares.resize(votes.columns, votes.rows);
  share_agreement(votes, shares);
  return test::copy_of(shares);
}

TEST(Agreement, EqualsReferenceAtEverySize) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const int width = random.between(1, 200), height = random.between(1, 200);
    const DisparityPlane by_path =
        test::random_half_map(width, height, 90, random.below(101), random);
    DisparityPlane by_cost = by_path;
    for (int& disparity : by_cost.pixels) {
      const int choice = random.below(4);
      if (choice == 0) disparity = 0;
      if (choice == 1) disparity += random.between(0, 600);
    }
    EXPECT_TRUE(same_image(reference::share_agreement(by_path, by_cost, width, height),
                           shared(by_path, by_cost, width, height)))
        << width << "x" << height;
  }
}

TEST(Agreement, IsCompleteWhereTheCostsGiveTheSame) {
  const DisparityPlane same(40, 40, 256 * 5);
  for (const int share : shared(same, same, 80, 80).pixels) EXPECT_EQ(kFullAgreement, share);
}

TEST(Agreement, IsNoneWithoutDisparities) {
  const DisparityPlane none(40, 40), same(40, 40, 256);
  for (const int share : shared(none, none, 80, 80).pixels) EXPECT_EQ(0, share);
  for (const int share : shared(same, none, 80, 80).pixels) EXPECT_EQ(0, share);
  for (const int share : shared(none, same, 80, 80).pixels) EXPECT_EQ(0, share);
}

TEST(Agreement, KnowsTheSideOnWhichTheCostsDiffer) {
  const DisparityPlane by_path(80, 20, 256 * 9);
  DisparityPlane by_cost = by_path;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) by_cost(x, y) = 256 * (1 + (x * 7 + y * 5) % 30);
  }
  const GrayPlane shares = shared(by_path, by_cost, 160, 40);
  EXPECT_LT(shares(0, 0), kFullAgreement / 4);
  EXPECT_EQ(kFullAgreement, shares(9, 0));
}

}  // namespace
}  // namespace mtstereo::agreement_test
