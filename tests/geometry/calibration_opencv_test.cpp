// SPDX-License-Identifier: LGPL-2.1-or-later
// Files that cv::FileStorage itself writes, in its three syntaxes and with the names of several
// programs; and the same cameras in the files of several programs.
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "calibration_support.hpp"

namespace mtstereo::test::calibration_opencv_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

cv::Mat matrix(const Matrix3& values) {
  return cv::Mat(3, 3, CV_64F, const_cast<double*>(values.data())).clone();
}
cv::Mat camera_matrix(const CameraCalibration& c) {
  return (cv::Mat_<double>(3, 3) << c.focal_x, 0, c.center_x, 0, c.focal_y, c.center_y, 0, 0, 1);
}
cv::Mat row(const std::vector<double>& values) { return cv::Mat(values, true).t(); }
cv::Mat translation(const Vector3& t) { return (cv::Mat_<double>(3, 1) << t[0], t[1], t[2]); }

/// The names of the matrices in a file.
struct Names {
  const char *k1, *d1, *k2, *d2, *r, *t;
};

/// Writes the pair of the tests.
void write_pair(cv::FileStorage& file, const Names& names, double unit = 1) {
  const StereoCalibration pair = plumb_bob_pair();
  file << names.k1 << camera_matrix(pair.left) << names.d1 << row(pair.left.coefficients);
  file << names.k2 << camera_matrix(pair.right) << names.d2 << row(pair.right.coefficients);
  file << names.r << matrix(pair.rotation) << names.t
       << cv::Mat(translation(pair.translation) / unit);
}

constexpr Names kOfStereoCalib = {"M1", "D1", "M2", "D2", "R", "T"};

class FileStorage : public ::testing::TestWithParam<const char*> {};

TEST_P(FileStorage, SyntaxIsRecognizedFromTheContent) {
  const CalibrationFolder folder;
  // FileStorage takes the syntax from the name; the reader must not need it.
  const std::string written = folder.path(std::string("c") + GetParam());
  {
    cv::FileStorage file(written, cv::FileStorage::WRITE);
    file << "imageSize" << cv::Size(640, 480);
    write_pair(file, kOfStereoCalib);
    const Rectification views = *plumb_bob_pair().rectification;
    const double f = views.focal_length;
    const cv::Mat p1 = (cv::Mat_<double>(3, 4) << f, 0, views.left_center_x, 0, 0, f,
                        views.center_y, 0, 0, 0, 1, 0);
    cv::Mat p2 = p1.clone();
    p2.at<double>(0, 3) = -f * views.baseline;
    file << "R1" << matrix(views.left_rotation) << "R2" << matrix(views.right_rotation);
    file << "P1" << p1 << "P2" << p2;
  }
  const std::string path = folder.path("calibration");
  std::filesystem::rename(written, path);
  expect_near(read_valid(path), plumb_bob_pair(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Syntaxes, FileStorage, ::testing::Values(".yml", ".xml", ".json"),
                         [](const auto& info) { return std::string(info.param).substr(1); });

TEST(OpenCvNames, OfSeveralProgramsAreKnown) {
  constexpr Names kSpellings[] = {
      {"cameraMatrix1", "distCoeffs1", "cameraMatrix2", "distCoeffs2", "R", "T"},
      {"K1", "D1", "K2", "D2", "R", "T"},
      {"left_camera_matrix", "left_dist_coeffs", "right_camera_matrix", "right_dist_coeffs",
       "rotation_matrix", "translation_vector"},
      {"K_LEFT", "D_LEFT", "K_RIGHT", "D_RIGHT", "R", "T"},
      {"camera_matrix_1", "distortion_coefficients_1", "camera_matrix_2",
       "distortion_coefficients_2", "rotation", "translation"},
  };
  const CalibrationFolder folder;
  for (const Names& names : kSpellings) {
    const std::string path = folder.path("calibration.yml");
    {
      cv::FileStorage file(path, cv::FileStorage::WRITE);
      file << "image_width" << 640 << "image_height" << 480;
      // Numbers with names of matrices, as of a lens.
      file << "p1" << 0.001 << "p2" << 0.002;
      write_pair(file, names);
    }
    expect_near(read_valid(path), plumb_bob_pair(), 1e-12, false);
  }
}

TEST(OpenCvDocuments, ThatAreAppendedBelongToTheFile) {
  for (const char* name : {"c.yml", "c.xml", "c.json"}) {
    const CalibrationFolder folder;
    const std::string path = folder.path(name);
    const StereoCalibration pair = plumb_bob_pair();
    {
      cv::FileStorage file(path, cv::FileStorage::WRITE);
      file << "K1" << camera_matrix(pair.left) << "D1" << row(pair.left.coefficients);
    }
    {
      cv::FileStorage file(path, cv::FileStorage::APPEND);
      file << "K2" << camera_matrix(pair.right) << "D2" << row(pair.right.coefficients);
    }
    {
      cv::FileStorage file(path, cv::FileStorage::APPEND);
      file << "R" << matrix(pair.rotation) << "T" << cv::Mat(translation(pair.translation) / 0.001);
      file << "length_unit"
           << "mm";
    }
    expect_near(read_valid(path, 640, 480), pair, 1e-12, false);
  }
}

TEST(OpenCvUnits, OtherThanMetersAreStatedOrRefused) {
  const CalibrationFolder folder;
  const auto write = [&](const char* name, double unit, const char* word) {
    const std::string path = folder.path(name);
    cv::FileStorage file(path, cv::FileStorage::WRITE);
    if (word != nullptr) file << "length_unit" << word;
    write_pair(file, kOfStereoCalib, unit);
    return path;
  };
  EXPECT_THAT(read_refused(write("bare.yml", 0.001, nullptr), 640, 480),
              AllOf(HasSubstr("bare.yml: T states a baseline of 121.557"),
                    HasSubstr("most likely in millimeters"), HasSubstr("length_unit: mm")));
  expect_near(read_valid(write("mm.yml", 0.001, "mm"), 640, 480), plumb_bob_pair(), 1e-12, false);
  expect_near(read_valid(write("cm.yml", 0.01, "cm"), 640, 480), plumb_bob_pair(), 1e-12, false);
  EXPECT_THAT(read_refused(write("ell.yml", 1, "ell"), 640, 480),
              HasSubstr("length_unit is 'ell'; m, cm, mm, in or the positive"));
}

TEST(OpenCvLens, IsFisheyeIfTheFileStatesIt) {
  const CalibrationFolder folder;
  const std::string path = folder.path("fisheye.yml");
  const auto write = [&](const char* model) {
    cv::FileStorage file(path, cv::FileStorage::WRITE);
    if (*model != '\0') file << "distortion_model" << model;
    const cv::Mat k = (cv::Mat_<double>(3, 3) << 300, 0, 320, 0, 301, 240, 0, 0, 1);
    const cv::Mat d = (cv::Mat_<double>(4, 1) << -0.01, 0.02, -0.03, 0.004);
    file << "K1" << k << "D1" << d << "K2" << k << "D2" << d;
    file << "R" << cv::Mat(cv::Mat::eye(3, 3, CV_64F)) << "T"
         << cv::Mat((cv::Mat_<double>(3, 1) << -0.1, 0, 0));
  };
  write("fisheye");
  EXPECT_EQ(read_valid(path).left.lens, LensModel::kFisheye);
  write("");
  EXPECT_EQ(read_valid(path).left.lens, LensModel::kPlumbBob);
  write("fov");
  EXPECT_THAT(read_refused(path), HasSubstr("distortion_model is 'fov', a lens model "
                                            "that is not supported"));
}

TEST(OpenCvLens, OfStereolabsProgramForMonoCamerasIsInTheNames) {
  const CalibrationFolder folder;
  const std::string path = folder.path("zed_calibration.yml");
  {
    cv::FileStorage file(path, cv::FileStorage::WRITE);
    const cv::Mat k = (cv::Mat_<double>(3, 3) << 930, 0, 955, 0, 931, 605, 0, 0, 1);
    const cv::Mat d = (cv::Mat_<double>(4, 1) << -0.01, 0.02, -0.03, 0.004);
    file << "Size" << cv::Size(1920, 1200) << "K_LEFT" << k << "K_RIGHT" << k;
    file << "D_LEFT_FE" << d << "D_RIGHT_FE" << d;
    // R as a rotation vector, T in millimeters.
    file << "R" << cv::Mat((cv::Mat_<double>(3, 1) << 0.0035241, 0.0101827, -0.0013416));
    file << "T" << cv::Mat((cv::Mat_<double>(3, 1) << -62.5, 0.5, -0.25));
    file << "length_unit"
         << "mm";
  }
  const StereoCalibration calibration = read_valid(path);
  EXPECT_EQ(calibration.left.lens, LensModel::kFisheye);
  EXPECT_EQ(calibration.right.width, 1920);
  cv::Mat expected;
  cv::Rodrigues(cv::Vec3d(0.0035241, 0.0101827, -0.0013416), expected);
  EXPECT_LT(cv::norm(matrix(calibration.rotation), expected, cv::NORM_INF), 1e-12);
  expect_near(calibration.translation, Vector3{-0.0625, 0.0005, -0.00025}, 1e-12);
}

TEST(OpenCvLens, KeepsCoefficientsThatAreZero) {
  const CalibrationFolder folder;
  const std::string path = folder.path("zeros.yml");
  {
    cv::FileStorage file(path, cv::FileStorage::WRITE);
    const cv::Mat k = (cv::Mat_<double>(3, 3) << 300, 0, 320, 0, 301, 240, 0, 0, 1);
    file << "M1" << k << "D1" << cv::Mat(cv::Mat::zeros(1, 8, CV_64F)) << "M2" << k << "D2"
         << cv::Mat();
    file << "R" << cv::Mat(cv::Mat::eye(3, 3, CV_32F)) << "T"
         << cv::Mat((cv::Mat_<float>(1, 3) << -0.5, 0, 0));
  }
  const StereoCalibration calibration = read_valid(path);
  EXPECT_EQ(calibration.left.lens, LensModel::kPlumbBob);
  EXPECT_EQ(calibration.left.coefficients, std::vector<double>(8));
  EXPECT_EQ(calibration.right.lens, LensModel::kNone);
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    std::array<char, 40> number{};
    std::snprintf(number.data(), number.size(), "%.17g", value);
    text += (text.empty() ? "[" : ", ") + std::string(number.data());
  }
  return text + "]";
}

/// A 4x4 matrix as a list of lists or of numbers.
std::string motion_text(const Matrix3& r, const Vector3& t, bool nested) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string line = list({r[3 * i], r[3 * i + 1], r[3 * i + 2], t[i]});
    text += (nested ? line : line.substr(1, line.size() - 2)) + ", ";
  }
  return "[" + text + (nested ? "[0, 0, 0, 1]]" : "0, 0, 0, 1]");
}

TEST(SameCameras, GiveTheSameCalibrationInEveryFormat) {
  const StereoCalibration pair = plumb_bob_pair();
  // Kalibr has four coefficients.
  StereoCalibration four = pair;
  four.left.coefficients.resize(4);
  four.right.coefficients.resize(4);
  const CalibrationFolder folder;
  const auto camera_text = [&](const CameraCalibration& c, const char* model, const char* name) {
    return "camera_model: pinhole, distortion_model: " + std::string(model) + ", " + name + ": " +
           list(c.coefficients) + ", resolution: [640, 480], intrinsics: " +
           list({c.focal_x, c.focal_y, c.center_x, c.center_y});
  };
  const std::string kalibr = folder.write(
      "kalibr", "cam0: {" + camera_text(four.left, "radtan", "distortion_coeffs") + "}\ncam1: {" +
                    camera_text(four.right, "radtan", "distortion_coeffs") +
                    ", T_cn_cnm1: " + motion_text(pair.rotation, pair.translation, true) + "}\n");
  expect_near(read_valid(kalibr), four, 1e-12, false);

  // EuRoC: the body is the right camera.
  const auto euroc = [&](const char* name, const CameraCalibration& c, const std::string& pose) {
    return folder.write(name,
                        "# A text that begins with a brace is JSON.\n{sensor_type: camera, T_BS: "
                        "{rows: 4, cols: 4, data: " +
                            pose + "}, " +
                            camera_text(c, "radial-tangential", "distortion_coefficients") + "}\n");
  };
  const std::string left =
      euroc("left", pair.left, motion_text(pair.rotation, pair.translation, false));
  const std::string right =
      euroc("right", pair.right, motion_text({1, 0, 0, 0, 1, 0, 0, 0, 1}, {}, false));
  expect_near(read_valid(left + "," + right), pair, 1e-12, false);

  // KITTI's gray cameras: camera 00 is the left one.
  const auto plain = [](const std::vector<double>& values) {
    std::string text = list(values);
    for (char& c : text) c = c == '[' || c == ']' || c == ',' ? ' ' : c;
    return text + "\n";
  };
  const Rectification& views = *pair.rectification;
  std::string kitti;
  const auto kitti_camera = [&](int i, const CameraCalibration& c, const Matrix3& r,
                                const Vector3& t, const Matrix3& view, double offset) {
    const std::string n = "_0" + std::to_string(i) + ":";
    const double f = views.focal_length;
    kitti += "S" + n + " 640 480\nK" + n +
             plain({c.focal_x, 0, c.center_x, 0, c.focal_y, c.center_y, 0, 0, 1});
    kitti += "D" + n + plain(c.coefficients) + "R" + n + plain({r.begin(), r.end()}) + "T" + n +
             plain({t[0], t[1], t[2]}) + "S_rect" + n + " 640 480\nR_rect" + n +
             plain({view.begin(), view.end()}) + "P_rect" + n +
             plain({f, 0, views.left_center_x, offset, 0, f, views.center_y, 0, 0, 0, 1, 0});
  };
  kitti_camera(0, pair.left, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {}, views.left_rotation, 0);
  kitti_camera(1, pair.right, pair.rotation, pair.translation, views.right_rotation,
               -views.focal_length * views.baseline);
  expect_near(read_valid(folder.write("kitti", kitti)), pair, 1e-12);

  // DepthAI: centimeters, lists of lists.
  const auto rows = [](const std::vector<double>& m) {
    return "[" + list({m[0], m[1], m[2]}) + "," + list({m[3], m[4], m[5]}) + "," +
           list({m[6], m[7], m[8]}) + "]";
  };
  const auto board_camera = [&](int socket, const CameraCalibration& c, int to) {
    const Vector3& t = pair.translation;
    const auto xyz = [&](double unit) {
      const std::string v = list({t[0] / unit, t[1] / unit, t[2] / unit});
      return "{\"x\":" + v.substr(1, v.find(',') - 1) +
             ",\"y\":" + v.substr(v.find(',') + 1, v.rfind(',') - v.find(',') - 1) +
             ",\"z\":" + v.substr(v.rfind(',') + 1, v.size() - v.rfind(',') - 2) + "}";
    };
    return "[" + std::to_string(socket) +
           ",{\"width\":640,\"height\":480,\"cameraType\":0,\"distortionCoeff\":" +
           list(c.coefficients) + ",\"intrinsicMatrix\":" +
           rows({c.focal_x, 0, c.center_x, 0, c.focal_y, c.center_y, 0, 0, 1}) +
           ",\"extrinsics\":{\"toCameraSocket\":" + std::to_string(to) +
           ",\"rotationMatrix\":" + rows({pair.rotation.begin(), pair.rotation.end()}) +
           ",\"translation\":" + xyz(0.01) + "}}]";
  };
  const std::string depthai =
      folder.write("depthai", "{\"cameraData\":[" + board_camera(1, pair.left, 2) + "," +
                                  board_camera(2, pair.right, -1) +
                                  "],\"stereoRectificationData\":{\"leftCameraSocket\":1,"
                                  "\"rightCameraSocket\":2}}");
  expect_near(read_valid(depthai), pair, 1e-9, false);
}

}  // namespace
}  // namespace mtstereo::test::calibration_opencv_test
