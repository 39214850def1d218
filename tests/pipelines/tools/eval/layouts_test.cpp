// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/layouts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "expect_error.hpp"
#include "support.hpp"
#include "tools/eval/datasets.hpp"

namespace mtstereo::eval::layouts_test {
namespace {

using testing::make_pair;
using testing::TemporaryFolder;
using testing::TestPair;
using testing::write_file;
using testing::write_image;
using testing::write_kitti_truth;
using testing::write_pair_folder;

std::vector<std::string> names_of(const DataSet& set) {
  std::vector<std::string> names;
  for (const StereoPair& pair : set.pairs) names.push_back(pair.name);
  return names;
}

const TestPair& small_pair() {
  static const TestPair pair = make_pair(48, 24, 4);
  return pair;
}

class Layouts : public ::testing::Test {
 protected:
  // Checks that this layout is detected, and lists the pairs.
  DataSet detect(Layout layout) {
    EXPECT_EQ(layout_name(detect_layout(folder_.path())), layout_name(layout));
    return find_pairs(folder_.path(), layout);
  }
  TemporaryFolder folder_;
};

// --- Middlebury and ETH3D

TEST_F(Layouts, MiddleburyReadsRangeWeightAndMask) {
  write_pair_folder(folder_ / "Piano", small_pair(), 30);
  write_pair_folder(folder_ / "Vintage", small_pair(), 40);
  cv::Mat mask(24, 48, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, 10).setTo(128);
  write_image(folder_ / "Vintage/mask0nocc.png", mask);

  const DataSet set = detect(Layout::kMiddlebury);
  ASSERT_EQ(names_of(set), (std::vector<std::string>{"Piano", "Vintage"}));
  EXPECT_TRUE(set.problems.empty());
  EXPECT_EQ(set.pairs[0].max_disparity, 30);
  EXPECT_EQ(set.pairs[0].weight, 1);
  EXPECT_EQ(set.pairs[1].max_disparity, 40);
  EXPECT_EQ(set.pairs[1].weight, 0.5);
  EXPECT_TRUE(set.pairs[0].visible_mask.empty());

  const LoadedPair pair = load_pair(set.pairs[1]);
  EXPECT_EQ(pair.left.size(), cv::Size(48, 24));
  EXPECT_TRUE(std::isnan(pair.truth.disparity.at<float>(0, 0)));
  EXPECT_EQ(pair.truth.disparity.at<float>(23, 47), 4);
  EXPECT_EQ(cv::countNonZero(pair.truth.visible), 38 * 24);
}

TEST_F(Layouts, MiddleburyAcceptsTheFolderOfOnePair) {
  write_pair_folder(folder_ / "Teddy", small_pair(), 30);
  const std::filesystem::path own = folder_ / "Teddy/";
  EXPECT_EQ(detect_layout(own), Layout::kMiddlebury);
  EXPECT_EQ(names_of(find_pairs(own, Layout::kMiddlebury)), std::vector<std::string>{"Teddy"});
}

TEST_F(Layouts, MiddleburyHasNoRangeWithoutCalibration) {
  write_pair_folder(folder_ / "Teddy", small_pair(), 0);
  EXPECT_FALSE(detect(Layout::kMiddlebury).pairs.at(0).max_disparity.has_value());
}

TEST_F(Layouts, MiddleburyNamesMissingFilesAndKeepsOtherPairs) {
  write_pair_folder(folder_ / "A", small_pair(), 30);
  write_pair_folder(folder_ / "B", small_pair(), 30);
  write_pair_folder(folder_ / "C", small_pair(), 30);
  write_pair_folder(folder_ / "D", small_pair(), 30);
  std::filesystem::remove(folder_ / "A/im1.png");
  std::filesystem::remove(folder_ / "B/disp0GT.pfm");
  write_file(folder_ / "C/calib.txt", "ndisp=many\n");
  const DataSet set = detect(Layout::kMiddlebury);
  EXPECT_EQ(names_of(set), std::vector<std::string>{"D"});
  ASSERT_EQ(set.problems.size(), 3U);
  EXPECT_THAT(set.problems[0].reason, ::testing::HasSubstr("A/im1.png: no such file"));
  EXPECT_THAT(set.problems[1].reason, ::testing::HasSubstr("B/disp0GT.pfm: no such file"));
  EXPECT_THAT(set.problems[2].reason, ::testing::HasSubstr("C/calib.txt: 'ndisp=many'"));
}

TEST_F(Layouts, MiddleburySaysHowToArrangeAPairOfBooster) {
  const cv::Mat view(4, 6, CV_8UC3, cv::Scalar(1, 2, 3));
  write_image(folder_ / "Bottle/camera_00/im0.png", view);
  write_image(folder_ / "Bottle/camera_02/im0.png", view);
  const DataSet set = detect(Layout::kMiddlebury);
  ASSERT_EQ(set.problems.size(), 2U);
  EXPECT_THAT(set.problems[0].reason, ::testing::HasSubstr("camera_02/im0.png as im1.png"));
}

TEST(MiddleburyWeights, HalveTheFiveDifficultTrainingPairs) {
  double sum = 0;
  for (const char* name :
       {"Adirondack", "ArtL", "Jadeplant", "Motorcycle", "MotorcycleE", "Piano", "PianoL", "Pipes",
        "Playroom", "Playtable", "PlaytableP", "Recycle", "Shelves", "Teddy", "Vintage"}) {
    sum += middlebury_weight(name);
  }
  EXPECT_EQ(sum, 12.5);
  for (const char* name : {"PianoL", "Playroom", "Playtable", "Shelves", "Vintage"}) {
    EXPECT_EQ(middlebury_weight(name), 0.5) << name;
  }
}

TEST_F(Layouts, Eth3dIsDetectedByItsNamesAndHasASmallerRange) {
  write_pair_folder(folder_ / "forest_2s", small_pair(), 0);
  write_pair_folder(folder_ / "playground_1l", small_pair(), 0);
  write_file(folder_ / "playground_1l/calib.txt", "width=48\nndisp=48 \n");
  write_pair_folder(folder_ / "terrace_1s", small_pair(), 0);
  write_file(folder_ / "terrace_1s/calib.txt", "width=48\nndisp=20\n");
  const DataSet set = detect(Layout::kEth3d);
  ASSERT_EQ(set.pairs.size(), 3U);
  EXPECT_EQ(set.pairs[0].max_disparity, 64);
  EXPECT_EQ(set.pairs[1].max_disparity, 64);
  EXPECT_EQ(set.pairs[2].max_disparity, 20);
}

TEST_F(Layouts, InStereo2kDividesTheDisparitiesBy100) {
  write_image(folder_ / "000001/left.png", cv::Mat(8, 40, CV_8UC3, cv::Scalar(1, 2, 3)));
  write_image(folder_ / "000001/right.png", cv::Mat(8, 40, CV_8UC3, cv::Scalar(1, 2, 3)));
  write_image(folder_ / "000001/left_disp.png", cv::Mat(8, 40, CV_16UC1, cv::Scalar(1250)));
  const DataSet set = find_pairs(folder_.path(), detect_layout(folder_.path()));
  ASSERT_EQ(set.pairs.size(), 1U);
  EXPECT_FLOAT_EQ(load_pair(set.pairs[0], DmapMeaning::kAuto).truth.disparity.at<float>(2, 3),
                  12.5);
}

// A folder of an old Middlebury set with images of this width.
void write_old_set(const TemporaryFolder& folder, const std::string& names, int width,
                   const std::string& end = ".png") {
  const bool views = names.ends_with("Art");
  const cv::Mat gray(8, width, CV_8UC1, cv::Scalar(96));
  const cv::Mat color(8, width, CV_8UC3, cv::Scalar(96, 96, 96));
  write_image(folder / (names + (views ? "/view1" : "/im2") + end), color);
  write_image(folder / (names + (views ? "/view5" : "/im6") + end), color);
  write_image(folder / (names + (views           ? "/disp1.png"
                                 : end == ".ppm" ? "/disp2.pgm"
                                                 : "/disp2.png")),
              gray);
}

TEST_F(Layouts, MiddleburyDividesTheDisparitiesOfOldSetsByTheFactorOfTheirSize) {
  write_old_set(folder_, "full/Art", 1390);
  write_old_set(folder_, "half/Art", 695);
  write_old_set(folder_, "third/Art", 463);
  write_old_set(folder_, "2003/cones", 450);
  write_old_set(folder_, "2003half/cones", 900, ".ppm");
  write_old_set(folder_, "2001/venus", 434, ".ppm");
  std::map<std::string, std::pair<float, int>> read;
  for (const StereoPair& pair : detect(Layout::kMiddlebury).pairs) {
    read[pair.name] = {load_pair(pair).truth.disparity.at<float>(4, 20), *pair.max_disparity};
  }
  EXPECT_EQ(read, (std::map<std::string, std::pair<float, int>>{{"full/Art", {96, 256}},
                                                                {"half/Art", {48, 128}},
                                                                {"third/Art", {32, 85}},
                                                                {"2003/cones", {24, 64}},
                                                                {"2003half/cones", {48, 128}},
                                                                {"2001/venus", {12, 32}}}));
}

TEST_F(Layouts, Eth3dMayHaveItsGroundTruthInAFolderOfItsOwn) {
  write_pair_folder(folder_ / "two_view_training/forest_2s", small_pair(), 0);
  std::filesystem::create_directories(folder_ / "two_view_training_gt/forest_2s");
  std::filesystem::rename(folder_ / "two_view_training/forest_2s/disp0GT.pfm",
                          folder_ / "two_view_training_gt/forest_2s/disp0GT.pfm");
  EXPECT_EQ(detect(Layout::kEth3d).pairs.size(), 1U);
  const std::filesystem::path part = folder_ / "two_view_training/";
  EXPECT_EQ(find_pairs(part, Layout::kEth3d).pairs.size(), 1U);
}

// --- KITTI 2015

void write_kitti_frame(const TemporaryFolder& folder, const std::string& name, bool occ, bool noc) {
  write_image(folder / ("training/image_2/" + name), small_pair().left);
  write_image(folder / ("training/image_3/" + name), small_pair().right);
  if (occ) write_kitti_truth(folder / ("training/disp_occ_0/" + name), small_pair().truth);
  if (!noc) return;
  cv::Mat visible = small_pair().truth.clone();
  visible.rowRange(0, 12).setTo(0);
  write_kitti_truth(folder / ("training/disp_noc_0/" + name), visible);
}

TEST_F(Layouts, KittiReadsFrame10AndBothGroundTruths) {
  write_kitti_frame(folder_, "000003_10.png", true, true);
  write_image(folder_ / "training/image_2/000003_11.png", small_pair().left);
  write_image(folder_ / "training/image_2/000003_00.png", small_pair().left);
  const DataSet set = detect(Layout::kKitti2015);
  ASSERT_EQ(names_of(set), std::vector<std::string>{"000003_10"});
  EXPECT_TRUE(set.problems.empty());
  EXPECT_TRUE(set.notes.empty());
  EXPECT_EQ(set.pairs[0].max_disparity, 100);
  const LoadedPair pair = load_pair(set.pairs[0]);
  EXPECT_TRUE(std::isnan(pair.truth.disparity.at<float>(5, 3)));
  EXPECT_EQ(pair.truth.disparity.at<float>(5, 4), 4);
  EXPECT_EQ(cv::countNonZero(pair.truth.visible), 44 * 12);
}

TEST_F(Layouts, KittiAcceptsGrayCamerasAndTheTrainingFolder) {
  write_image(folder_ / "image_0/000000_10.png", small_pair().left);
  write_image(folder_ / "image_1/000000_10.png", small_pair().right);
  write_kitti_truth(folder_ / "disp_occ_0/000000_10.png", small_pair().truth);
  const DataSet set = detect(Layout::kKitti2015);
  ASSERT_EQ(set.pairs.size(), 1U);
  EXPECT_TRUE(load_pair(set.pairs[0]).truth.visible.empty());
}

TEST_F(Layouts, KittiReadsTheColorImagesOf2012) {
  write_image(folder_ / "training/colored_0/000000_10.png", small_pair().left);
  write_image(folder_ / "training/colored_1/000000_10.png", small_pair().right);
  write_kitti_truth(folder_ / "training/disp_occ/000000_10.png", small_pair().truth);
  EXPECT_EQ(detect(Layout::kKitti2015).pairs.size(), 1U);
}

TEST_F(Layouts, KittiNotesThatOnlyNonOccludedTruthExists) {
  write_kitti_frame(folder_, "000000_10.png", false, true);
  const DataSet set = detect(Layout::kKitti2015);
  ASSERT_EQ(set.pairs.size(), 1U);
  EXPECT_EQ(set.notes.size(), 1U);
  EXPECT_TRUE(std::isnan(load_pair(set.pairs[0]).truth.disparity.at<float>(5, 20)));
}

TEST_F(Layouts, KittiNamesFramesWithoutPartner) {
  write_kitti_frame(folder_, "000000_10.png", true, true);
  write_kitti_frame(folder_, "000001_10.png", false, true);
  write_kitti_frame(folder_, "000002_10.png", true, false);
  write_kitti_frame(folder_, "000003_10.png", true, true);
  std::filesystem::remove(folder_ / "training/image_3/000003_10.png");
  const DataSet set = detect(Layout::kKitti2015);
  EXPECT_EQ(names_of(set), std::vector<std::string>{"000000_10"});
  ASSERT_EQ(set.problems.size(), 3U);
  EXPECT_THAT(set.problems[0].reason, ::testing::HasSubstr("disp_occ_0/000001_10.png"));
  EXPECT_THAT(set.problems[1].reason, ::testing::HasSubstr("disp_noc_0/000002_10.png"));
  EXPECT_THAT(set.problems[2].reason, ::testing::HasSubstr("image_3/000003_10.png"));
}

// --- Scene Flow

void write_scene_flow(const TemporaryFolder& folder, const std::string& between,
                      const std::string& frame) {
  cv::Mat with_alpha(24, 48, CV_8UC4, cv::Scalar(50, 100, 150, 0));
  write_image(folder / ("frames_cleanpass/" + between + "left/" + frame + ".png"), with_alpha);
  write_image(folder / ("frames_cleanpass/" + between + "right/" + frame + ".png"), with_alpha);
  write_file(folder / ("disparity/" + between + "left/" + frame + ".pfm"),
             "Pf \n48 24 \n-1.0 \n" + testing::float_bytes(std::vector<float>(48 * 24, 7), false));
}

TEST_F(Layouts, DrivingIsDetectedByItsFolders) {
  write_scene_flow(folder_, "35mm_focallength/scene_forwards/fast/", "0001");
  write_scene_flow(folder_, "15mm_focallength/scene_backwards/slow/", "0002");
  const DataSet set = detect(Layout::kDriving);
  EXPECT_EQ(names_of(set), (std::vector<std::string>{"15mm_focallength/scene_backwards/slow/0002",
                                                     "35mm_focallength/scene_forwards/fast/0001"}));
  EXPECT_EQ(set.pairs[0].max_disparity, 192);
  const LoadedPair pair = load_pair(set.pairs[0]);
  EXPECT_EQ(pair.left.type(), CV_8UC1);
  EXPECT_EQ(pair.truth.disparity.at<float>(3, 3), 7);
}

TEST_F(Layouts, MonkaaHasOneFolderPerScene) {
  write_scene_flow(folder_, "a_rain_of_stones_x2/", "0000");
  EXPECT_EQ(names_of(detect(Layout::kMonkaa)),
            std::vector<std::string>{"a_rain_of_stones_x2/0000"});
}

TEST_F(Layouts, FlyingThingsSkipsWithdrawnFrames) {
  write_scene_flow(folder_, "TEST/A/0000/", "0006");
  write_scene_flow(folder_, "TEST/A/0000/", "0007");
  write_scene_flow(folder_, "TEST/B/0001/", "0006");
  write_file(folder_ / "all_unused_files.txt", "TEST/A/0000/left/0006.png\nTEST/B/0001/0006\n");
  EXPECT_EQ(names_of(detect(Layout::kFlyingThings)), std::vector<std::string>{"TEST/A/0000/0007"});
}

TEST_F(Layouts, SceneFlowReadsFramesDirectlyBelowThePass) {
  write_scene_flow(folder_, "", "0000");
  EXPECT_EQ(names_of(detect(Layout::kFlyingThings)), std::vector<std::string>{"0000"});
  EXPECT_EQ(names_of(find_pairs(folder_ / "frames_cleanpass", Layout::kFlyingThings)),
            std::vector<std::string>{"0000"});
}

TEST_F(Layouts, SceneFlowReadsTheFinalPassWhereThereIsNoCleanOne) {
  write_scene_flow(folder_, "one/", "0000");
  write_image(folder_ / "frames_finalpass/one/left/0000.png", small_pair().left);
  EXPECT_EQ(detect(Layout::kMonkaa).pairs.size(), 1U);
  std::filesystem::remove_all(folder_ / "frames_finalpass");
  std::filesystem::rename(folder_ / "frames_cleanpass", folder_ / "frames_finalpass");
  EXPECT_EQ(names_of(detect(Layout::kMonkaa)), std::vector<std::string>{"one/0000"});
}

TEST_F(Layouts, SceneFlowNamesFramesWithoutPartner) {
  write_scene_flow(folder_, "one/", "0000");
  write_scene_flow(folder_, "one/", "0001");
  write_scene_flow(folder_, "one/", "0002");
  std::filesystem::remove(folder_ / "frames_cleanpass/one/right/0000.png");
  std::filesystem::remove(folder_ / "disparity/one/left/0001.pfm");
  const DataSet set = detect(Layout::kMonkaa);
  EXPECT_EQ(names_of(set), std::vector<std::string>{"one/0002"});
  ASSERT_EQ(set.problems.size(), 2U);
  EXPECT_THAT(set.problems[0].reason, ::testing::HasSubstr("one/right/0000.png: no such file"));
  EXPECT_THAT(set.problems[1].reason, ::testing::HasSubstr("one/left/0001.pfm: no such file"));
}

// --- folders without a layout

TEST_F(Layouts, RejectFoldersWithoutALayout) {
  write_file(folder_ / "file", "");
  EXPECT_INPUT_ERROR(detect_layout(folder_ / "none"), "none: no such folder");
  EXPECT_INPUT_ERROR(detect_layout(folder_ / "file"), "file: is not a folder");
  EXPECT_INPUT_ERROR(detect_layout(folder_.path()), "into left/ and right/");
  for (const std::string& name : layout_names()) {
    EXPECT_INPUT_ERROR(find_pairs(folder_.path(), *find_layout(name)), "layout of " + name);
  }
}

TEST_F(Layouts, FollowFolderLinksWithoutLooping) {
  write_pair_folder(folder_ / "A", small_pair(), 30);
  std::filesystem::create_directory_symlink(folder_.path(), folder_ / "A/loop");
  EXPECT_EQ(detect(Layout::kMiddlebury).pairs.size(), 1U);
}

TEST_F(Layouts, NameTheFileOfAnotherSize) {
  write_pair_folder(folder_ / "A", small_pair(), 30);
  const StereoPair pair = find_pairs(folder_.path(), Layout::kMiddlebury).pairs.at(0);
  write_image(folder_ / "A/im1.png", cv::Mat(24, 40, CV_8UC1, cv::Scalar(1)));
  EXPECT_INPUT_ERROR(load_pair(pair), "im1.png: is 40x24, the left image 48x24");
  write_image(folder_ / "A/im1.png", small_pair().right);
  write_file(folder_ / "A/disp0GT.pfm", "Pf\n1 1\n-1\n" + testing::float_bytes({1}, false));
  EXPECT_INPUT_ERROR(load_pair(pair), "disp0GT.pfm: is 1x1, the left image 48x24");
  write_pair_folder(folder_ / "A", small_pair(), 30);
  write_image(folder_ / "A/mask0nocc.png", cv::Mat(24, 24, CV_8UC1, cv::Scalar(255)));
  EXPECT_INPUT_ERROR(load_pair(find_pairs(folder_.path(), Layout::kMiddlebury).pairs.at(0)),
                     "mask0nocc.png: is 24x24, the left image 48x24; replace it with the one of "
                     "this resolution, or remove it");
}

}  // namespace
}  // namespace mtstereo::eval::layouts_test
