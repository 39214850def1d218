// SPDX-License-Identifier: LGPL-2.1-or-later
#include "calibration_support.hpp"

namespace mtstereo::test {
namespace fs = std::filesystem;

std::string stored(const std::string& name) { return std::string(MTSTEREO_TEST_FILES "/") + name; }

std::string stored_text(const std::string& name) { return read_text(stored(name)); }

std::string CalibrationFolder::write(const std::string& name, const std::string& text) const {
  write_text(*this / name, text);
  return path(name);
}

std::vector<std::string> CalibrationFolder::names() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(TemporaryFolder::path())) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "'" << from << "' is not in the text";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

namespace {

Result<StereoCalibration> read_silently(const std::string& path, int width, int height) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Result<StereoCalibration> result = read_calibration(path, width, height);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "") << path;
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << path;
  return result;
}

}  // namespace

StereoCalibration read_valid(const std::string& path, int width, int height) {
  Result<StereoCalibration> result = read_silently(path, width, height);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  EXPECT_TRUE(check_calibration(*result).ok());
  return *result;
}

std::string read_refused(const std::string& path, int width, int height) {
  const Result<StereoCalibration> result = read_silently(path, width, height);
  if (result) {
    ADD_FAILURE() << path << " was accepted";
    return {};
  }
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidCalibration);
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
  return result.error().message;
}

void expect_near(const CameraCalibration& actual, const CameraCalibration& expected,
                 double tolerance) {
  EXPECT_EQ(actual.width, expected.width);
  EXPECT_EQ(actual.height, expected.height);
  EXPECT_NEAR(actual.focal_x, expected.focal_x, tolerance);
  EXPECT_NEAR(actual.focal_y, expected.focal_y, tolerance);
  EXPECT_NEAR(actual.center_x, expected.center_x, tolerance);
  EXPECT_NEAR(actual.center_y, expected.center_y, tolerance);
  EXPECT_EQ(actual.lens, expected.lens);
  EXPECT_THAT(actual.coefficients,
              ::testing::Pointwise(::testing::DoubleNear(tolerance), expected.coefficients));
}

void expect_near(const Matrix3& actual, const Matrix3& expected, double tolerance) {
  EXPECT_THAT(actual, ::testing::Pointwise(::testing::DoubleNear(tolerance), expected));
}

void expect_near(const Vector3& actual, const Vector3& expected, double tolerance) {
  EXPECT_THAT(actual, ::testing::Pointwise(::testing::DoubleNear(tolerance), expected));
}

void expect_near(const Rectification& actual, const Rectification& expected, double tolerance) {
  EXPECT_EQ(actual.width, expected.width);
  EXPECT_EQ(actual.height, expected.height);
  expect_near(actual.left_rotation, expected.left_rotation, tolerance);
  expect_near(actual.right_rotation, expected.right_rotation, tolerance);
  EXPECT_NEAR(actual.focal_length, expected.focal_length, tolerance);
  EXPECT_NEAR(actual.left_center_x, expected.left_center_x, tolerance);
  EXPECT_NEAR(actual.right_center_x, expected.right_center_x, tolerance);
  EXPECT_NEAR(actual.center_y, expected.center_y, tolerance);
  EXPECT_NEAR(actual.baseline, expected.baseline, tolerance);
}

void expect_near(const StereoCalibration& actual, const StereoCalibration& expected,
                 double tolerance, bool rectification) {
  expect_near(actual.left, expected.left, tolerance);
  expect_near(actual.right, expected.right, tolerance);
  expect_near(actual.rotation, expected.rotation, tolerance);
  expect_near(actual.translation, expected.translation, tolerance);
  if (!rectification) return;
  ASSERT_EQ(actual.rectification.has_value(), expected.rectification.has_value());
  if (expected.rectification) {
    expect_near(*actual.rectification, *expected.rectification, tolerance);
  }
}

StereoCalibration plumb_bob_pair() {
  StereoCalibration pair;
  pair.left = {640,
               480,
               536.07345,
               536.01636,
               342.37038,
               235.53687,
               LensModel::kPlumbBob,
               {-0.26509028, -0.046743552, 0.0018330091, -0.00031471690, 0.25231221}};
  pair.right = {640,
                480,
                539.21984,
                538.90551,
                327.10352,
                248.51093,
                LensModel::kPlumbBob,
                {-0.27764973, 0.072441105, -0.00098250361, 0.00035210427, -0.014807703}};
  pair.rotation = {0.999915537,  -0.004249650, -0.012282510, 0.004150022, 0.999958376,
                   -0.008125513, 0.012316529,  0.008073854,  0.999891552};
  pair.translation = {-0.12153, 0.00112, -0.00231};
  Rectification views;
  views.width = 640;
  views.height = 480;
  views.left_rotation = {0.999888338,  -0.013308664, 0.006796449, 0.013336404, 0.999902853,
                         -0.004052757, -0.006741852, 0.004142945, 0.999968691};
  views.right_rotation = {0.999776963, -0.009213776, 0.019003413,  0.009135819, 0.999949510,
                          0.004185010, -0.019041013, -0.004010465, 0.999810660};
  views.focal_length = 530.25;
  views.left_center_x = views.right_center_x = 330.125;
  views.center_y = 240.5;
  views.baseline = 0.121557112;
  pair.rectification = views;
  return pair;
}

}  // namespace mtstereo::test
