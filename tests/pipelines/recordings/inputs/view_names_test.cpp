// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/view_names.hpp"

#include <gtest/gtest.h>

#include <map>

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

TEST(ViewNames, FindsPairs) {
  std::map<std::string, std::pair<std::string, std::string>> known{
      {"left.mp4", {"right.mp4", ".mp4"}},
      {"drive_left.mp4", {"drive_right.mp4", "drive.mp4"}},
      {"left-drive.mp4", {"right-drive.mp4", "drive.mp4"}},
      {"DriveLeft.avi", {"DriveRight.avi", "Drive.avi"}},
      {"a_l_1.mkv", {"a_r_1.mkv", "a_1.mkv"}},
      {"image_l", {"image_r", "image"}},
      {"cam0", {"cam1", ""}},
      {"image_02", {"image_03", ""}},
  };
  for (const auto& [left, expected] : known) {
    std::vector<fs::path> paths{fs::path("x") / expected.first, fs::path("x") / left,
                                "x/other.mp4"};
    const std::vector<PathPair> pairs = take_pairs(paths);
    ASSERT_EQ(pairs.size(), 1U) << left;
    EXPECT_EQ(pairs.front().left, fs::path("x") / left);
    EXPECT_EQ(pairs.front().right, fs::path("x") / expected.first);
    EXPECT_EQ(pairs.front().common, expected.second);
    EXPECT_EQ(paths, std::vector<fs::path>{"x/other.mp4"});
  }
}

TEST(ViewNames, LeavesOtherNames) {
  for (const auto& [a, b] : {std::pair("small.mp4", "smarr.mp4"), std::pair("cam01", "cam11"),
                             std::pair("left1.mp4", "right2.mp4"), std::pair("cam2", "cam3")}) {
    std::vector<fs::path> paths{a, b};
    EXPECT_TRUE(take_pairs(paths).empty()) << a;
    EXPECT_EQ(paths.size(), 2U);
  }
}

TEST(ViewNames, RecognizesNamesOfOneView) {
  for (const char* name : {"left.mp4", "x_right.mp4", "a_l.mkv", "cam1", "image_03"}) {
    EXPECT_TRUE(is_view_name(name)) << name;
  }
  for (const char* name : {"bright.mp4", "leftover.mp4", "left_right.mp4", "all.mkv", "cam10"}) {
    EXPECT_FALSE(is_view_name(name)) << name;
  }
}

}  // namespace
}  // namespace mtstereo::run
