// SPDX-License-Identifier: LGPL-2.1-or-later
// The calibration file of mtstereo: the matrices of OpenCV's stereo_calib in YAML that OpenCV's
// FileStorage and plain YAML readers both accept. So matrices have no tag, and every number has a
// decimal point.
#include "geometry/calibration_writer.hpp"

#include <array>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/guard.hpp"
#include "geometry/formats/value.hpp"
#include "geometry/new_file.hpp"

namespace mtstereo {
namespace {

/// In the first lines of each file: NewFile replaces only files with it.
constexpr const char* kWrittenBy = "written_by: mtstereo";

/// A number that YAML 1.1 reads as one: "1.0e-05" and not "1e-05".
std::string yaml_number(double value) {
  std::string text = formats::number_text(value);
  if (text.find('.') != std::string::npos) return text;
  const std::size_t exponent = text.find('e');
  return text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
}

class Text {
 public:
  void line(std::string_view line) { text_.append(line).append("\n"); }
  void entry(const char* name, const std::string& value) { line(std::string(name) + ": " + value); }
  void size(const char* name, int width, int height) {
    entry(name, "[ " + std::to_string(width) + ", " + std::to_string(height) + " ]");
  }
  void matrix(const char* name, int rows, int columns, const std::vector<double>& values) {
    line(std::string(name) + ":");
    line("   rows: " + std::to_string(rows));
    line("   cols: " + std::to_string(columns));
    line("   dt: d");
    std::string data = "   data: [ ";
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool row_end = (i + 1) % static_cast<std::size_t>(columns) == 0;
      data += yaml_number(values[i]);
      data += i + 1 == values.size() ? " ]" : row_end ? ",\n       " : ", ";
    }
    line(data);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::vector<double> list_of(const Matrix3& matrix) { return {matrix.begin(), matrix.end()}; }

const char* lens_name(LensModel lens) {
  switch (lens) {
    case LensModel::kNone:
      return "none";
    case LensModel::kPlumbBob:
      return "plumb_bob";
    case LensModel::kFisheye:
      return "fisheye";
    case LensModel::kOmnidirectional:
      return "omnidirectional";
  }
  return "none";
}

void write_camera(Text& text, const CameraCalibration& camera, const char* matrix,
                  const char* distortion, const char* lens) {
  text.matrix(matrix, 3, 3,
              {camera.focal_x, 0, camera.center_x, 0, camera.focal_y, camera.center_y, 0, 0, 1});
  // A pinhole has zeros, for programs that need coefficients.
  constexpr std::size_t kPinholeCoefficients = 5;
  std::vector<double> coefficients = camera.coefficients;
  if (camera.lens == LensModel::kNone) coefficients.assign(kPinholeCoefficients, 0);
  text.entry(lens, lens_name(camera.lens));
  text.matrix(distortion, 1, static_cast<int>(coefficients.size()), coefficients);
}

void write_rectification(Text& text, const Rectification& r) {
  const double f = r.focal_length;
  text.line("# The rectified views. Baseline in meters.");
  if (r.width > 0) text.size("rectified_size", r.width, r.height);
  text.entry("rectified_baseline", yaml_number(r.baseline));
  text.matrix("R1", 3, 3, list_of(r.left_rotation));
  text.matrix("R2", 3, 3, list_of(r.right_rotation));
  text.matrix("P1", 3, 4, {f, 0, r.left_center_x, 0, 0, f, r.center_y, 0, 0, 0, 1, 0});
  text.matrix("P2", 3, 4,
              {f, 0, r.right_center_x, -f * r.baseline, 0, f, r.center_y, 0, 0, 0, 1, 0});
  text.matrix("Q", 4, 4,
              {1, 0, 0, -r.left_center_x, 0, 1, 0, -r.center_y, 0, 0, 0, f, 0, 0, 1 / r.baseline,
               r.principal_offset() / r.baseline});
}

std::string now() {
  const std::time_t seconds = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return {text.data(), length};
}

Status write_file(const std::string& text, const std::string& path) {
  NewFile file(path);
  if (Status status = file.open(kWrittenBy); !status) return status;
  if (Status status = file.write(text.data(), text.size()); !status) return status;
  if (Status status = file.sync(); !status) return status;
  return file.finish();
}

}  // namespace

std::string calibration_text(const StereoCalibration& calibration, const std::string& date) {
  Text text;
  text.line("%YAML 1.0");
  text.line("---");
  text.line(
      "# Calibration of two cameras. R and T: a point X of the left camera (1) is R X + T in");
  text.line("# the right camera (2). x points to the right, y downwards, z forward.");
  text.line(kWrittenBy);
  text.entry("date", "\"" + (calibration.date.empty() ? date : calibration.date) + "\"");
  text.entry("length_unit", "m");
  const CameraCalibration& left = calibration.left;
  const CameraCalibration& right = calibration.right;
  if (left.width > 0) {
    text.size("image_size", left.width, left.height);
    if (right.width != left.width || right.height != left.height) {
      text.size("image_size_2", right.width, right.height);
    }
  }
  write_camera(text, left, "M1", "D1", "lens_model_1");
  write_camera(text, right, "M2", "D2", "lens_model_2");
  text.matrix("R", 3, 3, list_of(calibration.rotation));
  const Vector3& t = calibration.translation;
  text.matrix("T", 3, 1, {t[0], t[1], t[2]});
  if (calibration.rectification) write_rectification(text, *calibration.rectification);
  return text.take();
}

Status write_calibration(const StereoCalibration& calibration, const std::string& path) noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_calibration(calibration); !status) return status;
    for (const char letter : calibration.date) {
      if (letter < ' ' || letter > '~' || letter == '"' || letter == '\\') {
        return Error{ErrorCode::kInvalidCalibration, "the date of the calibration is not ISO 8601"};
      }
    }
    return write_file(calibration_text(calibration, now()), path);
  });
}

}  // namespace mtstereo
