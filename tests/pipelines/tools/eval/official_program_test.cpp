// SPDX-License-Identifier: LGPL-2.1-or-later

// mtstereo-eval --official as a process: tables, files, missing and broken masks.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "support.hpp"

namespace mtstereo::eval::official_program_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::make_pair;
using ::testing::Not;
using testing::Outcome;
using testing::read_file;
using testing::run_eval;
using testing::TemporaryFolder;
using testing::TestPair;
using testing::write_image;
using testing::write_kitti_truth;
using testing::write_pair_folder;

constexpr int kWidth = 200, kHeight = 100;

cv::Mat mask_of(int width, int value) { return {kHeight, width, CV_8UC1, cv::Scalar(value)}; }

class OfficialProgram : public ::testing::Test {
 protected:
  void write_kitti(bool occ, bool noc) const {
    const TestPair pair = make_pair(kWidth, kHeight, 9);
    const std::string name = "000000_10.png";
    write_image(folder_ / ("kitti/training/image_2/" + name), pair.left);
    write_image(folder_ / ("kitti/training/image_3/" + name), pair.right);
    if (occ) write_kitti_truth(folder_ / ("kitti/training/disp_occ_0/" + name), pair.truth);
    if (noc) write_kitti_truth(folder_ / ("kitti/training/disp_noc_0/" + name), pair.truth);
  }
  void write_objects(const cv::Mat& map) const {
    write_image(folder_ / "kitti/training/obj_map/000000_10.png", map);
  }
  Outcome run(const std::string& set, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{folder_ / set, "--official", "--json", folder_ / "r.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_eval(arguments);
  }
  json report() const { return json::parse(read_file(folder_ / "r.json")); }

  TemporaryFolder folder_;
};

TEST_F(OfficialProgram, PrintsD1WithAnObjectMap) {
  write_kitti(true, true);
  cv::Mat objects = mask_of(kWidth, 0);
  objects.colRange(100, 150).setTo(3);
  write_objects(objects);
  const Outcome run = this->run("kitti");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("official measures of kitti2015"));
  EXPECT_THAT(run.out, Not(HasSubstr("note: ")));
  const json mean = report()["official"]["kitti2015"]["mean"]["mtstereo"];
  for (const char* region : {"all", "noc"}) {
    EXPECT_LT(mean[region]["wrong"], 5.0) << region;
    EXPECT_TRUE(mean[region]["wrong_bg"].is_number()) << region;
    EXPECT_TRUE(mean[region]["wrong_fg"].is_number()) << region;
  }
  const json pair = report()["pairs"][0]["results"]["mtstereo"]["official"];
  EXPECT_EQ(pair["benchmark"], "kitti2015");
  EXPECT_EQ(pair["all"], mean["all"]);
}

TEST_F(OfficialProgram, NamesWhatAKittiPairLacks) {
  write_kitti(true, false);
  const Outcome all = run("kitti");
  ASSERT_EQ(all.status, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("no object map (obj_map) for 1 of 1 pairs"));
  EXPECT_THAT(all.out, HasSubstr("no disp_noc for 1 of 1 pairs"));
  EXPECT_TRUE(report()["official"]["kitti2015"]["mean"]["mtstereo"]["all"]["wrong_fg"].is_null());
}

TEST_F(OfficialProgram, HasOnlyNocOfNonOccludedTruth) {
  write_kitti(false, true);
  const Outcome noc = run("kitti");
  ASSERT_EQ(noc.status, 0) << noc.err;
  EXPECT_THAT(noc.out, HasSubstr("no disp_occ for 1 of 1 pairs"));
  const json mean = report()["official"]["kitti2015"]["mean"]["mtstereo"];
  EXPECT_TRUE(mean["all"].is_null());
  EXPECT_TRUE(mean["noc"]["wrong"].is_number());
}

TEST_F(OfficialProgram, NamesABrokenObjectMapAndWhatToDo) {
  write_kitti(true, true);
  write_objects(mask_of(kWidth - 1, 0));
  const Outcome size = run("kitti");
  EXPECT_EQ(size.status, 1);
  EXPECT_THAT(size.err, HasSubstr("obj_map/000000_10.png: is 199x100, the left image 200x100; "
                                  "replace it"));
  EXPECT_THAT(size.err, HasSubstr("remove it"));
  write_objects(cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(0, 0, 0)));
  EXPECT_THAT(run("kitti").err, HasSubstr("is not an object map: it has 3 channels"));
  // Without the option the map is not read.
  EXPECT_EQ(run_eval({folder_ / "kitti"}).status, 0);
}

TEST_F(OfficialProgram, PrintsBadOfMiddleburyAndNamesMissingMasks) {
  write_pair_folder(folder_ / "set/A", make_pair(kWidth, kHeight, 9), 32);
  write_pair_folder(folder_ / "set/B", make_pair(kWidth, kHeight, 5), 32);
  write_image(folder_ / "set/A/mask0nocc.png", mask_of(kWidth, 255));
  const Outcome run = this->run("set");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("official measures of middlebury: bad2.0"));
  EXPECT_THAT(run.out, HasSubstr("200x100"));
  EXPECT_THAT(run.out, HasSubstr("no mask0nocc.png for 1 of 2 pairs"));
  const json entry = report()["official"]["middlebury"];
  EXPECT_EQ(entry["threshold"], 2);
  EXPECT_EQ(entry["mean"]["mtstereo"]["all_pairs"], 2);
  EXPECT_EQ(entry["mean"]["mtstereo"]["noc_pairs"], 1);
}

TEST_F(OfficialProgram, PrintsEachBenchmarkOfARunAndAllMethods) {
  write_kitti(true, true);
  write_pair_folder(folder_ / "eth/forest_2s", make_pair(kWidth, kHeight, 9), 0);
  const Outcome run = run_eval({folder_ / "kitti", folder_ / "eth", "--official", "--compare",
                                "sgbm-3way", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("official measures of kitti2015"));
  EXPECT_THAT(run.out, HasSubstr("official measures of eth3d: bad1.0"));
  EXPECT_THAT(run.out, Not(HasSubstr("official measures of middlebury")));
  for (const char* benchmark : {"kitti2015", "eth3d"}) {
    EXPECT_TRUE(report()["official"][benchmark]["mean"].contains("sgbm-3way")) << benchmark;
  }
}

}  // namespace
}  // namespace mtstereo::eval::official_program_test
