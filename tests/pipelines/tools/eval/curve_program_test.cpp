// SPDX-License-Identifier: LGPL-2.1-or-later

// mtstereo-eval --curve as a process.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "support.hpp"

namespace mtstereo::eval::curve_program_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::read_file;
using testing::run_eval;

class CurveProgram : public testing::TwoPairs {};

TEST_F(CurveProgram, PrintsAndReportsTheCurveOfTheLibrary) {
  const Outcome run = run_eval({set(), "--curve", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out,
              HasSubstr("errors at equal density, middlebury, unweighted mean of 2 pairs"));

  const json curve = report()["curve"];
  EXPECT_EQ(curve["pairs"], 2);
  ASSERT_EQ(curve["curves"].size(), 1U);
  const json& points = curve["curves"][0]["points"];
  ASSERT_EQ(points.size(), 255U);
  // At threshold 1 all pixels count: the unweighted mean of the pairs' figures.
  const json pairs = report()["pairs"];
  const auto figure = [&](int pair) {
    return pairs[pair]["results"]["mtstereo"]["all"]["avgerr"].get<double>();
  };
  EXPECT_NEAR(points[0]["avgerr"], (figure(0) + figure(1)) / 2, 1e-9);
  EXPECT_NEAR(points[0]["density"], report()["mean"]["mtstereo"]["density"], 1e-9);
}

TEST_F(CurveProgram, SweepsTheRequestedMethodsOfOpenCv) {
  // Noise reduces the difference between the best and the second-best cost.
  cv::RNG random(5);
  for (const char* pair : {"A", "B"}) {
    const std::string file = folder_ / "set" / pair / "im1.png";
    const cv::Mat clean = cv::imread(file, cv::IMREAD_GRAYSCALE);
    cv::Mat noise(clean.size(), CV_8UC1);
    random.fill(noise, cv::RNG::UNIFORM, 0, 90);
    testing::write_image(file, clean * 0.6 + noise);
  }
  const Outcome run = run_eval(
      {set(), "--curve", "--json", folder_ / "r.json", "--compare", "sgbm,sgbm-3way,sgbm-hh"});
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* name : {"sgbm", "sgbm-3way", "sgbm-hh"}) {
    EXPECT_THAT(run.out, HasSubstr("avgerr px  " + std::string(name) + " "));
    EXPECT_THAT(run.out, HasSubstr("avgerr px  " + std::string(name) + " + filters"));
  }
  EXPECT_THAT(run.out, HasSubstr("uniquenessRatio 0 5 10"));
  const json curves = report()["curve"]["curves"];
  ASSERT_EQ(curves.size(), 7U);
  EXPECT_EQ(curves[1]["points"].size(), 20U);
  EXPECT_GT(curves[2]["points"].size(), 30U);
  // The envelope of a method of OpenCV is nowhere above its own line.
  int compared = 0;
  for (std::size_t i = 0; i < curves[1]["at_density"].size(); ++i) {
    const json alone = curves[1]["at_density"][i]["avgerr"];
    if (alone.is_null()) continue;
    EXPECT_LE(curves[2]["at_density"][i]["avgerr"], alone) << i;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

TEST_F(CurveProgram, LeavesOutAPairThatOneMethodDidNotComplete) {
  testing::TestPair flat = testing::make_pair(240, 120, 9);
  flat.left.setTo(80);
  flat.right.setTo(80);
  testing::write_pair_folder(folder_ / "set/F", flat, 32);
  const Outcome run = run_eval({set(), "--curve", "--json", folder_ / "r.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("unweighted mean of 2 pairs"));
  EXPECT_THAT(run.out, HasSubstr("left out: F: mtstereo has no disparity"));
  EXPECT_EQ(report()["curve"]["left_out"][0]["pair"], "F");
}

TEST_F(CurveProgram, WritesAReportThatPlotPyDraws) {
  const Outcome run = run_eval({set(), "--curve", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Outcome plotted = testing::run_plot({"curve", folder_ / "r.json", folder_ / "curve.png"});
  ASSERT_EQ(plotted.status, 0) << plotted.err;
  const cv::Mat drawn = cv::imread(folder_ / "curve.png");
  ASSERT_EQ(drawn.size(), cv::Size(1200, 600));
  cv::Mat red;
  cv::inRange(drawn, cv::Scalar(38, 38, 208), cv::Scalar(42, 42, 212), red);
  EXPECT_GT(cv::countNonZero(red), 100) << "the line of the library";
}

}  // namespace
}  // namespace mtstereo::eval::curve_program_test
