// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/view_names.hpp"

#include <gtest/gtest.h>

#include <map>

namespace mtstereo::run::view_names_test {
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
      {"imgL.png", {"imgR.png", "img.png"}},
      {"imageL10.png", {"imageR10.png", "image10.png"}},
      {"10L.png", {"10R.png", "10.png"}},
      {"L0001.png", {"R0001.png", "0001.png"}},
      {"a_l1.png", {"a_r1.png", "a_1.png"}},
      {"cam0", {"cam1", ""}},
      {"image_02", {"image_03", ""}},
      {"infra1", {"infra2", ""}},
      {"Infrared_1", {"Infrared_2", ""}},
      {"Infrared 1", {"Infrared 2", ""}},
      {"camera_a", {"camera_b", ""}},
      {"drive_camA.mp4", {"drive_camB.mp4", "drive.mp4"}},
      {"master", {"slave", ""}},
      {"links_0001.png", {"rechts_0001.png", "0001.png"}},
      {"vue_gauche", {"vue_droite", "vue"}},
      {"izquierda_1.png", {"derecha_1.png", "1.png"}},
      {"sinistra_1.png", {"destra_1.png", "1.png"}},
      {"esquerda_1.png", {"direita_1.png", "1.png"}},
      {"левый_1.png", {"правый_1.png", "1.png"}},
      {"камера левая", {"камера правая", "камера"}},
      {"左カメラ", {"右カメラ", "カメラ"}},
      {"OAK_CAM_B.mp4", {"OAK_CAM_C.mp4", "OAK.mp4"}},
      {"Camera_0", {"Camera_1", ""}},
      {"camera_00", {"camera_02", ""}},
      {"image_lcam_front", {"image_rcam_front", "image_front"}},
      {"cam1", {"cam2", ""}},
      {"a_Camera1_3.png", {"a_Camera2_3.png", "a_3.png"}},
      {"colored_0", {"colored_1", ""}},
      {"Image0", {"Image1", ""}},
      {"000001l.png", {"000001r.png", "000001.png"}},
      {"LFT_3008.tif", {"RGT_3008.tif", "3008.tif"}},
      {"ir1", {"ir2", ""}},
      {"fisheye1", {"fisheye2", ""}},
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

// As in TartanAir V2: left and right may be directions of both cameras.
TEST(ViewNames, PreferTheWordsOfCameras) {
  std::vector<fs::path> paths{"lcam_left", "lcam_right", "rcam_left", "rcam_right"};
  const std::vector<PathPair> pairs = take_pairs(paths);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].left, "lcam_left");
  EXPECT_EQ(pairs[0].right, "rcam_left");
  EXPECT_EQ(pairs[0].common, "left");
  EXPECT_EQ(pairs[1].right, "rcam_right");
  EXPECT_EQ(name_without_view("000001_rcam_left", true), "000001_left");
}

TEST(ViewNames, LeavesMoreThanTwoCamerasCountedFromOne) {
  std::vector<fs::path> three{"cam1", "cam2", "cam3"}, from_zero{"cam0", "cam1", "cam2"};
  EXPECT_TRUE(take_pairs(three).empty());
  EXPECT_EQ(take_pairs(from_zero).front().right, "cam1");
  EXPECT_EQ(from_zero, std::vector<fs::path>{"cam2"});
  EXPECT_FALSE(is_view_name("cam2"));
}

TEST(ViewNames, LeavesOtherNames) {
  for (const auto& [a, b] :
       {std::pair("small.mp4", "smarr.mp4"), std::pair("cam01", "cam11"),
        std::pair("left1.mp4", "right2.mp4"), std::pair("cam2", "cam3"),
        std::pair("1la.png", "1ra.png"), std::pair("ir3", "ir4"), std::pair("XL1.png", "XR1.png"),
        std::pair("Lx1.png", "Rx1.png"), std::pair("2l1.png", "2r1.png"),
        std::pair("L1.png", "R2.png"), std::pair("xLa.png", "xRa.png")}) {
    std::vector<fs::path> paths{a, b};
    EXPECT_TRUE(take_pairs(paths).empty()) << a;
    EXPECT_EQ(paths.size(), 2U);
  }
}

std::string text_of(std::vector<fs::path> paths) {
  std::string text;
  for (const ViewImages& views : take_views(paths)) {
    text += views.common + ":";
    for (const fs::path& left : views.left) text += " " + left.string();
    text += " |";
    for (const fs::path& right : views.right) text += " " + right.string();
    text += "; ";
  }
  text += "rest:";
  for (const fs::path& path : paths) text += " " + path.string();
  return text;
}

TEST(ViewNames, SeparatesWhatDiffersInMoreThanNumbers) {
  EXPECT_EQ(text_of({"disp_left.png", "disp_right.png", "left.png", "right.png", "readme.png"}),
            ".png: left.png | right.png; disp.png: disp_left.png | disp_right.png; "
            "rest: readme.png");
  EXPECT_EQ(text_of({"left_2.png", "left_3.png", "left_10.png", "right_2.png", "right_10.png"}),
            ".png: left_2.png left_10.png | right_2.png right_10.png; rest: left_3.png");
}

TEST(ViewNames, FindsViewsWithoutPartners) {
  EXPECT_EQ(text_of({"left.png", "right.jpg", "x.png"}), ": left.png | right.jpg; rest: x.png");
  EXPECT_EQ(text_of({"left_1.25.png", "left_1.50.png", "right_1.26.png"}),
            ".: left_1.25.png left_1.50.png | right_1.26.png; rest:");
  EXPECT_EQ(text_of({"left_1.png", "right_mask_1.png", "left_2.png"}),
            "rest: left_1.png right_mask_1.png left_2.png");
  EXPECT_EQ(text_of({"left_1.png", "left_2.png"}), "rest: left_1.png left_2.png");
}

TEST(ViewNames, RecognizesNamesOfOneView) {
  for (const char* name : {"left.mp4", "x_right.mp4", "a_l.mkv", "cam1", "image_03"}) {
    EXPECT_TRUE(is_view_name(name)) << name;
  }
  for (const char* name :
       {"bright.mp4", "leftover.mp4", "left_right.mp4", "all.mkv", "cam10", "左右.mp4"}) {
    EXPECT_FALSE(is_view_name(name)) << name;
  }
}

}  // namespace
}  // namespace mtstereo::run::view_names_test
