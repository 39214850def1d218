// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "expect_error.hpp"
#include "support.hpp"
#include "tools/eval/datasets.hpp"

namespace mtstereo::eval::trimbot_test {
namespace {

using testing::float_bytes;
using testing::TemporaryFolder;
using testing::write_file;
using testing::write_image;

const cv::Size kSize(6, 4);

class TrimBot : public ::testing::Test {
 protected:
  void image(const std::string& name) {
    write_image(folder_ / name, cv::Mat(kSize, CV_8UC3, cv::Scalar(1, 2, 3)));
  }
  // Column by column: the value at (x, y) is 1 + 4 x + y.
  void dmap(const std::string& name) {
    std::vector<float> values;
    for (int i = 0; i < kSize.area(); ++i) values.push_back(static_cast<float>(1 + i));
    write_file(folder_ / name, float_bytes(values, true));
  }
  void rendered_frame(const std::string& sequence, const std::string& frame) {
    image(sequence + "/vcam_0/vcam_0_f" + frame + "_undist.png");
    image(sequence + "/vcam_1/vcam_1_f" + frame + "_undist.png");
    dmap(sequence + "/vcam_0/vcam_0_f" + frame + "_dmap.bin");
  }
  void cameras(const std::string& sequence, const std::string& frame) {
    write_file(folder_ / (sequence + "/vcam_0/vcam_0_f" + frame + "_cam.txt"),
               "100 100 3 2 1 0 0 0 0 0 0\n");
    write_file(folder_ / (sequence + "/vcam_1/vcam_1_f" + frame + "_cam.txt"),
               "100 100 3 2 1 0 0 0 -0.5 0 0\n");
  }
  DataSet detect(Layout layout) {
    EXPECT_EQ(layout_name(detect_layout(folder_.path())), layout_name(layout));
    return find_pairs(folder_.path(), layout);
  }
  TemporaryFolder folder_;
};

TEST_F(TrimBot, FramesWithTheSameLastNumberArePairedByTheirNames) {
  for (const char* frame : {"000000_10", "000001_10"}) {
    for (const char* place : {"left/", "right/", "disparity/"}) {
      image(std::string(place) + frame + ".png");
    }
  }
  const DataSet set = detect(Layout::kTrimbotReal);
  EXPECT_TRUE(set.problems.empty());
  ASSERT_EQ(set.pairs.size(), 2U);
  EXPECT_EQ(set.pairs[1].right, folder_ / "right/000001_10.png");
  EXPECT_EQ(set.pairs[1].truth, folder_ / "disparity/000001_10.png");
}

TEST_F(TrimBot, DrivingStereoHasFoldersOfScenesPerSide) {
  for (const char* frame : {"2018-10-11-702", "2018-10-12-702"}) {
    image(std::string("train-left-image/scene/") + frame + ".jpg");
    image(std::string("train-right-image/scene/") + frame + ".jpg");
    image(std::string("train-disparity-map/scene/") + frame + ".png");
  }
  image("left-image-half-size/7.jpg");
  image("right-image-half-size/7.jpg");
  image("disparity-map-half-size/7.png");
  const DataSet set = detect(Layout::kTrimbotReal);
  EXPECT_TRUE(set.problems.empty());
  ASSERT_EQ(set.pairs.size(), 3U);
  EXPECT_EQ(set.pairs[0].truth, folder_ / "disparity-map-half-size/7.png");
  EXPECT_EQ(set.pairs[2].right, folder_ / "train-right-image/scene/2018-10-12-702.jpg");
  EXPECT_EQ(set.pairs[2].truth, folder_ / "train-disparity-map/scene/2018-10-12-702.png");
  EXPECT_EQ(set.pairs[2].max_disparity, 128);
}

TEST_F(TrimBot, SintelHasFoldersOfScenesPerSide) {
  for (const char* side :
       {"clean_left", "clean_right", "final_left", "final_right", "disparities"}) {
    image(std::string("training/") + side + "/alley_1/frame_0001.png");
  }
  image("other/final_left/cave_2/frame_0001.png");
  image("other/final_right/cave_2/frame_0001.png");
  // Blue, green, red: 4 * 3 + 2 / 64 + 1 / 16384 px.
  image("other/disparities/cave_2/frame_0001.png");
  const DataSet set = detect(Layout::kTrimbotReal);
  EXPECT_TRUE(set.problems.empty());
  ASSERT_EQ(set.pairs.size(), 2U);
  EXPECT_EQ(set.pairs[0].name, "other/final_left/cave_2/frame_0001");
  EXPECT_EQ(set.pairs[1].right, folder_ / "training/clean_right/alley_1/frame_0001.png");
  const LoadedPair loaded = load_pair(set.pairs[0], DmapMeaning::kAuto);
  EXPECT_FLOAT_EQ(loaded.truth.disparity.at<float>(0, 0), 12.03131103515625F);
}

TEST_F(TrimBot, VirtualKittiHasDepthsInCentimeters) {
  const std::string frames = "Scene01/clone/frames/";
  image(frames + "rgb/Camera_0/rgb_00000.jpg");
  image(frames + "rgb/Camera_1/rgb_00000.jpg");
  cv::Mat depth(kSize, CV_16UC1, cv::Scalar(1000));
  depth.at<std::uint16_t>(0, 0) = 65535;
  write_image(folder_ / (frames + "depth/Camera_0/depth_00000.png"), depth);
  const DataSet set = detect(Layout::kTrimbotReal);
  EXPECT_TRUE(set.problems.empty());
  ASSERT_EQ(set.pairs.size(), 1U);
  const cv::Mat map = load_pair(set.pairs[0], DmapMeaning::kAuto).truth.disparity;
  EXPECT_TRUE(std::isnan(map.at<float>(0, 0)));
  EXPECT_NEAR(map.at<float>(1, 1), 38.62, 0.01);  // px: 725 px * 0.5327 m / 10 m
}

TEST_F(TrimBot, SyntheticGardenPairsTheFramesOfTheTwoCameras) {
  rendered_frame("clear_0288", "00001");
  rendered_frame("clear_0288", "00012");
  rendered_frame("sunset_0288", "00001");
  // Other files beside the images in the data set do not belong to the pair.
  image("clear_0288/vcam_0/vcam_0_f00001_over.png");
  image("clear_0288/vcam_0/vcam_0_f00001_dmap.png");
  image("clear_0288/vcam_0/vcam_0_f00001_gtr.png");
  const DataSet set = detect(Layout::kTrimbotSynthetic);
  EXPECT_TRUE(set.problems.empty());
  ASSERT_EQ(set.pairs.size(), 3U);
  EXPECT_EQ(set.pairs[1].name, "clear_0288/vcam_0/vcam_0_f00012_undist");
  EXPECT_EQ(set.pairs[1].right, folder_ / "clear_0288/vcam_1/vcam_1_f00012_undist.png");
  EXPECT_EQ(set.pairs[1].truth, folder_ / "clear_0288/vcam_0/vcam_0_f00012_dmap.bin");
  EXPECT_EQ(set.pairs[1].max_disparity, 100);
}

TEST_F(TrimBot, SyntheticGardenAcceptsOtherNamesWithTheSameFrameNumber) {
  image("vcam_0/vcam_0_f00007_left.png");
  image("vcam_1/7.png");
  dmap("vcam_0/f0007_dmap.bin");
  EXPECT_EQ(detect(Layout::kTrimbotSynthetic).pairs.size(), 1U);
}

TEST_F(TrimBot, DmapWithoutCamerasIsDisparity) {
  rendered_frame("a", "00001");
  const StereoPair pair = detect(Layout::kTrimbotSynthetic).pairs.at(0);
  const cv::Mat truth = load_pair(pair).truth.disparity;
  EXPECT_EQ(truth.at<float>(0, 0), 1);
  EXPECT_EQ(truth.at<float>(3, 0), 4);
  EXPECT_EQ(truth.at<float>(0, 1), 5);
  EXPECT_EQ(truth.at<float>(3, 5), 24);
  EXPECT_INPUT_ERROR(load_pair(pair, DmapMeaning::kDepth), "_cam.txt");
}

TEST_F(TrimBot, DmapWithCamerasIsDepth) {
  rendered_frame("a", "00001");
  cameras("a", "00001");
  const StereoPair pair = detect(Layout::kTrimbotSynthetic).pairs.at(0);
  // 100 px * 0.5 m / depth
  const cv::Mat truth = load_pair(pair).truth.disparity;
  EXPECT_FLOAT_EQ(truth.at<float>(0, 0), 50);
  EXPECT_FLOAT_EQ(truth.at<float>(0, 1), 10);
  EXPECT_EQ(load_pair(pair, DmapMeaning::kDisparity).truth.disparity.at<float>(0, 1), 5);
}

TEST_F(TrimBot, CorruptCameraFileIsNamed) {
  rendered_frame("a", "00001");
  cameras("a", "00001");
  write_file(folder_ / "a/vcam_1/vcam_1_f00001_cam.txt", "100 100");
  const StereoPair pair = detect(Layout::kTrimbotSynthetic).pairs.at(0);
  EXPECT_INPUT_ERROR(load_pair(pair), "vcam_1_f00001_cam.txt");
}

TEST_F(TrimBot, FindsAllCameraPairsOfTheRigAndNoOthers) {
  for (const char* camera : {"0", "1", "2", "3", "8", "9"}) {
    const std::string name = std::string("vcam_") + camera + "/vcam_" + camera + "_f1";
    image(name + "_undist.png");
    dmap(name + "_dmap.bin");
  }
  const DataSet set = detect(Layout::kTrimbotSynthetic);
  EXPECT_TRUE(set.problems.empty());
  ASSERT_EQ(set.pairs.size(), 3U) << "1 and 2 are no pair";
  EXPECT_EQ(set.pairs[1].left, folder_ / "vcam_2/vcam_2_f1_undist.png");
  EXPECT_EQ(set.pairs[1].right, folder_ / "vcam_3/vcam_3_f1_undist.png");
}

TEST_F(TrimBot, RealGardenReadsLeftRightAndATruthFolder) {
  image("TEST/left/9.jpg");
  image("TEST/right/9.jpg");
  write_image(folder_ / "TEST/ground_truth_disparity/9.png",
              cv::Mat(kSize, CV_8UC1, cv::Scalar(12)));
  image("TEST/left/10.jpg");
  image("TEST/right/10.jpg");
  write_image(folder_ / "TEST/ground_truth_disparity/10.png",
              cv::Mat(kSize, CV_16UC1, cv::Scalar(12 * 256 + 128)));
  const DataSet set = detect(Layout::kTrimbotReal);
  ASSERT_EQ(set.pairs.size(), 2U);
  EXPECT_EQ(set.pairs[0].max_disparity, 64);
  EXPECT_EQ(load_pair(set.pairs[0]).truth.disparity.at<float>(0, 0), 12.5F);
  EXPECT_EQ(load_pair(set.pairs[1]).truth.disparity.at<float>(0, 0), 12);
}

TEST_F(TrimBot, RealGardenReadsCameraFoldersWithPfmBesideTheImages) {
  image("uvc_camera_cam_0/uvc_camera_cam_0_f00140_undist.png");
  image("uvc_camera_cam_1/uvc_camera_cam_1_f00140_undist.png");
  write_file(folder_ / "uvc_camera_cam_0/uvc_camera_cam_0_f00140.pfm",
             "Pf\n6 4\n-1\n" + float_bytes(std::vector<float>(24, 3), false));
  const DataSet set = detect(Layout::kTrimbotReal);
  ASSERT_EQ(set.pairs.size(), 1U);
  EXPECT_EQ(load_pair(set.pairs[0]).truth.disparity.at<float>(2, 2), 3);
}

TEST_F(TrimBot, NamesIncompleteFrames) {
  rendered_frame("a", "00001");
  rendered_frame("a", "00002");
  rendered_frame("a", "00003");
  rendered_frame("a", "00004");
  std::filesystem::remove(folder_ / "a/vcam_1/vcam_1_f00001_undist.png");
  std::filesystem::remove(folder_ / "a/vcam_0/vcam_0_f00002_dmap.bin");
  image("a/vcam_1/again_3.png");
  const DataSet set = detect(Layout::kTrimbotSynthetic);
  ASSERT_EQ(set.pairs.size(), 1U);
  EXPECT_EQ(set.pairs[0].name, "a/vcam_0/vcam_0_f00004_undist");
  ASSERT_EQ(set.problems.size(), 3U);
  EXPECT_THAT(set.problems[0].reason, ::testing::HasSubstr("no right image with frame number 1"));
  EXPECT_THAT(set.problems[1].reason, ::testing::HasSubstr("no ground truth with frame number 2"));
  EXPECT_THAT(set.problems[2].reason,
              ::testing::HasSubstr("more than one right image with frame number 3"));
}

TEST_F(TrimBot, DmapOfAnotherSizeIsNamed) {
  rendered_frame("a", "00001");
  write_file(folder_ / "a/vcam_0/vcam_0_f00001_dmap.bin", "abcd");
  EXPECT_INPUT_ERROR(load_pair(detect(Layout::kTrimbotSynthetic).pairs.at(0)),
                     "vcam_0_f00001_dmap.bin: has 4 bytes; an image of 6x4 needs 96");
}

}  // namespace
}  // namespace mtstereo::eval::trimbot_test
