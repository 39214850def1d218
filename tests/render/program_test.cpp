// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-render as a process: files, exit status and messages.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <iomanip>
#include <sstream>
#include <string>

#include "temporary_folder.hpp"

namespace mtstereo::render {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int status = -1;
  std::string output, errors;
};

class Program : public testing::Test {
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
                        "--gain 2 --vignette 0.4 --jpeg 50 --roll 0.5 --pitch 0.2 --yaw -0.1 "
                        "--focal-ratio 1.01 --row-offset -2 --sky 2 --sky-gradient 0");
  EXPECT_EQ(r.status, 0) << r.errors;
  EXPECT_EQ(truth, read_text(folder_ / "clip/truth/000000.pfm"));
  EXPECT_NE(right, read_text(folder_ / "clip/right/000000.png"));
}

TEST_F(Program, WritesTheMiddleburyLayout) {
  const Outcome r = run(out() + "--size 48x27 --frames 1 --layout middlebury");
  EXPECT_EQ(r.status, 0) << r.errors;
  EXPECT_TRUE(fs::is_regular_file(folder_ / "clip/000000/disp0GT.pfm"));
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
      {"--size 10x-4", "height"},
      {"--frames 0", "--frames"},
      {"--frames many", "--frames"},
      {"--scene moon", "street, garden, room"},
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
      {"--sky -1", "sky"},
      {"--sky-gradient 2", "sky-gradient"},
      {"--lights=maybe", "--lights"},
      {"--jpeg 101", "jpeg"},
      {"--jpeg good", "--jpeg"},
      {"--roll 90", "roll"},
      {"--pitch nan", "pitch"},
      {"--yaw -20", "yaw"},
      {"--focal-ratio 2", "focal-ratio"},
      {"--row-offset 1000", "row-offset"},
      {"--samples 99", "samples"},
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

TEST_F(Program, HelpSucceeds) {
  const Outcome r = run("--help");
  EXPECT_EQ(r.status, 0);
  EXPECT_NE(r.output.find("--scene"), std::string::npos) << r.output;
}

}  // namespace
}  // namespace mtstereo::render
