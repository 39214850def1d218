// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-render as a process: files, exit status and messages.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <iomanip>
#include <sstream>
#include <string>

#include "support/temporary_folder.hpp"

namespace mtstereo::render::program_test {
namespace {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

namespace fs = std::filesystem;

struct Outcome {
  int status = -1;
  std::string output, errors;
};

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    program_ = std::getenv("MTSTEREO_RENDER");
    ASSERT_NE(program_, nullptr) << "MTSTEREO_RENDER must name the program";
  }

  Outcome run(const std::string& arguments) const {
    std::ostringstream command;
    command << std::quoted(program_) << ' ' << arguments << " >" << folder_ / "stdout"
            << " 2>" << folder_ / "stderr"
            << " </dev/null";
    const int raw = std::system(command.str().c_str());
    Outcome outcome;
    outcome.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128;
    outcome.output = read_text(folder_ / "stdout");
    outcome.errors = read_text(folder_ / "stderr");
    return outcome;
  }

  // The folder of the clip, quoted for the shell by the stream operator of a path.
  std::string out() const {
    std::ostringstream text;
    text << folder_ / "clip" << ' ';
    return text.str();
  }

  const char* program_ = nullptr;
  TemporaryFolder folder_;
};

TEST_F(Program, RendersAClip) {
  const Outcome r = run(out() + "--size 48x27 --frames 3 --scene garden");
  EXPECT_EQ(r.status, 0) << r.errors;
  EXPECT_NE(r.output.find("3 frames of 48x27"), std::string::npos) << r.output;
  for (const char* file : {"left/000002.png", "right/000002.png", "truth/000002.pfm",
                           "mask/000002.png", "calib.txt"}) {
    EXPECT_TRUE(fs::is_regular_file(folder_ / "clip" / file)) << file;
  }
  EXPECT_FALSE(fs::exists(folder_ / "clip/left/000003.png"));
}

TEST_F(Program, WritesTheSameBytesInEveryRun) {
  ASSERT_EQ(run(out() + "--size 48x27 --frames 2 --threads 1").status, 0);
  const std::string first = read_text(folder_ / "clip/right/000001.png");
  ASSERT_EQ(run(out() + "--size 48x27 --frames 2 --threads 3 --overwrite").status, 0);
  EXPECT_EQ(first, read_text(folder_ / "clip/right/000001.png"));
}

TEST_F(Program, RendersABadCameraWithTheTruthOfAGoodOne) {
  ASSERT_EQ(run(out() + "--size 48x27 --frames 1").status, 0);
  const std::string truth = read_text(folder_ / "clip/truth/000000.pfm");
  const std::string right = read_text(folder_ / "clip/right/000000.png");
  const Outcome r = run(out() +
                        "--size 48x27 --frames 1 --overwrite --shot-noise 0.1 --light 0.5 "
                        "--gain 2 --vignette 0.4 --blur 0.6 --rim-blur 1 --mosaic --jpeg 50 "
                        "--roll 0.5 --pitch 0.2 --yaw -0.1 "
                        "--focal-ratio 1.01 --row-offset -2");
  EXPECT_EQ(r.status, 0) << r.errors;
  EXPECT_EQ(truth, read_text(folder_ / "clip/truth/000000.pfm"));
  EXPECT_NE(right, read_text(folder_ / "clip/right/000000.png"));
}

TEST_F(Program, WritesTheMiddleburyLayout) {
  const Outcome r = run(out() + "--size 48x27 --frames 1 --layout middlebury");
  EXPECT_EQ(r.status, 0) << r.errors;
  EXPECT_TRUE(fs::is_regular_file(folder_ / "clip/000000/disp0GT.pfm"));
}

TEST_F(Program, RendersRawCamerasWithTheirCalibration) {
  const Outcome r = run(out() + "--size 96x64 --frames 1 --scene room --lens wide");
  EXPECT_EQ(r.status, 0) << r.errors;
  for (const char* file : {"left/000000.png", "right/000000.png", "truth/000000.pfm",
                           "mask/000000.png", "calib.txt", "truth-calibration.yml"}) {
    EXPECT_TRUE(fs::is_regular_file(folder_ / "clip" / file)) << file;
  }
  const std::string view = read_text(folder_ / "clip/left/000000.png");
  const std::string truth = read_text(folder_ / "clip/truth/000000.pfm");
  fs::rename(folder_ / "clip/truth-calibration.yml", folder_ / "rig.yml");
  // The calibration stands for the cameras.
  std::ostringstream raw;
  raw << "--frames 1 --scene room --overwrite --raw " << folder_ / "rig.yml";
  const Outcome again = run(out() + raw.str());
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_EQ(view, read_text(folder_ / "clip/left/000000.png"));
  EXPECT_EQ(truth, read_text(folder_ / "clip/truth/000000.pfm"));
  EXPECT_EQ(read_text(folder_ / "rig.yml"), read_text(folder_ / "clip/truth-calibration.yml"));
  const Outcome smaller = run(out() + raw.str() + " --size 48x32");
  EXPECT_EQ(smaller.status, 0) << smaller.errors;
  EXPECT_NE(smaller.output.find("48x32"), std::string::npos) << smaller.output;
}

TEST_F(Program, ShowsTheTruthOfAnotherRectification) {
  const std::string room = "--size 96x64 --frames 1 --scene room --depth";
  const std::string options = room + " --lens wide";
  ASSERT_EQ(run(out() + options).status, 0);
  const std::string view = read_text(folder_ / "clip/left/000000.png");
  const std::string truth = read_text(folder_ / "clip/truth/000000.pfm");
  const std::string depth = read_text(folder_ / "clip/depth/000000.pfm");
  EXPECT_EQ(depth.size(), truth.size());
  fs::rename(folder_ / "clip/truth-calibration.yml", folder_ / "rig.yml");
  std::ostringstream other;
  other << options << " --overwrite --rectification " << folder_ / "rig.yml";
  // The same pair: the truth is the same.
  ASSERT_EQ(run(out() + other.str()).status, 0);
  EXPECT_EQ(truth, read_text(folder_ / "clip/truth/000000.pfm"));
  EXPECT_EQ(depth, read_text(folder_ / "clip/depth/000000.pfm"));
  // Another scale and size: another truth of the same views.
  const Outcome all = run(out() + other.str() + " --alpha 1 --rectified-size 81x50");
  EXPECT_EQ(all.status, 0) << all.errors;
  EXPECT_EQ(view, read_text(folder_ / "clip/left/000000.png"));
  EXPECT_EQ(read_text(folder_ / "clip/truth/000000.pfm").substr(0, 9), "Pf\n81 50\n");
  EXPECT_NE(run(out() + other.str() + " --alpha 2").errors.find("alpha"), std::string::npos);
  EXPECT_NE(run(out() + options + " --alpha 1").errors.find("need rectification"),
            std::string::npos);
  // Other cameras: another truth of the same views.
  ASSERT_EQ(run(out() + room + " --overwrite --lens fisheye").status, 0);
  fs::rename(folder_ / "clip/truth-calibration.yml", folder_ / "rig.yml");
  ASSERT_EQ(run(out() + other.str()).status, 0);
  EXPECT_EQ(view, read_text(folder_ / "clip/left/000000.png"));
  EXPECT_NE(truth, read_text(folder_ / "clip/truth/000000.pfm"));
}

TEST_F(Program, RendersABoardWithItsPoses) {
  const Outcome r =
      run(out() + "--size 96x72 --scene board --poses 2 --rest 2 --move 1 --samples 1");
  EXPECT_EQ(r.status, 0) << r.errors;
  EXPECT_NE(r.output.find("5 frames"), std::string::npos) << r.output;
  EXPECT_TRUE(fs::is_regular_file(folder_ / "clip/right/000004.png"));
  EXPECT_TRUE(fs::is_regular_file(folder_ / "clip/truth-calibration.yml"));
  EXPECT_FALSE(fs::exists(folder_ / "clip/truth"));
  const std::string poses = read_text(folder_ / "clip/poses.txt");
  EXPECT_NE(poses.find("\n1 1 "), std::string::npos) << poses;
  EXPECT_NE(poses.find("\n2 0 "), std::string::npos) << poses;
  EXPECT_NE(poses.find("\n4 1 "), std::string::npos) << poses;
}

TEST_F(Program, ShowsAImageOnTheBoard) {
  ASSERT_EQ(run(out() + "--size 64x48 --frames 1").status, 0);
  std::ostringstream image;
  image << "--picture " << folder_ / "clip/left/000000.png"
        << " --picture-width 0.4";
  std::ostringstream board;
  board << folder_ / "board"
        << " --size 96x72 --scene board --poses 1 --samples 1 --lens wide ";
  const Outcome r = run(board.str() + image.str());
  EXPECT_EQ(r.status, 0) << r.errors;
  const Outcome missing = run(board.str() + "--overwrite --picture /dev/null/x --picture-width 1");
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.errors.find("/dev/null/x"), std::string::npos) << missing.errors;
}

struct Bad {
  const char* arguments;
  const char* says;
};

TEST_F(Program, RejectsInvalidOptionsByName) {
  const Bad cases[] = {
      {"--size 640", "--size"},
      {"--size 640x360x3", "--size"},
      {"--size axb", "--size"},
      {"--size 0x10", "width"},
      {"--size 10x-4", "two numbers"},
      {"--frames 0", "--frames"},
      {"--frames many", "--frames"},
      {"--scene moon", "street, garden, room, board"},
      {"--baseline -1", "baseline"},
      {"--focal nan", "focal"},
      {"--noise 1e9", "noise"},
      {"--exposure 0", "exposure"},
      {"--rate 0", "--rate"},
      {"--layout kitti", "--layout"},
      {"--shot-noise -1", "shot-noise"},
      {"--light 0", "light"},
      {"--gain 1e9", "gain"},
      {"--vignette 2", "vignette"},
      {"--jpeg 101", "jpeg"},
      {"--jpeg good", "--jpeg"},
      {"--roll 90", "roll"},
      {"--pitch nan", "pitch"},
      {"--yaw -20", "yaw"},
      {"--focal-ratio 2", "focal-ratio"},
      {"--row-offset 1000", "row-offset"},
      {"--samples 99", "samples"},
      {"--blur -1", "blur"},
      {"--rim-blur 11", "rim-blur"},
      {"--rim-blur soft", "--rim-blur"},
      {"--mosaic=maybe", "--mosaic"},
      {"--lens narrow", "wide, fisheye"},
      {"--lens wide --raw x.yml", "combined"},
      {"--lens wide --roll 1", "combined"},
      {"--lens wide --focal 300", "focal"},
      {"--raw x.yml --baseline 1", "baseline"},
      {"--raw /dev/null/x.yml", "/dev/null/x.yml"},
      {"--scene board --squares 10", "--squares"},
      {"--scene board --squares 1x1", "squares"},
      {"--scene board --square 0", "square"},
      {"--scene board --picture x.png", "picture-width"},
      {"--scene board --poses 0", "poses"},
      {"--scene board --rest 0", "rest"},
      {"--scene board --move -1", "move"},
      {"--scene board --tilt 80", "tilt"},
      {"--scene board --visible 0", "visible"},
      {"--scene board --layout middlebury", "layout"},
      {"--no-such-option", "--no-such-option"},
  };
  for (const Bad& bad : cases) {
    const Outcome r = run(out() + bad.arguments);
    EXPECT_EQ(r.status, 2) << bad.arguments;
    EXPECT_NE(r.errors.find(bad.says), std::string::npos) << bad.arguments << ": " << r.errors;
    EXPECT_FALSE(fs::exists(folder_ / "clip")) << bad.arguments;
  }
}

TEST_F(Program, RequiresAFolder) {
  const Outcome r = run("--frames 1");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.errors.find("folder"), std::string::npos) << r.errors;
}

TEST_F(Program, NamesAFolderThatCannotBeWritten) {
  const Outcome r = run("/dev/null/clip --frames 1 --size 8x8");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.errors.find("/dev/null/clip"), std::string::npos) << r.errors;
}

TEST_F(Program, KeepsAnEarlierClipWithoutOverwrite) {
  ASSERT_EQ(run(out() + "--size 8x8 --frames 2").status, 0);
  const Outcome refused = run(out() + "--size 8x8 --frames 1");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.errors.find("--overwrite"), std::string::npos) << refused.errors;
  EXPECT_EQ(run(out() + "--size 8x8 --frames 1 --overwrite").status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "clip/left/000001.png"));
}

TEST_F(Program, OverwriteKeepsForeignFilesAndInputs) {
  const std::string board = "--scene board --lens wide --poses 1 --size 64x48 ";
  ASSERT_EQ(run(out() + board).status, 0);
  const Outcome input = run(out() + "--scene board --poses 1 --overwrite --raw " +
                            (folder_ / "clip/truth-calibration.yml").string());
  EXPECT_EQ(input.status, 1);
  EXPECT_NE(input.errors.find("is an input"), std::string::npos) << input.errors;
  write_text(folder_ / "clip/left/mine.png", "mine");
  const Outcome refused = run(out() + board + "--overwrite");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.errors.find("left/mine.png is in the way"), std::string::npos)
      << refused.errors;
  EXPECT_EQ(read_text(folder_ / "clip/left/mine.png"), "mine");
}

TEST_F(Program, NumbersAreFinite) {
  for (const char* option :
       {"--rate", "--start", "--baseline", "--focal", "--noise", "--roll", "--rim-blur"}) {
    for (const char* value : {" nan", " inf"}) {
      EXPECT_EQ(run(out() + "--size 8x8 --frames 1 " + option + value).status, 2) << option;
    }
  }
}

TEST_F(Program, HelpSucceeds) {
  const Outcome r = run("--help");
  EXPECT_EQ(r.status, 0);
  EXPECT_NE(r.output.find("--scene"), std::string::npos) << r.output;
}

}  // namespace
}  // namespace mtstereo::render::program_test
