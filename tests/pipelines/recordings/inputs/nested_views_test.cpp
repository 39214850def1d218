// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/nested_views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <set>

#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/recognition.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::nested_views_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;
using testing::write_text;

class NestedFolders : public ::testing::Test {
 protected:
  void write_images(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      const fs::path file = folder_ / name;
      ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)))) << file;
    }
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::vector<Recording> find() {
    problems_.clear();
    return find_recordings(folder_.path(), {}, problems_);
  }

  // "NAME: LEFT RIGHT" of each recording, by the first images or the videos.
  std::vector<std::string> found() {
    std::vector<std::string> texts;
    const auto text = [this](const Source& source) {
      const fs::path file = source.video.empty() ? source.images.front() : source.video;
      return " " + file.lexically_relative(folder_.path()).string();
    };
    for (const Recording& recording : find()) {
      texts.push_back(recording.name + ":" + text(recording.left) + text(recording.right));
    }
    return texts;
  }

  TemporaryFolder folder_;
  std::vector<Problem> problems_;
};

TEST_F(NestedFolders, EachSceneIsARecording) {
  write_images({"set/clean_left/alley/1.png", "set/clean_left/alley/2.png",
                "set/clean_right/alley/1.png", "set/clean_right/alley/2.png",
                "set/clean_left/cave/1.png", "set/clean_right/cave/1.png", "set/flow/alley/1.png"});
  EXPECT_THAT(found(),
              ElementsAre("set-alley: set/clean_left/alley/1.png "
                          "set/clean_right/alley/1.png",
                          "set-cave: set/clean_left/cave/1.png set/clean_right/cave/1.png"));
  EXPECT_THAT(problems_, IsEmpty());
  EXPECT_EQ(find().front().left.images.size(), 2U);
}

TEST_F(NestedFolders, MayHaveSeveralLevelsAndOtherNamesOfImages) {
  write_images({"leftImg8bit/train/aachen/a_0_leftImg8bit.png",
                "rightImg8bit/train/aachen/a_0_rightImg8bit.png",
                "leftImg8bit/val/ulm/u_0_leftImg8bit.png",
                "rightImg8bit/val/ulm/u_0_rightImg8bit.png"});
  EXPECT_THAT(found(), ElementsAre("train-aachen: leftImg8bit/train/aachen/a_0_leftImg8bit.png "
                                   "rightImg8bit/train/aachen/a_0_rightImg8bit.png",
                                   "val-ulm: leftImg8bit/val/ulm/u_0_leftImg8bit.png "
                                   "rightImg8bit/val/ulm/u_0_rightImg8bit.png"));
}

TEST_F(NestedFolders, OfSeveralKindsHaveTheirNames) {
  write_images(
      {"clean_left/a/1.png", "clean_right/a/1.png", "final_left/a/1.png", "final_right/a/1.png"});
  EXPECT_THAT(found(), ElementsAre("clean-a: clean_left/a/1.png clean_right/a/1.png",
                                   "final-a: final_left/a/1.png final_right/a/1.png"));
}

// Names are joined by '-': other scenes may get the same one.
TEST_F(NestedFolders, NeverHaveTheSameName) {
  write_images({"left/a-b/c/1.png", "right/a-b/c/1.png", "left/a/b-c/1.png", "right/a/b-c/1.png"});
  std::set<std::string> names;
  for (const Recording& recording : find()) names.insert(recording.name);
  EXPECT_THAT(names, ElementsAre("a-b-c", "a-b-c-2"));
}

TEST_F(NestedFolders, MayHaveVideos) {
  for (const char* name : {"left/day/a.avi", "left/day/b_left.avi", "left/night/x.avi",
                           "right/day/a.avi", "right/day/b_right.avi", "right/night/y.avi"}) {
    testing::write_video(folder_ / name, "jpegenc ! avimux", testing::constant_times(2));
  }
  EXPECT_THAT(found(), ElementsAre("day-a: left/day/a.avi right/day/a.avi",
                                   "day-b: left/day/b_left.avi right/day/b_right.avi",
                                   "night: left/night/x.avi right/night/y.avi"));
}

TEST_F(NestedFolders, WithoutAPartnerAreNamed) {
  write_images({"left/a/1.png", "right/a/1.png", "left/b/1.png", "right/c/d/1.png"});
  EXPECT_THAT(found(), ElementsAre("a: left/a/1.png right/a/1.png"));
  ASSERT_EQ(problems_.size(), 2U);
  EXPECT_EQ(problems_[0].input, path("left/b"));
  EXPECT_EQ(problems_[1].input, path("right/c/d"));
  EXPECT_THAT(problems_[0].reason, HasSubstr("the folder of the other view is missing"));
}

// The arms of a robot, each with two cameras.
TEST_F(NestedFolders, WithBothViewsAreNoViews) {
  write_images({"arm_left/run/left/1.png", "arm_left/run/right/1.png", "arm_right/run/left/1.png",
                "arm_right/run/right/1.png"});
  const std::vector<std::string> folders{
      "arm_left-run: arm_left/run/left/1.png arm_left/run/right/1.png",
      "arm_right-run: arm_right/run/left/1.png arm_right/run/right/1.png"};
  EXPECT_EQ(found(), folders);
  write_images({"hand_left/run/im_left.png", "hand_left/run/im_right.png",
                "hand_right/run/im_left.png", "hand_right/run/im_right.png"});
  EXPECT_EQ(found().size(), 4U);
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(NestedFolders, WithTheDepthsOfViewsAreNoViews) {
  write_images({"image_left/1.png", "image_right/1.png", "depth_left/1.png", "depth_right/1.png",
                "seg_left/1.png"});
  EXPECT_THAT(found(), ElementsAre(HasSubstr(": image_left/1.png image_right/1.png")));
  EXPECT_THAT(problems_, IsEmpty());
  write_images({"all/rgb_left/a/1.png", "all/rgb_right/a/1.png", "all/depth_left/a/1.png",
                "all/depth_right/a/1.png"});
  EXPECT_THAT(found(), ElementsAre(HasSubstr(": all/rgb_left/a/1.png"), HasSubstr(": image_left")));
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(NestedFolders, OfDepthsBesideThoseOfViewsAreNoViews) {
  write_images({"frames/rgb/Camera_0/1.png", "frames/rgb/Camera_1/1.png",
                "frames/depth/Camera_0/1.png", "frames/depth/Camera_1/1.png",
                "frames/forwardFlow/Camera_0/1.png", "frames/forwardFlow/Camera_1/1.png"});
  EXPECT_THAT(found(), ElementsAre(HasSubstr(": frames/rgb/Camera_0/1.png")));
  EXPECT_THAT(problems_, IsEmpty());
  write_images({"depth test/left/1.png", "depth test/right/1.png"});
  EXPECT_THAT(found(), ElementsAre(HasSubstr(": depth test/left/1.png"), HasSubstr("frames/rgb")));
}

// Those of Scene Flow, Spring and SERV-CT.
TEST_F(NestedFolders, OfOtherDataBesideViewsAreNoViews) {
  write_images({"flow/frames/A/left/1.png", "flow/frames/A/right/1.png",
                "flow/motion_boundaries/A/left/1.png", "flow/motion_boundaries/A/right/1.png",
                "spring/frame_left/1.png", "spring/frame_right/1.png",
                "spring/maps/skymap_left/1.png", "spring/maps/skymap_right/1.png",
                "scope/Left_rectified/1.png", "scope/Right_rectified/1.png",
                "scope/Ground_truth_CT/DepthL/1.png", "scope/Ground_truth_CT/DepthR/1.png",
                "tof/Left/1.png", "tof/Right/1.png", "tof/Depth_L/1.png", "tof/Depth_R/1.png",
                "tof/OcclusionL/1.png", "tof/OcclusionR/1.png"});
  EXPECT_THAT(found(),
              ElementsAre(HasSubstr(": flow/frames/A/left/1.png"),
                          HasSubstr(": scope/Left_rectified/1.png"),
                          HasSubstr(": spring/frame_left/1.png"), HasSubstr(": tof/Left/1.png")));
  EXPECT_THAT(problems_, IsEmpty());
}

// As in the data set of FoundationStereo.
TEST_F(NestedFolders, OfOtherDataInEachViewAreNoViews) {
  write_images({"a/left/rgb/1.png", "a/left/disparity/1.png", "a/right/rgb/1.png"});
  EXPECT_THAT(found(), ElementsAre("a-rgb: a/left/rgb/1.png a/right/rgb/1.png"));
  EXPECT_THAT(problems_, IsEmpty());
  write_images({"a/left/depth_map/1.png", "a/right/depth_map/1.png"});
  EXPECT_THAT(found(), ElementsAre("a-rgb: a/left/rgb/1.png a/right/rgb/1.png"));
  EXPECT_THAT(problems_, IsEmpty());
  // Scenes may have such words in their names.
  write_images(
      {"a/left/river_flow/1.png", "a/right/river_flow/1.png", "a/left/depths of sea/1.png"});
  EXPECT_THAT(found(), ElementsAre(HasSubstr("a-rgb: "), HasSubstr("a-river_flow: ")));
  EXPECT_EQ(problems_.size(), 1U);
  write_images({"b/left/depth/1.png", "b/right/depth/1.png"});
  EXPECT_THAT(found(), ElementsAre(HasSubstr("a-rgb: "), HasSubstr("a-river_flow: "),
                                   "b-depth: b/left/depth/1.png b/right/depth/1.png"));
}

// The vignettes of TUM-VI.
TEST_F(NestedFolders, OfOneImageHaveTheViewsInTheFolderImages) {
  write_images({"dso/cam0/vignette.png", "dso/cam0/images/1.png", "dso/cam0/images/2.png",
                "dso/cam1/vignette.png", "dso/cam1/images/1.png", "dso/cam1/images/2.png"});
  EXPECT_THAT(found(), ElementsAre("dso: dso/cam0/images/1.png dso/cam1/images/1.png"));
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(NestedFolders, WithNothingInCommonAreNoViews) {
  write_images({"left/a/1.png", "right/b/1.png"});
  EXPECT_TRUE(nested_views(path("left"), path("right")).pairs.empty());
  EXPECT_THAT(find(), IsEmpty());
}

TEST_F(NestedFolders, EndAtLinksToTheirParents) {
  write_images({"left/a/1.png", "right/a/1.png"});
  fs::create_directory_symlink("..", folder_ / "left/up");
  fs::create_directory_symlink("..", folder_ / "right/up");
  EXPECT_THAT(found(), ElementsAre("a: left/a/1.png right/a/1.png"));
}

TEST_F(NestedFolders, TakeTheCalibrationBesideTheViews) {
  write_images({"left/a/1.png", "right/a/1.png"});
  write_text(folder_ / "calib.txt",
             "P0: 50 0 32 0 0 50 24 0 0 0 1 0\n"
             "P1: 50 0 32 -5 0 50 24 0 0 0 1 0\n");
  EXPECT_EQ(find().front().calibration, path("calib.txt"));
}

TEST_F(NestedFolders, GivenAsTwoInputsAreRefusedWithTheRemedy) {
  write_images({"left/a/1.png", "right/a/1.png"});
  EXPECT_THAT(
      [&] {
        recognize({path("left"), path("right")}, {});
      },
      ::testing::ThrowsMessage<UserError>(HasSubstr("give the folder that has both views, " +
                                                    path("").substr(0, path("").size() - 1))));
}

}  // namespace
}  // namespace mtstereo::run::nested_views_test
