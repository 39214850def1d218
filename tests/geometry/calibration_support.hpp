// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"
#include "support/temporary_folder.hpp"

// For the tests of calibration files.

namespace mtstereo::test {

inline constexpr Matrix3 kIdentity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/// The path of a file of tests/geometry/files/.
std::string stored(const std::string& name);
/// Its text.
std::string stored_text(const std::string& name);

/// A temporary folder for calibration files.
class CalibrationFolder : public TemporaryFolder {
 public:
  std::string path(const std::string& name) const { return *this / name; }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;
  /// The names of all files.
  std::vector<std::string> names() const;
};

/// The text with the first occurrence of `from` replaced, which must be there.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// Reads a calibration that must be valid. Nothing may be printed.
StereoCalibration read_valid(const std::string& path, int width = 0, int height = 0);
/// The message for a calibration that must be refused with kInvalidCalibration. Nothing may be
/// printed.
std::string read_refused(const std::string& path, int width = 0, int height = 0);

void expect_near(const CameraCalibration& actual, const CameraCalibration& expected,
                 double tolerance);
void expect_near(const Matrix3& actual, const Matrix3& expected, double tolerance);
void expect_near(const Vector3& actual, const Vector3& expected, double tolerance);
void expect_near(const Rectification& actual, const Rectification& expected, double tolerance);
/// Cameras, R, T and, if `rectification`, the rectification.
void expect_near(const StereoCalibration& actual, const StereoCalibration& expected,
                 double tolerance, bool rectification = true);

/// The pair of intrinsics.yml and extrinsics.yml, which is also that of camera_info_*.yaml.
StereoCalibration plumb_bob_pair();

}  // namespace mtstereo::test
