// SPDX-License-Identifier: LGPL-2.1-or-later
// Feature: check of a recording, with remedies
// What the figures of a check mean. check_program_test.py has whole recordings.
#include "recordings/checks/findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mtstereo::run::findings_test {
namespace {

using ::testing::HasSubstr;

// A good pair of cameras: 640x480 px, 30 pairs per second.
CheckFigures good_figures() {
  CheckFigures figures;
  Work& work = figures.work;
  work.left.width = work.right.width = 640;
  work.left.height = work.right.height = 480;
  work.period = 33'333'333;
  figures.range = FoundRange{12, 50, 48, 64};
  figures.inspection.trusted = true;
  figures.inspection.density = 0.7;
  figures.inspection.sharpness = 1;
  figures.diagnosis.matched = 0.8;
  figures.views.fill({110, 200, 0.001, 1});
  figures.times.measured = figures.times.confirmed = true;
  figures.modes = {{kSemiDense, 0.7, 0.004, 20, 0.2}};
  return figures;
}

class Findings : public ::testing::Test {
 protected:
  // There is one finding, with these words.
  void expect(bool harms, const std::string& problem, const std::string& remedy) const {
    const std::vector<Finding> found = find_problems(figures_);
    ASSERT_EQ(found.size(), 1u) << texts(found);
    EXPECT_EQ(found[0].harms, harms) << texts(found);
    EXPECT_NE(found[0].advice.problem.find(problem), std::string::npos) << texts(found);
    EXPECT_NE(found[0].advice.remedy.find(remedy), std::string::npos) << texts(found);
  }
  void expect_none() const {
    const std::vector<Finding> found = find_problems(figures_);
    EXPECT_TRUE(found.empty()) << texts(found);
  }
  static std::string texts(const std::vector<Finding>& found) {
    std::string text;
    for (const Finding& each : found) {
      text += (each.harms ? "HARM " : "note ") + each.advice.problem + " > " + each.advice.remedy +
              "\n";
    }
    return text;
  }
  ViewFigures& right() { return figures_.views[1]; }

  CheckFigures figures_ = good_figures();
};

TEST_F(Findings, AreNoneForAGoodRecording) { expect_none(); }

TEST_F(Findings, NameExchangedViews) {
  figures_.diagnosis = {ViewProblem::kSwapped, 0.03, 0.72};
  figures_.modes.clear();
  expect(true, "exchanged: in the other order, 72 % of the points match instead of 3 %", "--swap");
}

TEST_F(Findings, HarmIfTheDiagnosisIsWorthless) {
  for (const auto problem :
       {ViewProblem::kUpsideDown, ViewProblem::kMirrored, ViewProblem::kFlipped,
        ViewProblem::kOutOfStep, ViewProblem::kNotRectified, ViewProblem::kWrongCalibration,
        ViewProblem::kSameView}) {
    figures_ = good_figures();
    figures_.diagnosis.problem = problem;
    figures_.modes.clear();
    const std::vector<Finding> found = find_problems(figures_);
    ASSERT_EQ(found.size(), 1u) << texts(found);
    EXPECT_TRUE(found[0].harms);
    EXPECT_FALSE(found[0].advice.problem.empty());
    EXPECT_FALSE(found[0].advice.remedy.empty());
  }
}

TEST_F(Findings, HarmOfUnrelatedViewsNeedsASparseMap) {
  figures_.diagnosis = {ViewProblem::kUnknown, 0.05};
  expect(false, "Few points of the left view", "same scene");
  figures_.modes = {{kSemiDense, 0.2, 0.004, 20, 0.2}};
  expect(true, "Few points of the left view", "same scene");
}

TEST_F(Findings, BlameTheLightForFewPointsFirst) {
  figures_.diagnosis = {ViewProblem::kUnknown, 0.05};
  for (const bool dark : {false, true}) {
    figures_.views[1].mean = dark ? figures_.views[0].mean : figures_.views[0].mean / 3;
    figures_.views[1].bright = dark ? 40 : figures_.views[0].bright;
    const std::vector<Finding> found = find_problems(figures_);
    ASSERT_EQ(found.size(), 2u) << texts(found);
    EXPECT_THAT(found[0].advice.problem, HasSubstr("Few points of the left view"));
    EXPECT_THAT(found[0].advice.remedy, HasSubstr("The light of the views (below)"));
    EXPECT_THAT(found[1].advice.problem, HasSubstr(dark ? "Dark" : "exposure differs"));
  }
}

TEST_F(Findings, NameTheTimeBetweenTheViews) {
  figures_.times.apart = 0.025;
  expect(true, "25 ms (0.75 frames) later", "--sync auto");
  figures_.times.apart = -0.025;
  expect(true, "25 ms (0.75 frames) earlier", "--sync auto");
  figures_.times.apart = 0.015;  // pairing cannot do better
  expect(true, "15 ms (0.45 frames) later", "Trigger the cameras");
}

TEST_F(Findings, NameTheFramesBetweenTheViews) {
  figures_.diagnosis = {ViewProblem::kOutOfStep, 0.3, 0.7, 0, -2};
  figures_.modes.clear();
  figures_.times.measured = false;
  expect(true, "2 frames earlier, 70 % of the points match instead of 30 %. That is about 67 ms.",
         "--sync auto");
  figures_.times.measured = true;
  figures_.times.apart = 0.06;
  expect(true, "By the motion it is 60 ms (1.80 frames) later", "--sync auto");
  figures_.work.clocks.emplace();  // given by the user
  expect(true, "By the motion it is 60 ms (1.80 frames) later", "Check the offset of --sync");
}

TEST_F(Findings, NoteFramesWithoutAPartner) {
  figures_.work.pairs.pairs.resize(100);
  figures_.work.pairs.dropped_left = 5;
  figures_.work.pairs.dropped_right = 11;  // of 111
  expect_none();
  figures_.work.pairs.dropped_right = 20;
  expect(false, "5 left and 20 right frames have no partner", "at the same rate");
}

TEST_F(Findings, NoteATimeThatIsShortOrNotSure) {
  figures_.times.apart = 0.01;
  expect(false, "10 ms (0.30 frames) later", "trigger");
  figures_.times.deviation = 0.01;
  expect_none();
  figures_.times.deviation = 0;
  figures_.times.apart = 0.025;
  figures_.times.confirmed = false;
  expect(false, "25 ms", "trigger");
  figures_.times.measured = false;
  expect(false, "by the times of their frames", "trigger");
  figures_.times.apart = 0.003;
  expect_none();
}

TEST_F(Findings, NameRowsThatDisagree) {
  figures_.inspection.problems = "out-of-step";
  expect(true, "disagree about the rows", "Trigger the cameras");
}

TEST_F(Findings, NoteRowsThatAreCorrected) {
  figures_.inspection.field = "0.9,0,0,0,0";
  expect_none();
  figures_.inspection.field = "3,0.5,0,0,0";
  expect(false, "The rows of the right view are 2.5 to 3.5 px lower: alignment=correct",
         "--calibration");
  figures_.work.recording.rectified = false;
  expect(false, "After the rectification, the rows", "Calibrate again");
}

TEST_F(Findings, HarmIfRowsDifferOverTheView) {
  figures_.inspection.field = "0,4,0,0,0";
  expect(true, "not rectified: the rows of the right view are 4.0 px higher to 4.0 px lower",
         "Calibrate the cameras");
  figures_.work.recording.rectified = false;
  figures_.work.recording.calibration = "old.yml";
  expect(true, "The calibration old.yml does not fit these views", "or calibrate again");
}

TEST_F(Findings, HarmIfRowsAreNotCorrected) {
  figures_.corrected = false;
  expect_none();
  figures_.inspection.field = "-0.6,0,0,0,0";
  expect(true, "0.6 px higher, and are not corrected", "--alignment correct");
}

TEST_F(Findings, NameTheRangeThatSuffices) {
  figures_.range = FoundRange{12, 120, 50, 144};
  expect_none();  // nothing reliable is beyond the default
  figures_.range->reliable = 120;
  expect(false, "reach 120 px; the default range ends at 64 px", "max-disparity=144");
  figures_.range_given = true;
  figures_.work.options.parameters = {{"max-disparity", "144"}};
  expect_none();
  figures_.work.options.parameters = {{"max-disparity", "288"}};
  expect(false, "takes more time", "max-disparity=144");
  figures_.range.reset();  // the views do not match
  expect_none();
  figures_.range = FoundRange{12, 120, 120, 144};
  figures_.work.options.parameters = {{"max-disparity", "96"}};
  figures_.diagnosis = {ViewProblem::kRangeTooSmall, 0.4, 0.7, 144};
  expect(true, "range is too small", "Set max-disparity=144");
}

TEST_F(Findings, NameViewsThatShowNothingOrRepeatThemselves) {
  for (const PairProblem problem : {PairProblem::kLeftBlank, PairProblem::kRightBlank,
                                    PairProblem::kLeftFrozen, PairProblem::kRightFrozen}) {
    figures_.inspection.problems = problem_name(problem);
    const bool left = problem == PairProblem::kLeftBlank || problem == PairProblem::kLeftFrozen;
    expect(true, left ? "The left view" : "The right view", "Check");
  }
}

TEST_F(Findings, OfABlankViewAreNoOthers) {
  figures_.inspection.problems = "right-blank";
  figures_.diagnosis.problem = ViewProblem::kUnknown;
  figures_.modes = {{kSemiDense, 0, 0, 20, 0}};
  right() = {2, 3, 0, 0};
  expect(true, "The right view shows nothing.",
         "Check whether its lens is covered, or its values use few of 16 bits.");
}

TEST_F(Findings, NameWhiteAndDarkViews) {
  right().saturated = 0.15;
  expect_none();
  right().saturated = 0.25;
  expect(false, "0 % of the left and 25 % of the right view", "Expose less");
  right().saturated = 0.5;
  expect(true, "50 % of the right view", "Expose less");
  right().saturated = 0;
  right().bright = 45;
  expect(false, "below 200 (left) and 45 (right) of 255", "More light");
  right().bright = 20;
  expect(true, "20 (right) of 255", "More light");
  right().bright = 4;
  expect(true, "4 (right) of 255", "If the values have 10 or 12 of 16 bits, scale them");
}

TEST_F(Findings, NoteNoiseAndDifferentExposure) {
  right().noise = 8;
  expect(false, "Noisy: 1.0 (left) and 8.0 (right) gray values", "less gain");
  right() = {60, 200, 0.001, 1};
  expect(false, "mean gray values are 110 (left) and 60 (right)", "same fixed exposure");
}

TEST_F(Findings, NameTheSofterView) {
  figures_.inspection.problems = "sharpness-differs";
  figures_.inspection.sharpness = 1.5;
  expect(false, "The right view is less sharp", "focus its lens");
  figures_.inspection.sharpness = 0.4;
  expect(true, "The left view is less sharp: the other one has 2.5 times", "focus its lens");
}

TEST_F(Findings, NameTheResolutionOfSoftViews) {
  figures_.modes[0].fine_detail = 0.05;
  expect(false, "finest detail is 0.05", "half-refined is faster; resolution=auto");
  figures_.modes[0].fine_detail = 0;  // not known
  expect_none();
  figures_.modes[0].density = 0.4;
  figures_.modes.push_back({kHalfRefined, 0.55, 0.01, 10, 0});
  expect(false, "hides the finest texture", "for 55 % of the pixels instead of 40 %");
  figures_.modes[1].density = 0.45;
  expect_none();
}

TEST_F(Findings, NameSparseMaps) {
  figures_.modes[0].density = 0.2;
  expect(false, "Only 20 %", "docs/quickstart.md");
  figures_.modes[0].density = 0.03;
  expect(true, "Only 3 %", "docs/quickstart.md");
}

TEST_F(Findings, OfTinyViewsSayThatNothingCanBeChecked) {
  figures_.work.left.width = 64;
  figures_.diagnosis.problem = ViewProblem::kTooLittleTexture;
  expect(false, "too small to check", "96x64");
  figures_.work.left.width = 640;
  expect(false, "too little texture", "a scene with texture");
}

TEST_F(Findings, BeginWithThoseThatHarm) {
  right().noise = 8;
  figures_.inspection.problems = "sharpness-differs";
  figures_.inspection.sharpness = 3;
  const std::vector<Finding> found = find_problems(figures_);
  ASSERT_EQ(found.size(), 2u) << texts(found);
  EXPECT_TRUE(found[0].harms && !found[1].harms) << texts(found);
}

}  // namespace
}  // namespace mtstereo::run::findings_test
