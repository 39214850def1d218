// SPDX-License-Identifier: LGPL-2.1-or-later

// mtstereo-eval --curve as a process.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "support.hpp"

namespace mtstereo::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::read_file;
using testing::run_eval;

class CurveProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::write_pair_folder(folder_ / "set/A", testing::make_pair(240, 120, 9), 32);
    testing::write_pair_folder(folder_ / "set/B", testing::make_pair(200, 100, 5), 16);
  }
  std::string set() const { return folder_ / "set"; }
  std::string picture() const { return folder_ / "new/curve.png"; }
  json report() const { return json::parse(read_file(folder_ / "r.json")); }
  testing::TempFolder folder_;
};

TEST_F(CurveProgram, PlotsPrintsAndReportsTheCurveOfTheLibrary) {
  const Outcome run = run_eval({set(), "--curve", picture(), "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out,
              HasSubstr("errors at equal density, middlebury, unweighted mean of 2 pairs"));
  const cv::Mat drawn = cv::imread(picture());
  ASSERT_EQ(drawn.size(), cv::Size(1200, 600));
  cv::Mat red;
  cv::inRange(drawn, cv::Scalar(38, 38, 208), cv::Scalar(42, 42, 212), red);
  EXPECT_GT(cv::countNonZero(red), 100) << "the line of the library";

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

TEST_F(CurveProgram, SweepsTheRequestedRivals) {
  // Noise reduces the difference between the best and the second-best cost.
  cv::RNG random(5);
  for (const char* pair : {"A", "B"}) {
    const std::string file = folder_ / "set" / pair / "im1.png";
    const cv::Mat clean = cv::imread(file, cv::IMREAD_GRAYSCALE);
    cv::Mat noise(clean.size(), CV_8UC1);
    random.fill(noise, cv::RNG::UNIFORM, 0, 90);
    testing::write_image(file, clean * 0.6 + noise);
  }
  const Outcome run = run_eval({set(), "--curve", picture(), "--json", folder_ / "r.json",
                                "--compare", "sgbm,sgbm-3way,sgbm-hh"});
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
  // The envelope of a rival is nowhere above its own line.
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
  const Outcome run = run_eval({set(), "--curve", picture(), "--json", folder_ / "r.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("unweighted mean of 2 pairs"));
  EXPECT_THAT(run.out, HasSubstr("left out: F: mtstereo has no disparity"));
  EXPECT_EQ(report()["curve"]["left_out"][0]["pair"], "F");
}

TEST_F(CurveProgram, WritesNoPictureWithoutAPairWithGroundTruth) {
  for (const char* pair : {"A", "B"}) fs::remove(folder_ / "set" / pair / "disp0GT.pfm");
  const Outcome nothing = run_eval({set(), "--curve", picture()});
  EXPECT_NE(nothing.status, 0);
  EXPECT_THAT(nothing.err, HasSubstr("disp0GT.pfm"));
  EXPECT_FALSE(fs::exists(picture()));

  for (const char* pair : {"A", "B"}) {
    testing::write_file(folder_ / "set" / pair / "disp0GT.pfm", "broken");
  }
  const Outcome broken = run_eval({set(), "--curve", picture()});
  EXPECT_EQ(broken.status, 1);
  EXPECT_THAT(broken.err, HasSubstr("curve.png: is not written: no pair"));
  EXPECT_FALSE(fs::exists(picture()));
}

TEST_F(CurveProgram, RejectsAnUnwritablePictureBeforeTheEvaluation) {
  testing::write_file(folder_ / "file", "");
  const Outcome run = run_eval({set(), "--curve", folder_ / "file/curve.png"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("file"));
  EXPECT_EQ(run.out, "");
  fs::create_directories(folder_ / "folder.png");
  EXPECT_THAT(run_eval({set(), "--curve", folder_ / "folder.png"}).err,
              HasSubstr("folder.png: is a folder"));
}

TEST_F(CurveProgram, WritesTheFiguresWithoutAPictureIfMatplotlibIsMissing) {
  const std::string hidden = testing::without_matplotlib(folder_ / "modules");
  const Outcome run =
      run_eval({set(), "--curve", picture(), "--json", folder_ / "r.json"}, {hidden});
  EXPECT_EQ(run.status, 1) << "as for every file that is not written";
  EXPECT_THAT(run.err,
              ::testing::EndsWith("/curve.png: no picture is drawn: Python's matplotlib is "
                                  "not installed: install the Debian package "
                                  "python3-matplotlib\n"));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_THAT(run.out, HasSubstr("errors at equal density"));
  EXPECT_EQ(report()["curve"]["curves"][0]["points"].size(), 255U);
  EXPECT_FALSE(fs::exists(picture()));
}

TEST_F(CurveProgram, WritesAReportThatReproducesThePicture) {
  const Outcome run = run_eval({set(), "--curve", picture(), "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Outcome again = testing::run_plot({"curve", folder_ / "r.json", folder_ / "again.png"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(read_file(picture()), read_file(folder_ / "again.png"));
}

// An installation that was moved to another root.
class InstalledCurveProgram : public CurveProgram {
 protected:
  void SetUp() override {
    CurveProgram::SetUp();
    fs::create_directories(program().parent_path());
    fs::copy_file(getenv("MTSTEREO_EVAL"), program());
  }
  fs::path installed(const char* folder) const { return folder_.path().string() + getenv(folder); }
  fs::path program() const { return installed("MTSTEREO_PROGRAM_FOLDER") / "mtstereo-eval"; }
  Outcome run() const {
    return testing::run_program(
        program(), {set(), "--only", "B", "--curve", picture()},
        {std::string("LD_LIBRARY_PATH=") + getenv("MTSTEREO_LIBRARY_FOLDER")});
  }
};

TEST_F(InstalledCurveProgram, FindsTheScriptBelowItsOwnPrefix) {
  fs::create_directories(installed("MTSTEREO_PLOT_FOLDER"));
  fs::copy_file(getenv("MTSTEREO_PLOT"), installed("MTSTEREO_PLOT_FOLDER") / "plot.py");
  const Outcome done = run();
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(cv::imread(picture()).size(), cv::Size(1200, 600));
}

TEST_F(InstalledCurveProgram, NamesTheScriptIfItIsMissing) {
  const Outcome done = run();
  EXPECT_EQ(done.status, 1);
  EXPECT_THAT(done.err,
              HasSubstr("curve.png: no picture is drawn: the file " +
                        (installed("MTSTEREO_PLOT_FOLDER") / "plot.py").string() + " is missing"));
  EXPECT_THAT(done.out, HasSubstr("errors at equal density"));
}

TEST_F(CurveProgram, RejectsAPictureThatIsNotPng) {
  for (const char* name : {"curve.jpg", "curve", ""}) {
    const Outcome run = run_eval({set(), "--curve", name});
    EXPECT_EQ(run.status, 2) << name;
    EXPECT_THAT(run.err, HasSubstr("--curve")) << name;
    EXPECT_THAT(run.err, HasSubstr(".png")) << name;
    EXPECT_EQ(run.out, "") << name;
  }
  EXPECT_EQ(run_eval({set(), "--curve"}).status, 2);
}

TEST_F(CurveProgram, NeverOverwritesAnInput) {
  const std::string before = read_file(folder_ / "set/A/im0.png");
  const Outcome run = run_eval({set(), "--only", "B", "--curve", folder_ / "set/A/im0.png"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("belongs to the data set"));
  EXPECT_EQ(read_file(folder_ / "set/A/im0.png"), before);
}

TEST_F(CurveProgram, ReplacesAnEarlierPicture) {
  for (int i = 0; i < 2; ++i) {
    const Outcome run = run_eval({set(), "--only", "B", "--curve", picture()});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_FALSE(cv::imread(picture()).empty());
  }
}

TEST_F(CurveProgram, KeepsAForeignPicture) {
  testing::write_file(picture(), "a picture of the user");
  const Outcome run = run_eval({set(), "--only", "B", "--curve", picture()});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("did not write it"));
  EXPECT_EQ(read_file(picture()), "a picture of the user");
}

TEST_F(CurveProgram, HasNoCurveByDefault) {
  const Outcome run = run_eval({set(), "--only", "B", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, Not(HasSubstr("equal density")));
  EXPECT_FALSE(report().contains("curve"));
}

}  // namespace
}  // namespace mtstereo::eval
