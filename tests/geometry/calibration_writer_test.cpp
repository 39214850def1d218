// SPDX-License-Identifier: LGPL-2.1-or-later
// write_calibration(): read back by this library, by cv::FileStorage and by yaml-cpp.
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <opencv2/core.hpp>

#include "calibration_support.hpp"

namespace mtstereo::test::calibration_writer_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

/// A pair whose numbers have no short decimal form.
StereoCalibration awkward_pair(LensModel lens, std::size_t coefficients) {
  StereoCalibration pair = plumb_bob_pair();
  pair.left.focal_x = 536.0 + 1.0 / 3;
  pair.left.lens = pair.right.lens = lens;
  pair.left.coefficients.assign(coefficients, 1e-7 / 3);
  pair.right.coefficients.assign(coefficients, -1.0 / 7);
  pair.rectification->baseline = pair.baseline() * (1 + 1e-9);
  pair.rectification->right_center_x += 12.3;
  return pair;
}

void expect_equal(const StereoCalibration& actual, const StereoCalibration& expected) {
  EXPECT_EQ(actual.left, expected.left);
  EXPECT_EQ(actual.right, expected.right);
  EXPECT_EQ(actual.rotation, expected.rotation);
  EXPECT_EQ(actual.translation, expected.translation);
  EXPECT_EQ(actual.rectification, expected.rectification);
}

TEST(WriteCalibration, IsEqualAfterItWasReadAgain) {
  const CalibrationFolder folder;
  const std::string path = folder.path("calibration.yml");
  const std::pair<LensModel, std::size_t> lenses[] = {
      {LensModel::kNone, 0},     {LensModel::kPlumbBob, 4},  {LensModel::kPlumbBob, 5},
      {LensModel::kPlumbBob, 8}, {LensModel::kPlumbBob, 12}, {LensModel::kPlumbBob, 14},
      {LensModel::kFisheye, 4},
  };
  for (const auto& [lens, count] : lenses) {
    StereoCalibration pair = awkward_pair(lens, count);
    pair.date = "2026-02-03T04:05:06Z";
    ASSERT_TRUE(write_calibration(pair, path).ok());
    const StereoCalibration again = read_valid(path);
    expect_equal(again, pair);
    EXPECT_EQ(again.format, "mtstereo");
    EXPECT_EQ(again.date, pair.date);
  }
}

TEST(WriteCalibration, KeepsWhatIsOpenAndDifferentSizes) {
  const CalibrationFolder folder;
  const std::string path = folder.path("calibration.yml");
  StereoCalibration pair = plumb_bob_pair();
  pair.rectification->width = 800;
  pair.rectification->height = 500;
  pair.right.width = 644;
  pair.right.height = 484;
  ASSERT_TRUE(write_calibration(pair, path).ok());
  expect_equal(read_valid(path), pair);
  pair.rectification.reset();
  ASSERT_TRUE(write_calibration(pair, path).ok());
  expect_equal(read_valid(path), pair);
  pair.left.width = pair.left.height = pair.right.width = pair.right.height = 0;
  ASSERT_TRUE(write_calibration(pair, path).ok());
  expect_equal(read_valid(path), pair);
}

// In files of others, such a principal point indicates that the height is stated first.
TEST(WriteCalibration, KeepsThePrincipalPointOfCroppedImages) {
  const CalibrationFolder folder;
  const std::string path = folder.path("calibration.yml");
  StereoCalibration pair = plumb_bob_pair();
  pair.left.center_x = pair.left.height / 2.0;
  pair.left.center_y = pair.left.width / 2.0;
  ASSERT_TRUE(write_calibration(pair, path).ok());
  expect_equal(read_valid(path), pair);
}

TEST(WriteCalibration, StatesUnitAndDate) {
  const CalibrationFolder folder;
  const std::string path = folder.path("calibration.yml");
  ASSERT_TRUE(write_calibration(plumb_bob_pair(), path).ok());
  EXPECT_THAT(read_text(path), HasSubstr("length_unit: m\n"));
  EXPECT_THAT(read_valid(path).date,
              MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]T[0-2][0-9]:[0-5][0-9]:[0-6][0-9]Z"));
}

cv::Mat matrix_of(const cv::FileStorage& file, const char* name) {
  cv::Mat matrix;
  file[name] >> matrix;
  return matrix;
}

TEST(WriteCalibration, IsReadByFileStorage) {
  const CalibrationFolder folder;
  const std::string path = folder.path("calibration.yml");
  const StereoCalibration pair = awkward_pair(LensModel::kPlumbBob, 8);
  ASSERT_TRUE(write_calibration(pair, path).ok());
  const cv::FileStorage file(path, cv::FileStorage::READ);
  ASSERT_TRUE(file.isOpened());
  const cv::Mat k = matrix_of(file, "M1");
  ASSERT_EQ(k.size(), cv::Size(3, 3));
  EXPECT_EQ(k.at<double>(0, 0), pair.left.focal_x);
  EXPECT_EQ(k.at<double>(1, 2), pair.left.center_y);
  EXPECT_EQ(matrix_of(file, "D2").at<double>(0, 7), pair.right.coefficients[7]);
  EXPECT_EQ(matrix_of(file, "R").at<double>(2, 1), pair.rotation[7]);
  EXPECT_EQ(matrix_of(file, "T").at<double>(0, 0), pair.translation[0]);
  EXPECT_EQ(matrix_of(file, "R2").at<double>(1, 0), pair.rectification->right_rotation[3]);
  const cv::Mat p2 = matrix_of(file, "P2");
  EXPECT_DOUBLE_EQ(p2.at<double>(0, 3),
                   -pair.rectification->focal_length * pair.rectification->baseline);
  cv::Size size;
  file["image_size"] >> size;
  EXPECT_EQ(size, cv::Size(640, 480));
  EXPECT_EQ(static_cast<std::string>(file["length_unit"]), "m");
  // Q turns a column, a row and a disparity into a point.
  const cv::Mat q = matrix_of(file, "Q");
  const double disparity = 20;
  const cv::Mat point = q * (cv::Mat_<double>(4, 1) << 400, 300, disparity, 1);
  const Rectification& views = *pair.rectification;
  const double depth = views.focal_length * views.baseline / (disparity + views.principal_offset());
  EXPECT_NEAR(point.at<double>(2) / point.at<double>(3), depth, 1e-9);
  EXPECT_NEAR(point.at<double>(0) / point.at<double>(3),
              (400 - views.left_center_x) * depth / views.focal_length, 1e-9);
}

TEST(WriteCalibration, IsPlainYaml) {
  const CalibrationFolder folder;
  const std::string path = folder.path("calibration.yml");
  const StereoCalibration pair = awkward_pair(LensModel::kFisheye, 4);
  ASSERT_TRUE(write_calibration(pair, path).ok());
  const YAML::Node file = YAML::LoadFile(path);
  EXPECT_EQ(file["M2"]["data"][0].as<double>(), pair.right.focal_x);
  EXPECT_EQ(file["D1"]["data"][3].as<double>(), pair.left.coefficients[3]);
  EXPECT_EQ(file["lens_model_1"].as<std::string>(), "fisheye");
  EXPECT_EQ(file["image_size"][0].as<int>(), 640);
}

TEST(WriteCalibration, ReplacesItsOwnFileAndLeavesNothingElse) {
  const CalibrationFolder folder;
  const std::string path = folder.write("calibration.yml", "");
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(write_calibration(plumb_bob_pair(), path).ok());
  EXPECT_THAT(folder.names(), ElementsAre("calibration.yml"));
  StereoCalibration wrong = plumb_bob_pair();
  wrong.translation = {-120, 0, 0};
  const Status refused = write_calibration(wrong, path);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidCalibration);
  wrong = plumb_bob_pair();
  wrong.date = "2026\"\nM1: 0";
  EXPECT_FALSE(write_calibration(wrong, path).ok());
  EXPECT_THAT(folder.names(), ElementsAre("calibration.yml"));
  expect_equal(read_valid(path), plumb_bob_pair());
}

TEST(WriteCalibration, ReplacesNoFileOfOthers) {
  const CalibrationFolder folder;
  const std::string path = folder.write("stereo.yml", "%YAML:1.0\nM1: 0\n");
  const Status status = write_calibration(plumb_bob_pair(), path);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kSystem);
  EXPECT_THAT(status.error().message, AllOf(HasSubstr(path), HasSubstr("did not write it")));
  EXPECT_THAT(folder.names(), ElementsAre("stereo.yml"));
  EXPECT_EQ(read_text(path), "%YAML:1.0\nM1: 0\n");
}

TEST(WriteCalibration, NamesTheFileThatCannotBeWritten) {
  const CalibrationFolder folder;
  for (const std::string& path : {folder.path("none/calibration.yml"), folder.path(".")}) {
    const Status status = write_calibration(plumb_bob_pair(), path);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::kSystem);
    EXPECT_THAT(status.error().message, HasSubstr(path));
  }
  EXPECT_TRUE(folder.names().empty());
  test::make_pipe(folder.path("pipe"));
  EXPECT_FALSE(write_calibration(plumb_bob_pair(), folder.path("pipe")).ok());
}

}  // namespace
}  // namespace mtstereo::test::calibration_writer_test
