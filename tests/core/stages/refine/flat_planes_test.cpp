// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/flat_planes.hpp"

#include <gtest/gtest.h>

#include "reference/refine/flat_planes.hpp"
#include "support/compare.hpp"
#include "support/flat_views.hpp"

namespace mtstereo::flat_planes_test {
namespace {

using reference::ConfidentMap;

constexpr int kWhole = 1 << 20;

/// How a map is changed, and how it is computed.
struct Run {
  bool completes = false;
  int scale = 2;
  int least = 1;
  int at_once = kWhole;  ///< areas
  int band = kWhole;     ///< rows
};

/// The map and its confidence, completed or checked; `marks` becomes what completion replaced.
ConfidentMap result_of(const GrayPlane& view, const ConfidentMap& in, const Run& run,
                       GrayPlane* marks = nullptr) {
  FlatAreas areas;
  areas.scale = run.scale;
  areas.resize(view.width / run.scale, view.height / run.scale);
  const GrayPlane reduced = run.scale == 2 ? view : reference::halve(view);
  const int height = areas.gray.height();
  const int step = flat_step(sum_grays(reduced.view(), 0, height, areas), run.scale, 0);
  find_runs(areas.gray, step, 0, height, areas.runs);
  number_areas(areas);
  Image<std::int32_t> map = image_of(in.map);
  Image<std::uint8_t> confidence = image_of(in.confidence), replaced = image_of(in.confidence);
  PlaneVotes votes;
  votes.resize();
  Buffer<FlatPlane> planes;
  planes.resize(areas.count);
  for (int first = 0; first < areas.count; first += std::min(run.at_once, areas.count)) {
    const int last = run.at_once < areas.count - first ? first + run.at_once : areas.count;
    fit_planes(areas, first, last, map, confidence, votes, planes);
  }
  for (int y = 0; y < view.height; y += std::min(run.band, view.height)) {
    const int end = run.band < view.height - y ? y + run.band : view.height;
    if (run.completes) {
      complete_planes(areas, planes, y, end, confidence, map, replaced);
    } else {
      check_planes(areas, planes, {plane_bonus(0, 0), run.least}, y, end, map, confidence);
    }
  }
  if (marks != nullptr) *marks = copy_of(replaced);
  return {copy_of(map), copy_of(confidence)};
}

DisparityPlane completed(const GrayPlane& view, const ConfidentMap& in) {
  return result_of(view, in, {true}).map;
}

/// The disparity of a slanted plane [1/256 px].
int slanted(int x, int y) { return 256 * 20 + 12 * x - 30 * y; }

/// A flat view, and a map with the plane where a pixel is believed and 5 px where it is doubted.
template <typename Doubted>
ConfidentMap plane_map(int width, int height, Doubted&& doubted) {
  ConfidentMap made{DisparityPlane(width, height), GrayPlane(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      made.map(x, y) = doubted(x, y) ? 5 * 256 : slanted(x, y);
      made.confidence(x, y) = doubted(x, y) ? 30 : 200;
    }
  }
  return made;
}

TEST(FlatPlanes, EqualReferenceAtEveryWidth) {
  test::Random random(1);
  for (int width = 2; width <= 100; ++width) {
    const GrayPlane view = test::flat_view(width, 2 + width * 7 % 83, width);
    ConfidentMap in{DisparityPlane(width, view.height), GrayPlane(width, view.height)};
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool other = random.below(4) == 0;
        in.map(x, y) =
            std::max(1, other ? random.between(1, 60 * 256) : slanted(x, y) + random.below(200));
        in.confidence(x, y) = static_cast<std::uint8_t>(random.between(1, 255));
      }
    }
    GrayPlane expected_marks, marks;
    const ConfidentMap complete = reference::complete_flat_areas(view, 0, in, expected_marks);
    const ConfidentMap expected = reference::check_flat_areas(view, 2, 1, 0, 0, in);
    const ConfidentMap coarse = reference::check_flat_areas(view, 4, 16, 0, 0, in);
    for (const int at_once : {1, 3, kWhole}) {
      const auto made = [&](bool completes, int scale, int least) {
        return result_of(view, in, {completes, scale, least, at_once, 3 * at_once}, &marks);
      };
      EXPECT_TRUE(same_image(complete.map, made(true, 2, 1).map)) << width;
      EXPECT_TRUE(same_image(expected_marks, marks)) << width;
      EXPECT_TRUE(same_image(expected.confidence, made(false, 2, 1).confidence)) << width;
      EXPECT_TRUE(same_image(coarse.confidence, made(false, 4, 16).confidence)) << width;
    }
  }
}

TEST(FlatPlanes, ContinueWhatIsBelieved) {
  for (const auto& [width, height] : {std::pair{80, 60}, {81, 60}, {80, 61}, {83, 57}}) {
    const auto doubted = [](int x, int y) { return x < 30 || y > 50; };
    const ConfidentMap in = plane_map(width, height, doubted);
    const DisparityPlane out = completed(GrayPlane(width, height, 100), in);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) EXPECT_NEAR(slanted(x, y), out(x, y), 256) << x << ' ' << y;
    }
  }
}

TEST(FlatPlanes, KeepWhatIsBelieved) {
  // A quarter of the believed pixels is something else.
  ConfidentMap in = plane_map(80, 60, [](int x, int) { return x < 10; });
  for (int y = 0; y < 60; ++y) {
    for (int x = 60; x < 76; ++x) in.map(x, y) = 256 * 50;
  }
  const DisparityPlane out = completed(GrayPlane(80, 60, 100), in);
  for (int y = 0; y < 60; ++y) {
    for (int x = 10; x < 80; ++x) EXPECT_EQ(in.map(x, y), out(x, y)) << x << ' ' << y;
    for (int x = 0; x < 10; ++x) EXPECT_NEAR(slanted(x, y), out(x, y), 256) << x << ' ' << y;
  }
}

TEST(FlatPlanes, ChangeNothingWithoutAMajority) {
  ConfidentMap in = plane_map(80, 60, [](int x, int) { return x < 10; });
  test::Random random(2);
  for (std::size_t i = 0; i < in.map.pixels.size(); ++i) {
    if (in.confidence.pixels[i] == 200) in.map.pixels[i] = random.between(1, 60 * 256);
  }
  EXPECT_TRUE(same_image(in.map, completed(GrayPlane(80, 60, 100), in)));
}

TEST(FlatPlanes, ChangeNothingByFewVotes) {
  // Each pixel of the halved view that is believed is one vote.
  for (const int votes : {kFewestVotes - 1, kFewestVotes}) {
    const ConfidentMap in =
        plane_map(80, 60, [&](int x, int y) { return y != 20 || x >= 2 * votes; });
    const DisparityPlane out = completed(GrayPlane(80, 60, 100), in);
    EXPECT_EQ(votes < kFewestVotes, same_image(in.map, out)) << votes;
  }
}

TEST(FlatPlanes, RateWhatAgreesWithThemAndWhatContradictsThem) {
  ConfidentMap in = plane_map(80, 60, [](int x, int) { return x < 10; });
  in.map(39, 20) += 256;      // within 1.5 px
  in.map(40, 20) += 256 * 2;  // within 3 px
  in.map(41, 20) += 256 * 4;
  in.confidence(69, 50) = 240;
  const ConfidentMap out = result_of(GrayPlane(80, 60, 100), in, {});
  EXPECT_TRUE(same_image(in.map, out.map));
  EXPECT_EQ(200 + kConfirmed, out.confidence(39, 20));
  EXPECT_EQ(200, out.confidence(40, 20));
  EXPECT_EQ(200 - kContradicted, out.confidence(41, 20));
  EXPECT_EQ(1, out.confidence(5, 20));  // doubted, and at least 1
  EXPECT_EQ(200 + kConfirmed, out.confidence(70, 50));
  EXPECT_EQ(255, out.confidence(69, 50));
}

TEST(FlatPlanes, LeaveWhatIsBelowTheLeastConfidenceAlone) {
  ConfidentMap in = plane_map(80, 60, [](int x, int) { return x < 10; });
  in.map(39, 20) += 256 * 4;
  in.confidence(39, 20) = 50;
  in.confidence(40, 20) = 15;  // agrees
  const ConfidentMap out = result_of(GrayPlane(80, 60, 100), in, {.scale = 4, .least = 16});
  EXPECT_EQ(16, out.confidence(39, 20));
  EXPECT_EQ(15, out.confidence(40, 20));
  EXPECT_EQ(200 + kConfirmed, out.confidence(41, 20));
}

TEST(FlatPlanes, ConfirmLessInNoisyAndNothingInCompressedViews) {
  EXPECT_EQ(kConfirmed, plane_bonus(0, 0));
  EXPECT_EQ(kConfirmed, plane_bonus(kFullPlaneNoise, kMostPlaneGrid));
  EXPECT_EQ(kConfirmed / 2, plane_bonus((kFullPlaneNoise + kNoPlaneNoise) / 2, 0));
  EXPECT_EQ(0, plane_bonus(kNoPlaneNoise, 0));
  EXPECT_EQ(0, plane_bonus(30, 0));
  EXPECT_EQ(0, plane_bonus(0, kMostPlaneGrid + 1));
  for (float noise = 0; noise < 5; noise += 0.125F) {
    EXPECT_EQ(reference::plane_bonus(noise, 0), plane_bonus(noise, 0)) << noise;
  }
}

TEST(FlatPlanes, LeaveTextureAlone) {
  GrayPlane view(80, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) view(x, y) = (x / 2 + y / 2) % 2 == 0 ? 30 : 200;
  }
  const ConfidentMap in = plane_map(80, 60, [](int x, int) { return x < 30; });
  EXPECT_TRUE(same_image(in.map, completed(view, in)));
}

TEST(FlatPlanes, StayNearTheRangeOfTheirVotes) {
  // Believed in the first columns only: the plane would reach 0 at the right.
  ConfidentMap in{DisparityPlane(300, 20, 256), GrayPlane(300, 20, 30)};
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 60; ++x) {
      in.map(x, y) = 256 * 30 - 100 * x;
      in.confidence(x, y) = 200;
    }
  }
  const DisparityPlane out = completed(GrayPlane(300, 20, 100), in);
  const int least = 256 * 30 - 100 * 58 - static_cast<int>(kBeyondVotes * 256);
  for (int y = 0; y < 20; ++y) EXPECT_NEAR(least, out(299, y), 256) << y;
}

}  // namespace
}  // namespace mtstereo::flat_planes_test
