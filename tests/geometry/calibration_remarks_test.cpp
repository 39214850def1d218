// SPDX-License-Identifier: LGPL-2.1-or-later

// What read_calibration() changes or finds unusual, and says so.

#include "calibration_support.hpp"
#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo::test::calibration_remarks_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kIntrinsics = stored("intrinsics.yml");
constexpr const char* kT = "-1.2153000000000000e-01";

class Remarks : public testing::Test {
 protected:
  /// The pair of OpenCV with a change of the extrinsics; R1 to P2 are removed.
  StereoCalibration with_extrinsics(const std::string& from, const std::string& to,
                                    const std::string& line = "") const {
    std::string text = replaced(stored_text("extrinsics.yml"), from, to);
    text.resize(text.find("R1:"));
    return read_valid(kIntrinsics + "," + folder_.write("extrinsics.yml", text + line + "\n"), 640,
                      480);
  }

  CalibrationFolder folder_;
};

TEST_F(Remarks, UsualFilesHaveNone) {
  for (const std::string& path :
       {kIntrinsics + "," + stored("extrinsics.yml"), stored("camchain.yaml"),
        stored("camera_info_left.yaml") + "," + stored("camera_info_right.yaml"),
        stored("depthai.json"), stored("middlebury_calib.txt"), stored("SN12345.conf") + "#HD",
        stored("euroc_cam0.yaml") + "," + stored("euroc_cam1.yaml"), stored("kitti_calib.txt"),
        stored("calib_cam_to_cam.txt")}) {
    EXPECT_THAT(read_valid(path).remarks, ElementsAre()) << path;
  }
}

void expect_exchanged(const StereoCalibration& exchanged, const StereoCalibration& straight) {
  // Files state rounded numbers.
  expect_near(exchanged, straight, 1e-4);
  EXPECT_THAT(exchanged.remarks, ElementsAre(HasSubstr("they are exchanged")));
  const Result<Rectification> rectification = rectify(exchanged);
  ASSERT_TRUE(rectification.ok()) << rectification.error().message;
  expect_near(*rectification, *rectify(straight), 1e-3);
}

TEST_F(Remarks, FilesInTheOtherOrderAreExchanged) {
  const std::string left = stored("camera_info_left.yaml");
  const std::string right = stored("camera_info_right.yaml");
  expect_exchanged(read_valid(right + "," + left), read_valid(left + "," + right));
  const std::string cam0 = stored("euroc_cam0.yaml");
  const std::string cam1 = stored("euroc_cam1.yaml");
  expect_exchanged(read_valid(cam1 + "," + cam0), read_valid(cam0 + "," + cam1));
}

TEST_F(Remarks, AFileThatBeginsWithTheRightCameraIsExchanged) {
  StereoCalibration straight = read_valid(kIntrinsics + "," + stored("extrinsics.yml"), 640, 480);
  straight.rectification.reset();
  const auto number = [](double value) { return std::to_string(value * 1e12) + "e-12"; };
  const auto list = [&](const auto& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ", ") + number(value);
    return text;
  };
  const auto matrix = [&](const char* name, int rows, int columns, const auto& values) {
    return std::string(name) + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
           "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: [ " + list(values) +
           " ]\n";
  };
  const auto camera = [&](const char* k, const char* d, const CameraCalibration& c) {
    return matrix(k, 3, 3, Matrix3{c.focal_x, 0, c.center_x, 0, c.focal_y, c.center_y, 0, 0, 1}) +
           matrix(d, 1, static_cast<int>(c.coefficients.size()), c.coefficients);
  };
  // Of the right camera to the left one: R' and -R' T.
  const Matrix3& r = straight.rotation;
  const Vector3& t = straight.translation;
  const Matrix3 back = {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]};
  Vector3 move{};
  for (std::size_t i = 0; i < 3; ++i) move[i] = -(r[i] * t[0] + r[i + 3] * t[1] + r[i + 6] * t[2]);
  const std::string file = folder_.write(
      "both.yml", "%YAML:1.0\n---\nimage_size: [ 640, 480 ]\n" +
                      camera("M1", "D1", straight.right) + camera("M2", "D2", straight.left) +
                      matrix("R", 3, 3, back) + matrix("T", 3, 1, move));
  expect_exchanged(read_valid(file), straight);
}

TEST_F(Remarks, ANegativeBaselineOfRectifiedCamerasExchangesThem) {
  const std::string text = stored_text("middlebury_calib.txt");
  const StereoCalibration straight = read_valid(stored("middlebury_calib.txt"));
  const std::string file =
      folder_.write("calib.txt", replaced(text, "baseline=193.001", "baseline=-193.001"));
  const StereoCalibration exchanged = read_valid(file);
  EXPECT_THAT(exchanged.remarks, ElementsAre(HasSubstr("they are exchanged")));
  expect_near(exchanged.left, straight.right, 0);
  EXPECT_NEAR(exchanged.rectification->baseline, straight.baseline(), 1e-12);
  EXPECT_NEAR(exchanged.rectification->principal_offset(),
              -straight.rectification->principal_offset(), 1e-9);
}

TEST_F(Remarks, ABaselineWithoutAUnit) {
  EXPECT_THAT(with_extrinsics(kT, "-3.34").remarks,
              ElementsAre(AllOf(HasSubstr("3.34 m"), HasSubstr("unusually long"),
                                HasSubstr("length_unit: mm"), HasSubstr("square"))));
  // Above 10 m the unit is wrong for certain, but below 40 not for certain millimeters.
  const auto refused = [&](const char* t) {
    const std::string text = replaced(stored_text("extrinsics.yml"), kT, t);
    return read_refused(kIntrinsics + "," + folder_.write("extrinsics.yml", text), 640, 480);
  };
  EXPECT_THAT(refused("-14.3"),
              AllOf(HasSubstr("millimeters or squares of the board: add the entry"),
                    HasSubstr("'length_unit: 0.025'")));
  EXPECT_THAT(refused("-60.1"), HasSubstr("most likely in millimeters: add the entry"));
  EXPECT_THAT(with_extrinsics(kT, "-1.2").remarks, ElementsAre(HasSubstr("unusually long")));
  EXPECT_THAT(with_extrinsics(kT, "-0.0041").remarks,
              ElementsAre(AllOf(HasSubstr("m, which is unusually short"))));
  EXPECT_THAT(with_extrinsics(kT, kT).remarks, ElementsAre());
}

TEST_F(Remarks, ABaselineOfRosInAnotherUnit) {
  const auto right = [&](const std::string& fourth) {
    const std::string text = replaced(stored_text("camera_info_right.yaml"), "-64.455658", fourth);
    return stored("camera_info_left.yaml") + "," + folder_.write("right.yaml", text);
  };
  const StereoCalibration centimeters = read_valid(right("-3977.0"));
  EXPECT_NEAR(centimeters.baseline(), 7.5, 0.01);
  EXPECT_THAT(centimeters.remarks,
              ElementsAre(AllOf(HasSubstr("7.5 m, which is unusually long"),
                                HasSubstr("projection_matrix in the file of the right camera by "
                                          "100 if it is in centimeters"))));
  EXPECT_THAT(read_refused(right("-6445.6")),
              HasSubstr("by 1000, or by 100 if it is in centimeters"));
}

TEST_F(Remarks, ABaselineOfMiddleburyInMeters) {
  const std::string text = stored_text("middlebury_calib.txt");
  const std::string file =
      folder_.write("calib.txt", replaced(text, "baseline=193.001", "baseline=0.193"));
  EXPECT_THAT(read_valid(file).remarks,
              ElementsAre(AllOf(HasSubstr("unusually short"), HasSubstr("are in millimeters"),
                                HasSubstr("multiply baseline by 1000"))));
}

TEST_F(Remarks, ARectificationThatNoViewCanHaveIsLeftOut) {
  const std::string left = "530.25, 0, 330.125, 0, 0, 530.25, 240.5, 0, 0, 0, 1, 0 ]\n";
  const std::string right = "530.25, 0, 330.125, -64.4, 0, 530.25, 240.5, 0, 0, 0, 1, 0 ]\n";
  const auto read = [&](const std::string& extrinsics) {
    return kIntrinsics + "," + folder_.write("extrinsics.yml", extrinsics);
  };
  const std::string text = stored_text("extrinsics.yml");
  const std::string start = text.substr(0, text.find("P1:"));
  const auto negative = [](const std::string& p) {
    return replaced(replaced(p, "530.25", "-8800.5"), " 530.25", " -8800.5");
  };
  const std::string views = start + "P1: [ " + negative(left) + "P2: [ " + negative(right);
  const StereoCalibration calibration = read_valid(read(views), 640, 480);
  EXPECT_FALSE(calibration.rectification.has_value());
  EXPECT_NEAR(calibration.baseline(), plumb_bob_pair().baseline(), 1e-6);
  EXPECT_THAT(calibration.remarks,
              ElementsAre(HasSubstr("P1 has the focal length -8800.5, which no view can have")));
  const auto oblong = [](const std::string& p) { return replaced(p, " 530.25", " 531.75"); };
  const std::string pixels = start + "P1: [ " + oblong(left) + "P2: [ " + oblong(right);
  EXPECT_THAT(read_valid(read(pixels), 640, 480).remarks,
              ElementsAre(AllOf(HasSubstr("P1 has the focal lengths 530.25 and 531.75"),
                                HasSubstr("is not used, but computed"))));
  // Without R and T nothing else states the position.
  const std::string alone = "%YAML:1.0\n---\n" + views.substr(views.find("R1:"));
  EXPECT_THAT(read_refused(read(alone), 640, 480),
              HasSubstr("P1 has the focal lengths -8800.5 and -8800.5"));
}

TEST_F(Remarks, ABaselineWithAUnitIsNotQuestioned) {
  const StereoCalibration meters = with_extrinsics(kT, "-3.34", "length_unit: m");
  EXPECT_THAT(meters.remarks, ElementsAre());
  EXPECT_NEAR(meters.translation[0], -3.34, 1e-12);
  EXPECT_NEAR(with_extrinsics(kT, "-7.38", "length_unit: cm").translation[0], -0.0738, 1e-12);
  // The side of a square, in meters.
  EXPECT_NEAR(with_extrinsics(kT, "-3.34", "length_unit: 0.025").translation[0], -0.0835, 1e-12);
}

TEST_F(Remarks, SizesWithTheHeightFirst) {
  const auto pair = [&](const std::string& size) {
    return read_valid(
        kIntrinsics + "," +
        folder_.write("e.yml", stored_text("extrinsics.yml") + "image_size: " + size + "\n"));
  };
  const StereoCalibration exchanged = pair("[ 480, 640 ]");
  EXPECT_EQ(exchanged.left.width, 640);
  EXPECT_EQ(exchanged.right.height, 480);
  EXPECT_THAT(exchanged.remarks, ElementsAre(HasSubstr("read as 640x480 px")));
  // Nearly square images have no clear order.
  EXPECT_EQ(pair("[ 620, 640 ]").left.width, 620);
  EXPECT_THAT(pair("[ 640, 480 ]").remarks, ElementsAre());
}

TEST_F(Remarks, FourCoefficientsWithoutALensModel) {
  const auto cameras = [&](const std::string& d, const std::string& line) {
    const std::string k = "[ 300, 0, 320, 0, 300, 240, 0, 0, 1 ]\n";
    return read_valid(folder_.write("c.yml", "M1: " + k + "M2: " + k + "D1: " + d + "\nD2: " + d +
                                                 "\nR: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]\n" +
                                                 "T: [ -0.1, 0, 0 ]\n" + line));
  };
  const StereoCalibration open = cameras("[ -0.02, 0.01, -0.01, 0.002 ]", "");
  EXPECT_EQ(open.left.lens, LensModel::kPlumbBob);
  EXPECT_THAT(open.remarks, ElementsAre(HasSubstr("'lens_model: fisheye'")));
  for (const char* line : {"lens_model: fisheye\n", "lens_model: plumb_bob\n"}) {
    EXPECT_THAT(cameras("[ -0.02, 0.01, -0.01, 0.002 ]", line).remarks, ElementsAre());
  }
  EXPECT_THAT(cameras("[ 0, 0, 0, 0 ]", "").remarks, ElementsAre());
  EXPECT_THAT(cameras("[ -0.3, 0.1, 0, 0, 0 ]", "").remarks, ElementsAre());
}

TEST_F(Remarks, UnitsThatAreNone) {
  for (const char* unit : {"0", "-1", "squares", "1e999", "nan"}) {
    std::string text = stored_text("extrinsics.yml");
    text.resize(text.find("R1:"));
    const std::string file = folder_.write("extrinsics.yml", text + "length_unit: " + unit + "\n");
    EXPECT_THAT(read_refused(kIntrinsics + "," + file, 640, 480), HasSubstr("length_unit")) << unit;
  }
}

TEST_F(Remarks, PrincipalPointsOfAnotherSize) {
  // The files have no size: the principal points are (342, 236) and (327, 250).
  const std::string pair = kIntrinsics + "," + stored("extrinsics.yml");
  EXPECT_THAT(read_refused(pair, 320, 240),
              AllOf(HasSubstr("outside of its image of 320x240"), HasSubstr("image_size")));
  EXPECT_THAT(read_valid(pair, 640, 360).remarks, ElementsAre());
  const StereoCalibration unusual = read_valid(pair, 480, 360);
  EXPECT_THAT(unusual.remarks,
              ElementsAre(AllOf(HasSubstr("left camera, (342"), HasSubstr("480x360 px"),
                                HasSubstr("image_size"))));
  // Without a size, it is noticed when the size of the video is known.
  const StereoCalibration open = read_valid(pair);
  EXPECT_THAT(open.remarks, ElementsAre());
  EXPECT_THAT(scale_calibration(open, 480, 360)->remarks, testing::SizeIs(1));
  EXPECT_FALSE(scale_calibration(open, 320, 240).ok());
}

}  // namespace
}  // namespace mtstereo::test::calibration_remarks_test
