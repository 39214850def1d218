// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/resolution_choice.hpp"

#include <gtest/gtest.h>

namespace mtstereo::resolution_choice_test {
namespace {

constexpr double kSoftShare = ResolutionChoice::kSoft;
constexpr double kSharpShare = ResolutionChoice::kSharp;
constexpr double kBetween = (kSoftShare + kSharpShare) / 2;
constexpr int kFrames = ResolutionChoice::kFrames;

void take(ResolutionChoice& choice, int frames, std::optional<double> share) {
  for (int i = 0; i < frames; ++i) choice.take(share);
}

bool is_half(const ResolutionChoice& choice) {
  return choice.resolution() == Resolution::kHalfRefined;
}

ResolutionChoice at_half() {
  ResolutionChoice choice;
  take(choice, kFrames, kSoftShare);
  EXPECT_TRUE(is_half(choice));
  return choice;
}

TEST(ResolutionChoice, BeginsAtFullResolution) {
  EXPECT_EQ(Resolution::kFull, ResolutionChoice().resolution());
}

TEST(ResolutionChoice, ChangesAfterSeveralFramesInSuccession) {
  ResolutionChoice choice;
  take(choice, kFrames - 1, kSoftShare);
  EXPECT_FALSE(is_half(choice));
  choice.take(0.0);
  EXPECT_TRUE(is_half(choice));
  take(choice, kFrames - 1, kSharpShare);
  EXPECT_TRUE(is_half(choice));
  choice.take(3.0);
  EXPECT_FALSE(is_half(choice));
}

TEST(ResolutionChoice, StaysWhileTheSharesAreInBetween) {
  ResolutionChoice full, half = at_half();
  take(full, 100, kBetween);
  take(half, 100, kBetween);
  EXPECT_FALSE(is_half(full));
  EXPECT_TRUE(is_half(half));
}

TEST(ResolutionChoice, StaysWhileTheSharesAlternate) {
  for (const double other : {kSharpShare, kBetween}) {
    ResolutionChoice choice;
    for (int i = 0; i < 50; ++i) {
      take(choice, kFrames - 1, kSoftShare);
      choice.take(other);
    }
    EXPECT_FALSE(is_half(choice)) << other;
  }
  for (const double other : {kSoftShare, kBetween}) {
    ResolutionChoice choice = at_half();
    for (int i = 0; i < 50; ++i) {
      take(choice, kFrames - 1, kSharpShare);
      choice.take(other);
    }
    EXPECT_TRUE(is_half(choice)) << other;
  }
}

TEST(ResolutionChoice, DoesNotCountFramesWithoutAShare) {
  ResolutionChoice choice;
  take(choice, 100, std::nullopt);
  EXPECT_FALSE(is_half(choice));
  take(choice, kFrames - 1, kSoftShare);
  take(choice, 100, std::nullopt);
  EXPECT_FALSE(is_half(choice));
  choice.take(kSoftShare);
  EXPECT_TRUE(is_half(choice));
  take(choice, 100, std::nullopt);
  EXPECT_TRUE(is_half(choice));
}

TEST(ResolutionChoice, BeginsAnew) {
  ResolutionChoice choice = at_half();
  choice.restart();
  EXPECT_FALSE(is_half(choice));
  take(choice, kFrames - 1, kSoftShare);
  choice.restart();
  choice.take(kSoftShare);
  EXPECT_FALSE(is_half(choice)) << "the frames before count";
}

}  // namespace
}  // namespace mtstereo::resolution_choice_test
