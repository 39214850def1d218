// SPDX-License-Identifier: LGPL-2.1-or-later
// What is decided once for a recording.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lib/outputs/user_error.hpp"
#include "mtstereo/alignment.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/matching/view_geometry.hpp"
#include "recordings/matching/work_options.hpp"
#include "recordings/matching/work_text.hpp"
#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"
#include "support/error_of.hpp"

namespace mtstereo::run::prepare_test {
namespace {

using ::testing::AllOf;
using testing::constant_times;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;
using testing::View;
using testing::write_view;

std::string value_of(const Work& work, const std::string& name) {
  for (const auto* list : {&work.correction, &work.options.parameters}) {
    for (const auto& [each, value] : *list) {
      if (each == name) return value;
    }
  }
  return "";
}

class Preparation : public ::testing::Test {
 protected:
  // Two videos; the right view is `row_offset` px lower.
  void write(int frames, int row_offset) {
    const std::string coding = "avenc_ffv1 ! matroskamux";
    recording_.name = "test";
    recording_.left.video = folder_ / "left.mkv";
    recording_.right.video = folder_ / "right.mkv";
    write_view(recording_.left.video, View::kLeft, coding, constant_times(frames));
    write_view(recording_.right.video, View::kRight, coding, constant_times(frames), row_offset);
    options_.parameters = {{"max-disparity", "24"}};
  }
  Work prepared() const { return prepare(recording_, options_, std::nullopt, false); }
  std::string refusal() const {
    return test::error_of<UserError>([&] { prepared(); });
  }

  TemporaryFolder folder_;
  Recording recording_;
  WorkOptions options_;
};

TEST_F(Preparation, MeasuresTheCorrectionOnce) {
  write(20, 2);
  const Work work = prepared();
  EXPECT_EQ(value_of(work, "alignment"), "hold");
  const Result<RowField> field = RowField::parse(value_of(work, "alignment-field"));
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->offset, 2, 0.1);
  ASSERT_EQ(work.remarks.size(), 1u);
  EXPECT_NE(work.remarks[0].find("lower"), std::string::npos) << work.remarks[0];
  EXPECT_EQ(prepared().correction, work.correction);
}

TEST_F(Preparation, CorrectsNothingWhereRowsAreRight) {
  write(5, 0);
  const Work work = prepared();
  const Result<RowField> field = RowField::parse(value_of(work, "alignment-field"));
  ASSERT_TRUE(field);
  EXPECT_EQ(*field, RowField{});
  EXPECT_TRUE(work.remarks.empty()) << work.remarks[0];
}

TEST_F(Preparation, DoesNotInspectIfThatIsSwitchedOff) {
  write(3, 2);
  options_.parameters.emplace_back("alignment", "off");
  EXPECT_EQ(prepared().correction,
            (std::vector<std::pair<std::string, std::string>>{{"alignment", "off"}}));
  options_.parameters = {{"max-disparity", "24"}, {"preset", "paper"}};
  EXPECT_EQ(value_of(prepared(), "alignment"), "off");
}

TEST_F(Preparation, ReportsSwappedViews) {
  write(10, 0);
  std::swap(recording_.left, recording_.right);
  const Work work = prepared();
  ASSERT_FALSE(work.remarks.empty());
  EXPECT_NE(work.remarks[0].find("exchanged"), std::string::npos) << work.remarks[0];
  EXPECT_NE(work.remarks[0].find("--swap"), std::string::npos) << work.remarks[0];
  EXPECT_EQ(work.doubt, work.remarks[0]);
}

TEST_F(Preparation, ReportsAViewThatEndsBeforeTheOther) {
  write(40, 0);
  EXPECT_TRUE(prepared().remarks.empty());
  write_view(recording_.right.video, View::kRight, "avenc_ffv1 ! matroskamux", constant_times(10));
  EXPECT_EQ(
      prepared().remarks,
      std::vector<std::string>{"The right view ends at 0.300 s, 1.000 s before the other one."});
}

TEST_F(Preparation, HasThePeriodOfTheFrames) {
  write(10, 0);
  EXPECT_EQ(prepared().period, 33'333'333);  // from time stamps in milliseconds
}

TEST_F(Preparation, TakesTheSearchRangeOfTheDataSet) {
  write(3, 0);
  options_.parameters.clear();
  recording_.max_disparity = 40;
  EXPECT_EQ(value_of(prepared(), "max-disparity"), "40");
  options_.parameters = {{"max-disparity", "16"}};
  EXPECT_EQ(value_of(prepared(), "max-disparity"), "16");
}

// Feature: recognition of videos, images and data sets
TEST_F(Preparation, FindsTheSearchRange) {
  write(12, 0);  // disparities of 6 and 11 px
  for (const char* const value : {"auto", "0"}) {
    options_.parameters = {{"max-disparity", value}};
    const Work work = prepared();
    EXPECT_EQ(value_of(work, "max-disparity"), "16") << value;
    ASSERT_FALSE(work.remarks.empty());
    EXPECT_NE(work.remarks[0].find("max-disparity is 16"), std::string::npos) << work.remarks[0];
    EXPECT_EQ(fingerprint(work), fingerprint(prepared()));  // --resume finds the same
  }
}

TEST_F(Preparation, FindsTheSearchRangeInsteadOfThatOfTheDataSet) {
  write(3, 2);  // rows that are out of place do not matter
  recording_.max_disparity = 100;
  options_.parameters = {{"max-disparity", "auto"}, {"mode", "sparse"}};
  const Work work = prepared();
  EXPECT_EQ(value_of(work, "max-disparity"), "16");
  EXPECT_EQ(value_of(work, "mode"), "sparse");
}

TEST_F(Preparation, KeepsTheDefaultRangeIfNothingMatches) {
  write(6, 0);
  // Flat images.
  const std::string flat =
      "videobalance contrast=0 ! videoconvert ! video/x-raw,format=GRAY8 ! avenc_ffv1 ! "
      "matroskamux";
  write_view(recording_.right.video, View::kRight, flat, constant_times(6));
  options_.parameters = {{"max-disparity", "auto"}};
  const Work work = prepared();
  EXPECT_EQ(value_of(work, "max-disparity"), "");
  ASSERT_FALSE(work.remarks.empty());
  EXPECT_NE(work.remarks[0].find("cannot be found"), std::string::npos) << work.remarks[0];
}

TEST_F(Preparation, IsDescribed) {
  write(10, 0);
  recording_.kind = "two video files";
  std::vector<std::string> lines = recognized(prepared());
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "Input: two video files, 160x96 px, 10 pairs, 30 per second.");
  EXPECT_EQ(lines[1], "Views: taken as rectified, without a calibration: no distances.");
  EXPECT_EQ(lines[2], "Matching: mode semi-dense, disparities 0 to 23 px.");
  EXPECT_EQ(lines[3], "Results: disparity (mkv).");
  recording_.calibration = testing::write_stereo_calibration(folder_.path()).string();
  options_.parameters = {{"max-disparity", "24"}, {"preset", "fast"}, {"mode", "dense"}};
  options_.products = {Product::kDepth, Product::kRectifiedLeft};
  lines = recognized(prepared());
  EXPECT_NE(lines[1].find("taken as rectified; the calibration gives the meters"),
            std::string::npos)
      << lines[1];
  EXPECT_EQ(lines[2], "Matching: preset fast, mode dense, disparities 0 to 23 px.");
  EXPECT_EQ(lines[3], "Results: depth, rectified-left (mkv).");
}

TEST(WorkOptions, ScaleFitsTheSearchRange) {
  Work work;
  work.left.width = 2000;
  work.left.height = 1000;
  work.options.parameters = {{"max-disparity", "600"}};
  complete_options(work);
  EXPECT_EQ(value_of(work, "disparity-scale"), "64");
  work.options.parameters = {{"max-disparity", "300"}};
  complete_options(work);
  EXPECT_EQ(value_of(work, "disparity-scale"), "128");
  work.options.parameters = {{"max-disparity", "600"}, {"disparity-scale", "256"}};
  EXPECT_THROW(complete_options(work), UserError);
}

TEST(WorkOptions, RefuseAResolutionThatDependsOnTheFramesBefore) {
  WorkOptions options;
  options.parameters = {{"resolution", "auto"}};
  EXPECT_THAT([&] { matcher_parameters(options); },
              ThrowsMessage<UserError>(HasSubstr("set full, or half-refined")));
  options.parameters = {{"resolution", "half-refined"}};
  EXPECT_NO_THROW(matcher_parameters(options));
}

TEST(WorkOptions, RefuseMapsThatDependOnThePairBefore) {
  WorkOptions options;
  for (const std::string temporal : {"hold", "filter"}) {
    options.parameters = {{"temporal", temporal}};
    EXPECT_THAT([&] { matcher_parameters(options); },
                ThrowsMessage<UserError>(AllOf(HasSubstr("temporal = " + temporal),
                                               HasSubstr("use mtstereo in a pipeline"))));
  }
  options.parameters = {{"temporal", "off"}};
  EXPECT_NO_THROW(matcher_parameters(options));
}

TEST_F(Preparation, FindsTheGeometry) {
  write(3, 0);
  EXPECT_FALSE(prepared().geometry);
  recording_.calibration = testing::write_stereo_calibration(folder_.path()).string();
  const Work work = prepared();
  ASSERT_TRUE(work.geometry);
  EXPECT_EQ(work.geometry->views.focal_length, 100);
  EXPECT_EQ(work.geometry->views.width, 160);
  EXPECT_NE(measures_text(work).find("baseline 0.100 m"), std::string::npos) << measures_text(work);
  EXPECT_NE(measures_text(work).find("(23 px)"), std::string::npos) << measures_text(work);
}

TEST_F(Preparation, RefusesCloudsThatBeginBeyondTheirEnd) {
  write(3, 0);
  recording_.calibration = testing::write_stereo_calibration(folder_.path()).string();
  options_.products = {Product::kCloud};
  options_.near = 3;
  EXPECT_NE(refusal().find("set --far"), std::string::npos) << refusal();
  options_.far = 0;
  EXPECT_EQ(refusal(), "");
}

TEST_F(Preparation, RectifiesInTheShapeThatIsStated) {
  write(3, 0);
  recording_.calibration = testing::write_stereo_calibration(folder_.path()).string();
  recording_.shape = {.alpha = 1, .width = 80, .height = 48};
  EXPECT_NE(refusal().find("--alpha and --rectified-size have no meaning"), std::string::npos)
      << refusal();
  recording_.rectified = false;
  const Work work = prepared();
  ASSERT_TRUE(work.geometry);
  EXPECT_EQ(work.geometry->views.width, 80);
  EXPECT_EQ(work.geometry->views.height, 48);
  EXPECT_NEAR(work.geometry->views.focal_length, 50, 1);
  recording_.shape.alpha = 0.5;
  EXPECT_NE(fingerprint(prepared()), fingerprint(work));
}

TEST_F(Preparation, StatesWhatTheCamerasMeasureAndWhatIsUnusual) {
  write(3, 0);
  recording_.calibration = testing::write_stereo_calibration(folder_.path()).string();
  const auto stated = [this](const char* text) {
    const Work work = prepared();
    return std::any_of(work.remarks.begin(), work.remarks.end(), [&](const std::string& remark) {
      return remark.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(stated("focal length 100.0 px, baseline 0.100 m"));
  EXPECT_FALSE(stated("exchanged"));
  testing::write_text(recording_.calibration,
                      "cam0=[100 0 79.5; 0 100 47.5; 0 0 1]\ncam1=[100 0 79.5; 0 100 47.5; 0 0 1]\n"
                      "doffs=0\nbaseline=-100\nwidth=160\nheight=96\nndisp=24\n");
  EXPECT_TRUE(stated("they are exchanged"));
}

TEST_F(Preparation, RefusesACalibrationThatGivesNoMetersIfTheyAreNeeded) {
  write(3, 0);
  recording_.calibration = (folder_ / "calib.txt").string();
  testing::write_text(recording_.calibration, "cam0=[100 0 79.5; 0 100 47.5; 0 0 1]\n");
  const Work work = prepared();
  EXPECT_FALSE(work.geometry);
  ASSERT_FALSE(work.remarks.empty());
  EXPECT_NE(work.remarks[0].find("calib.txt"), std::string::npos) << work.remarks[0];
  options_.products = {Product::kDepth};
  EXPECT_NE(refusal().find("calib.txt"), std::string::npos) << refusal();
  options_.products = {Product::kDisparity};
  recording_.rectified = false;
  EXPECT_NE(refusal().find("calib.txt"), std::string::npos) << refusal();
}

TEST_F(Preparation, RefusesWhatCannotBeMade) {
  write(3, 0);
  options_.products = {Product::kDepth};
  EXPECT_NE(refusal().find("need a calibration"), std::string::npos);
  options_.products = {Product::kCloud};
  EXPECT_NE(refusal().find("need a calibration"), std::string::npos);
  options_.products = {Product::kDisparity};
  recording_.rectified = false;
  EXPECT_NE(refusal().find("not rectified"), std::string::npos);
}

TEST_F(Preparation, RefusesParametersThatAreNotValid) {
  write(3, 0);
  for (const auto& [name, value, text] : {std::tuple{"max-disparity", "-1", "max-disparity"},
                                          {"max-disparity", "automatic", "max-disparity"},
                                          {"no-such", "1", "no-such"},
                                          {"mode", "best", "mode"},
                                          {"alignment", "monitor", "alignment"},
                                          {"disparity-scale", "1.5", "disparity-scale"},
                                          {"max-disparity", "1000", "160"}}) {
    options_.parameters = {{name, value}};
    EXPECT_NE(refusal().find(text), std::string::npos) << name << '=' << value << ": " << refusal();
  }
}

TEST_F(Preparation, NamesTheOffsetOfTimesThatAreFarApart) {
  write(3, 0);
  std::vector<Nanoseconds> later = constant_times(3);
  for (Nanoseconds& time : later) time += 5 * kSecond;
  write_view(recording_.right.video, View::kRight, "avenc_ffv1 ! matroskamux", later);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("the left view begins at 0.000 s, the right one at 5.000"),
                               HasSubstr("(--sync 5.000)")));
}

TEST_F(Preparation, RefusesViewsOfDifferentSizes) {
  write(3, 0);
  write_view(recording_.right.video, View::kBoth, "avenc_ffv1 ! matroskamux", constant_times(3));
  EXPECT_NE(refusal().find("different sizes"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace mtstereo::run::prepare_test
