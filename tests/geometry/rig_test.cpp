// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/rig.hpp"

#include <gtest/gtest.h>

namespace mtstereo::test::rig_test {
namespace {

Rectification rectification(double focal_length, double baseline) {
  Rectification result;
  result.width = 640;
  result.height = 480;
  result.focal_length = focal_length;
  result.left_center_x = result.right_center_x = 319.5;
  result.center_y = 239.5;
  result.baseline = baseline;
  return result;
}

TEST(Rig, FiguresOfARangeOfDisparities) {
  const RigFigures figures = rig_figures(rectification(320, 0.1), {0, 64, 1});
  EXPECT_NEAR(figures.horizontal_field, 90, 1e-9);
  EXPECT_NEAR(figures.vertical_field, 73.7398, 1e-4);
  EXPECT_DOUBLE_EQ(figures.nearest, 0.5);
  EXPECT_DOUBLE_EQ(figures.farthest, 32);
  EXPECT_EQ(rig_text(figures),
            "focal length 320.0 px, baseline 0.100 m, field of view 90 x 74 degrees, measures from "
            "0.500 m (64 px) to 32.0 m (1 px)");
}

TEST(Rig, DisparitiesWithAnOffset) {
  Rectification moved = rectification(320, 0.1);
  moved.right_center_x += 16;
  RigFigures figures = rig_figures(moved, {0, 64, 1});
  EXPECT_DOUBLE_EQ(figures.nearest, 32.0 / 80);
  EXPECT_DOUBLE_EQ(figures.farthest, 32.0 / 16);
  moved.right_center_x -= 32;  // infinity has the disparity 16
  figures = rig_figures(moved, {0, 64, 1});
  EXPECT_DOUBLE_EQ(figures.nearest, 32.0 / 48);
  EXPECT_DOUBLE_EQ(figures.farthest, 32);
}

TEST(Rig, WithoutARangeOrASizeNothingIsMadeUp) {
  Rectification unknown = rectification(1000, 0.0421);
  EXPECT_EQ(rig_text(rig_figures(unknown)),
            "focal length 1000.0 px, baseline 0.0421 m, field of view 35 x 27 degrees");
  unknown.width = unknown.height = 0;
  EXPECT_EQ(rig_text(rig_figures(unknown)), "focal length 1000.0 px, baseline 0.0421 m");
  EXPECT_EQ(rig_text(rig_figures({})), "focal length 0.0 px, baseline 0 m");
}

TEST(Rig, ARangeThatEndsBeyondInfinityHasNoNearestDepth) {
  Rectification moved = rectification(320, 0.1);
  moved.right_center_x -= 100;
  EXPECT_EQ(rig_figures(moved, {0, 64, 1}).nearest, 0);
}

}  // namespace
}  // namespace mtstereo::test::rig_test
