// SPDX-License-Identifier: LGPL-2.1-or-later
// Calibrations with the poses of cameras on a body or in a world, of OKVIS, SVO, maplab, AirSLAM,
// Anipose and calib.io, and that of stella_vslam.
#include "calibration_support.hpp"

namespace mtstereo::test::calibration_bodies_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class BodyFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text) { return folder_.write("cameras.yaml", text); }
  StereoCalibration read(const std::string& text) { return read_valid(write(text)); }
  std::string refused(const std::string& text) { return read_refused(write(text)); }
  CalibrationFolder folder_;
};

/// A pose on a body that sees the cameras turned by 90 degrees: their x is its y.
std::string pose(const char* y) {
  return std::string("[0, -1, 0, 0.5, 1, 0, 0, ") + y + ", 0, 0, 1, -0.25, 0, 0, 0, 1]";
}

std::string okvis(const std::string& lens, const std::string& coefficients) {
  std::string text = "%YAML:1.0\ncameras:\n";
  for (const char* y : {"0.02", "0.14"}) {
    text += "   - {T_SC:\n      " + pose(y) + ",\n      image_dimension: [640, 480],\n" +
            "      distortion_coefficients: " + coefficients + ",\n      distortion_type: " + lens +
            ",\n      focal_length: [310.5, 311.5],\n      principal_point: [322.25, 241.75]}\n";
  }
  return text + "imu_params:\n   a_max: 176.0\n";
}

std::string svo(const std::string& indent = "") {
  std::string text;
  for (const char* y : {"0.02", "0.14"}) {
    text += indent + "- camera:\n" + indent + "    image_height: 480\n" + indent +
            "    image_width: 640\n" + indent + "    type: pinhole\n" + indent +
            "    intrinsics: {cols: 1, rows: 4, data: [310.5, 311.5, 322.25, 241.75]}\n" + indent +
            "    distortion:\n" + indent + "      type: equidistant\n" + indent +
            "      parameters: {cols: 1, rows: 4, data: [0.01, -0.02, 0.003, -0.004]}\n" + indent +
            "  T_B_C: {cols: 4, rows: 4, data: " + pose(y) + "}\n";
  }
  return text;
}

void expect_pair(const StereoCalibration& calibration) {
  EXPECT_EQ(calibration.format, "camera list");
  EXPECT_EQ(calibration.left.width, 640);
  EXPECT_DOUBLE_EQ(calibration.right.focal_y, 311.5);
  EXPECT_DOUBLE_EQ(calibration.left.center_x, 322.25);
  expect_near(calibration.rotation, Matrix3{1, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-12);
  expect_near(calibration.translation, Vector3{-0.12, 0, 0}, 1e-12);
}

TEST_F(BodyFile, OfOkvisHasAllCameras) {
  const StereoCalibration pair = read(okvis("radialtangential", "[-0.25, 0.125, 0.001, 0.002]"));
  expect_pair(pair);
  EXPECT_EQ(pair.left.lens, LensModel::kPlumbBob);
  EXPECT_THAT(pair.right.coefficients, ElementsAre(-0.25, 0.125, 0.001, 0.002));
  EXPECT_EQ(read(okvis("equidistant", "[0.1, 0, 0, 0]")).left.lens, LensModel::kFisheye);
  const std::string path = write(okvis("equidistant", "[0.1, 0, 0, 0]"));
  EXPECT_THAT(read_valid(path + "#1-0").remarks, ElementsAre(HasSubstr("they are exchanged")));
}

TEST_F(BodyFile, OfSvoAndMaplabHasAllCameras) {
  const StereoCalibration pair = read("label: rig\ncameras:\n" + svo());
  expect_pair(pair);
  EXPECT_EQ(pair.left.lens, LensModel::kFisheye);
  EXPECT_THAT(pair.right.coefficients, ElementsAre(0.01, -0.02, 0.003, -0.004));
  expect_pair(read("sensors:\n  - sensor_type: IMU\n  - sensor_type: NCAMERA\n    cameras:\n" +
                   svo("    ")));
}

std::string spectacular_ai(const std::string& model, const std::string& coefficients) {
  std::string text = "{\"cameras\": [";
  for (const char* x : {"0.5", "0.38"}) {
    text += std::string(text.back() == '[' ? "" : ", ") +
            "{\"focalLengthX\": 310.5, \"focalLengthY\": 311.5, \"principalPointX\": 322.25, "
            "\"principalPointY\": 241.75, \"model\": \"" +
            model + "\", \"distortionCoefficients\": [" + coefficients +
            "], \"imageWidth\": 640, \"imageHeight\": 480, \"imuToCamera\": [[1, 0, 0, " + x +
            "], [0, 0, 1, 0.25], [0, -1, 0, 0.125], [0, 0, 0, 1]]}";
  }
  return text + "]}";
}

TEST_F(BodyFile, OfSpectacularAiHasPosesOfTheImu) {
  const StereoCalibration wide = read(spectacular_ai("kannala-brandt4", "0.1, 0.2, 0.3, 0.4"));
  expect_pair(wide);
  EXPECT_EQ(wide.left.lens, LensModel::kFisheye);
  const StereoCalibration brown =
      read(spectacular_ai("brown-conrady", "0.1, 0.2, 0.01, 0.02, 0, 0, 0, 0.5"));
  EXPECT_EQ(brown.right.coefficients, (std::vector<double>{0.1, 0.2, 0.01, 0.02, 0, 0, 0, 0.5}));
  EXPECT_EQ(read(spectacular_ai("pinhole", "")).left.lens, LensModel::kNone);
  EXPECT_THAT(refused(spectacular_ai("pinhole", "0.1")), HasSubstr("the lens model is \"none\""));
  EXPECT_THAT(refused(spectacular_ai("fov", "0.1")),
              HasSubstr("is 'fov', only pinhole, kannala-brandt4 and brown-conrady"));
  EXPECT_THAT(refused(replaced(spectacular_ai("pinhole", ""), "\"model\"", "\"lens\"")),
              HasSubstr("cameras[0] has no entry model"));
}

TEST_F(BodyFile, WithoutAPairIsRefused) {
  const std::string good = okvis("equidistant", "[0.1, 0, 0, 0]");
  const std::string one = good.substr(0, good.rfind("   - {T_SC"));
  EXPECT_THAT(refused(one), HasSubstr("has 1 camera, 2 are needed"));
  EXPECT_THAT(read_refused(write(good) + "#0-2"), HasSubstr("there is no camera 2; there are 2"));
  EXPECT_THAT(read_refused(write(good) + "#1-1"), HasSubstr("are both 1"));
  EXPECT_THAT(read_refused(write(good) + "," + write(good)), HasSubstr("give one file"));
  EXPECT_THAT(refused(okvis("eucm", "[0.1, 0, 0, 0]")),
              HasSubstr("cameras[0].distortion_type is 'eucm', a lens model that is not"));
  EXPECT_THAT(refused(okvis("equidistant", "[0.1, 0, 0]")), HasSubstr("has 3 coefficients"));
  EXPECT_THAT(refused(replaced(good, "principal_point", "center")),
              HasSubstr("cameras[0] has no entry principal_point"));
  EXPECT_THAT(refused("cameras:\n" + replaced(svo(), "pinhole", "omni")),
              HasSubstr("cameras[0].camera.type is 'omni', only pinhole"));
  EXPECT_THAT(refused("cameras:\n" + replaced(svo(), ", 0.14,", ", 140,")),
              HasSubstr("cameras[1].T_B_C states a baseline of"));
  EXPECT_THAT(refused("cameras: []\n"), HasSubstr("is not a calibration of a known format"));
}

constexpr const char* kStella =
    "Camera:\n  setup: stereo\n  model: perspective\n  fx: 300.5\n  fy: 300.5\n  cx: 320.25\n"
    "  cy: 240.5\n  cols: 640\n  rows: 480\n  focal_x_baseline: 36.06\n";
constexpr const char* kRectifier =
    "StereoRectifier:\n  model: fisheye\n  K_left: [310.5, 0, 322, 0, 311.5, 241, 0, 0, 1]\n"
    "  D_left: [0.01, -0.02, 0.003, -0.004]\n  R_left: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
    "  K_right: [312.5, 0, 323, 0, 313.5, 242, 0, 0, 1]\n  D_right: [0, 0.5, 0, 0.25]\n"
    "  R_right: [0.96, 0, 0.28, 0, 1, 0, -0.28, 0, 0.96]\n";

TEST_F(BodyFile, OfStellaHasTheRectifiedAndTheRawViews) {
  const StereoCalibration rectified = read(kStella);
  EXPECT_EQ(rectified.format, "stella_vslam");
  EXPECT_EQ(rectified.left.lens, LensModel::kNone);
  EXPECT_EQ(rectified.left.width, 640);
  EXPECT_DOUBLE_EQ(rectified.right.center_x, 320.25);
  EXPECT_NEAR(rectified.baseline(), 0.12, 1e-12);
  const StereoCalibration raw = read(std::string(kStella) + kRectifier);
  EXPECT_EQ(raw.left.lens, LensModel::kFisheye);
  EXPECT_DOUBLE_EQ(raw.right.focal_x, 312.5);
  EXPECT_THAT(raw.right.coefficients, ElementsAre(0, 0.5, 0, 0.25));
  EXPECT_DOUBLE_EQ(raw.rectification->focal_length, 300.5);
  // R = R2' R1 and T = R2' (-baseline, 0, 0).
  expect_near(raw.rotation, Matrix3{0.96, 0, -0.28, 0, 1, 0, 0.28, 0, 0.96}, 1e-12);
  expect_near(raw.translation, Vector3{-0.12 * 0.96, 0, -0.12 * 0.28}, 1e-12);
  // OpenVSLAM writes the names in one line.
  std::string flat = kStella;
  flat = flat.substr(flat.find('\n') + 1);
  for (std::size_t at = 0; (at = flat.find("  ", at)) != std::string::npos;) {
    flat.replace(at, 2, "Camera.");
  }
  EXPECT_NEAR(read(flat).baseline(), 0.12, 1e-12);
}

TEST_F(BodyFile, OfStellaThatIsNoPairIsRefused) {
  EXPECT_THAT(refused(replaced(kStella, "stereo", "RGBD")),
              HasSubstr("Camera.setup is 'RGBD', only stereo has both cameras"));
  EXPECT_THAT(refused(replaced(kStella, "36.06", "36060")),
              AllOf(HasSubstr("Camera.focal_x_baseline states a baseline of 120 m"),
                    HasSubstr("the baseline in meters")));
  EXPECT_THAT(refused(replaced(kStella, "  cols", "  columns")),
              HasSubstr("there is no entry Camera.cols"));
  EXPECT_THAT(refused(std::string(kStella) + replaced(kRectifier, "  D_right", "  D")),
              HasSubstr("there is no entry StereoRectifier.D_right"));
  EXPECT_THAT(refused(std::string(kStella) + replaced(kRectifier, "fisheye", "equirectangular")),
              HasSubstr("StereoRectifier.model is 'equirectangular', a lens model"));
}

/// A camera of Anipose, at this place along x in the world, which is turned by 90 degrees.
std::string table(const char* name, const char* x, const char* rest = "") {
  return std::string("[") + name + "]\nname = \"" + name +
         "\"\nsize = [ 640, 480,]\nmatrix = [ [ 310.5, 0.0, 322.25,], [ 0.0, 311.5, 241.75,], "
         "[ 0.0, 0.0, 1.0,],]\ndistortions = [ -0.25, 0.125, 0.001, 0.002,]\n"
         "rotation = [ 0.0, 0.0, 1.5707963267948966,]\ntranslation = [ " +
         x + ", 3.0, 0.5,]\n" + rest + "\n";
}

const std::string kMetadata = "[metadata]\nerror = 0.5\n";

TEST_F(BodyFile, HasATablePerCamera) {
  const std::string tables = table("cam_0", "0.02") + table("cam_1", "-0.1") + kMetadata;
  const StereoCalibration pair = read(tables);
  EXPECT_EQ(pair.format, "camera tables");
  EXPECT_EQ(pair.left.width, 640);
  EXPECT_DOUBLE_EQ(pair.right.focal_y, 311.5);
  EXPECT_EQ(pair.left.coefficients, (std::vector<double>{-0.25, 0.125, 0.001, 0.002}));
  expect_near(pair.rotation, kIdentity, 1e-12);
  expect_near(pair.translation, Vector3{-0.12, 0, 0}, 1e-12);
  const std::string more = table("back", "900") + tables;
  const std::string path = folder_.write("cameras.toml", more);
  EXPECT_NEAR(read_valid(path + "#cam_0-cam_1").baseline(), 0.12, 1e-12);
  EXPECT_THAT(read_refused(path + "#cam_0-cam_7"), HasSubstr("there is no entry cam_7"));
  const char* fisheye = "fisheye = true\n";
  EXPECT_EQ(read(table("a", "0", fisheye) + table("b", "-0.1", fisheye)).left.lens,
            LensModel::kFisheye);
}

TEST_F(BodyFile, WithALetterForANumberIsRefused) {
  EXPECT_THAT(refused("[cam_0]\nsize = [64é]\n"), HasSubstr("line 2 is not valid TOML"));
}

TEST_F(BodyFile, WithTablesInMillimetersNeedsTheUnit) {
  const std::string tables = table("cam_0", "20") + table("cam_1", "-100") + kMetadata;
  EXPECT_THAT(refused(tables), AllOf(HasSubstr("cam_1.translation states a baseline of 120 m"),
                                     HasSubstr("add the line 'length_unit = \"mm\"'")));
  EXPECT_NEAR(read("length_unit = \"mm\"\n" + tables).baseline(), 0.12, 1e-12);
}

std::string airslam(const char* lens, const char* type, const char* coefficients) {
  std::string text = std::string("%YAML:1.0\nimage_height: 480\nimage_width: 640\n") +
                     "distortion_type: " + lens + "  # of both\n";
  for (const char* name : {"cam0", "cam1"}) {
    const bool to_body = std::string(type) == "0";
    const char* x = name == std::string("cam0") ? "0" : to_body ? "0.12" : "-0.12";
    text += std::string(name) + ":\n  intrinsics: [310.5, 311.5, 322.25, 241.75]\n" +
            "  distortion_coeffs: " + coefficients + "\n  T_type: " + type +
            "\n  T:\n  - [1.0, 0.0, 0.0, " + x +
            "]\n  - [0.0, 1.0, 0.0, 0.0]\n  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n";
  }
  return text;
}

TEST_F(BodyFile, OfAirSlamHasOneSizeAndLensForBoth) {
  for (const char* type : {"0", "1"}) {
    const StereoCalibration pair = read(airslam("1", type, "[-0.25, 0.125, 0.001, 0.002, 0]"));
    EXPECT_EQ(pair.format, "AirSLAM");
    EXPECT_EQ(pair.right.height, 480);
    EXPECT_DOUBLE_EQ(pair.right.focal_y, 311.5);
    EXPECT_EQ(pair.left.lens, LensModel::kPlumbBob);
    expect_near(pair.translation, Vector3{-0.12, 0, 0}, 1e-12);
  }
  const StereoCalibration fisheye = read(airslam("2", "0", "[0.1, 0.2, 0.3, 0.4, 0]"));
  EXPECT_EQ(fisheye.left.lens, LensModel::kFisheye);
  EXPECT_EQ(fisheye.left.coefficients.size(), 4U);
  EXPECT_EQ(read(airslam("0", "0", "[0, 0, 0, 0, 0]")).left.lens, LensModel::kNone);
  EXPECT_THAT(refused(airslam("3", "0", "[0, 0, 0, 0, 0]")), HasSubstr("distortion_type"));
}

// The Calibrator of calib.io: only the first camera names the lens model.

std::string calib_io_camera(const std::string& name, double focal, double x) {
  std::string parameters = "\"f\": {\"state\": 0, \"val\": " + std::to_string(focal) + "}";
  for (const char* entry :
       {"\"ar\": {\"val\": 1.5}", "\"cx\": {\"val\": 322}", "\"cy\": {\"val\": 241}",
        "\"k1\": {\"val\": -0.25}", "\"p2\": {\"val\": 0.002}", "\"tauX\": {\"val\": 0.01}"}) {
    parameters += std::string(", ") + entry;
  }
  for (const char* zero : {"k2", "k3", "k4", "k5", "k6", "p1", "s1", "s2", "s3", "s4", "tauY"}) {
    parameters += std::string(", \"") + zero + "\": {\"val\": 0.0}";
  }
  return "{\"model\": {" + name +
         "\"ptr_wrapper\": {\"data\": {\"CameraModelCRT\": {\"CameraModelBase\": {\"imageSize\": "
         "{\"width\": 640, \"height\": 480}}}, \"parameters\": {" +
         parameters +
         "}}}}, \"transform\": {\"rotation\": {\"rx\": 0, \"ry\": 0, \"rz\": 0}, \"translation\": "
         "{\"x\": " +
         std::to_string(x) + ", \"y\": 0, \"z\": 0}}}";
}

std::string calib_io(double x) {
  return "{\"Calibration\": {\"cameras\": [" +
         calib_io_camera("\"polymorphic_name\": \"libCalib::CameraModelOpenCV\", ", 500.5, 0) +
         ", " + calib_io_camera("", 510.5, x) + "], \"targets\": []}}";
}

TEST_F(BodyFile, OfCalibIoHasTheModelOfOpenCv) {
  const StereoCalibration pair = read(calib_io(-0.12));
  EXPECT_EQ(pair.format, "calib.io");
  EXPECT_EQ(pair.right.width, 640);
  EXPECT_DOUBLE_EQ(pair.left.focal_y, 750.75);
  EXPECT_DOUBLE_EQ(pair.right.focal_x, 510.5);
  EXPECT_EQ(pair.left.coefficients,
            (std::vector<double>{-0.25, 0, 0, 0.002, 0, 0, 0, 0, 0, 0, 0, 0, 0.01, 0}));
  expect_near(pair.translation, Vector3{-0.12, 0, 0}, 1e-12);
  const std::string millimeters = replaced(calib_io(-120), "{", "{\"length_unit\": \"mm\", ");
  EXPECT_NEAR(read(millimeters).baseline(), 0.12, 1e-12);
}

TEST_F(BodyFile, OfCalibIoThatCannotBeIsRefused) {
  EXPECT_THAT(refused(calib_io(-120)),
              AllOf(HasSubstr("baseline of 120 m"), HasSubstr("add '\"length_unit\": \"mm\",'")));
  EXPECT_THAT(refused(replaced(calib_io(-0.12), "OpenCV", "OpenCVFisheye")),
              HasSubstr("'libCalib::CameraModelOpenCVFisheye', which is not supported"));
  EXPECT_THAT(refused(replaced(calib_io(-0.12), "\"tauY\"", "\"other\"")),
              HasSubstr("has no entry tauY"));
  EXPECT_THAT(refused(replaced(calib_io(-0.12), "\"transform\"", "\"other\"")),
              HasSubstr("has no entry transform"));
}

}  // namespace
}  // namespace mtstereo::test::calibration_bodies_test
