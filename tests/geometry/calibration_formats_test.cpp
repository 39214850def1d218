// SPDX-License-Identifier: LGPL-2.1-or-later
// One file of each program, as that program writes it: every value.
#include <cmath>

#include "calibration_support.hpp"

namespace mtstereo::test::calibration_formats_test {
namespace {

using ::testing::HasSubstr;

std::string opencv_pair() { return stored("intrinsics.yml") + "," + stored("extrinsics.yml"); }

TEST(OpenCvFiles, OfStereoCalibAreReadAsAPair) {
  const StereoCalibration calibration = read_valid(opencv_pair(), 640, 480);
  expect_near(calibration, plumb_bob_pair(), 1e-8);
  EXPECT_EQ(calibration.format, "OpenCV");
  EXPECT_NEAR(calibration.baseline(), 0.121557112, 1e-9);
}

TEST(OpenCvFiles, AreReadInAnyOrderAndInOneFile) {
  const std::string swapped = stored("extrinsics.yml") + "," + stored("intrinsics.yml");
  expect_near(read_valid(swapped, 640, 480), plumb_bob_pair(), 1e-8);
  const CalibrationFolder folder;
  const std::string both =
      stored_text("intrinsics.yml") + replaced(stored_text("extrinsics.yml"), "%YAML:1.0\n---", "");
  expect_near(read_valid(folder.write("both.yml", both), 640, 480), plumb_bob_pair(), 1e-8);
}

TEST(OpenCvFiles, WithoutASizeLeaveItOpen) {
  const StereoCalibration calibration = read_valid(opencv_pair());
  EXPECT_EQ(calibration.left.width, 0);
  EXPECT_EQ(calibration.right.height, 0);
  EXPECT_EQ(calibration.rectification->width, 0);
}

TEST(CameraInfo, OfBothCamerasIsAPair) {
  const StereoCalibration calibration =
      read_valid(stored("camera_info_left.yaml") + "," + stored("camera_info_right.yaml"));
  // Six decimals are in the files, and R and T are made from them.
  expect_near(calibration, plumb_bob_pair(), 3e-6);
  EXPECT_EQ(calibration.format, "ROS camera_info");
}

TEST(CameraInfo, IsAlsoReadAsTheMessageOfATopic) {
  const CalibrationFolder folder;
  const auto message = [&](const char* name, const char* right_column) {
    return folder.write(
        name, std::string("header:\n  stamp: {sec: 1, nanosec: 2}\n  frame_id: camera\n"
                          "height: 400\nwidth: 640\ndistortion_model: rational_polynomial\n"
                          "d: [1.5, -0.25, 0.001, 0.002, 0.5, 1.25, -0.125, 0.0625]\n"
                          "k: [420.5, 0, 321, 0, 421.5, 201, 0, 0, 1]\n"
                          "r: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
                          "p: [410, 0, 322, ") +
                  right_column +
                  ", 0, 410, 202, 0, 0, 0, 1, 0]\nbinning_x: 0\nbinning_y: 0\nroi: {x_offset: "
                  "0}\n---\n");
  };
  const StereoCalibration calibration =
      read_valid(message("left", "0.0") + "," + message("right", "-20.5"));
  EXPECT_EQ(calibration.left.lens, LensModel::kPlumbBob);
  EXPECT_EQ(calibration.left.coefficients,
            (std::vector<double>{1.5, -0.25, 0.001, 0.002, 0.5, 1.25, -0.125, 0.0625}));
  EXPECT_NEAR(calibration.baseline(), 0.05, 1e-12);
  EXPECT_EQ(calibration.rectification->left_center_x, 322);
}

TEST(CameraInfo, MayNameItsLensModelOtherwiseOrNot) {
  const CalibrationFolder folder;
  const auto pair = [&](const std::string& from, const std::string& to) {
    std::string paths;
    for (const char* name : {"camera_info_left.yaml", "camera_info_right.yaml"}) {
      paths += (paths.empty() ? "" : ",") +
               folder.write(
                   name, replaced(stored_text(name), "distortion_model: plumb_bob\n" + from, to));
    }
    return paths;
  };
  expect_near(read_valid(pair("", "camera_model: plumb_bob\n")), plumb_bob_pair(), 3e-6);
  expect_near(read_valid(pair("", "")), plumb_bob_pair(), 3e-6);
  // Four coefficients may be those of a fisheye lens.
  const std::string four = "distortion_coefficients: [0.1, 0.2, 0.01, 0.02]\nunused:\n";
  EXPECT_THAT(read_refused(pair("distortion_coefficients:\n", four)),
              HasSubstr("there is no entry distortion_model (plumb_bob"));
}

TEST(CameraInfo, OfCamerasCalibratedAloneIsNoPair) {
  const CalibrationFolder folder;
  const std::string left = stored_text("camera_info_left.yaml");
  const auto write = [&](const char* name, const std::string& columns) {
    std::string text = left.substr(0, left.find("projection_matrix"));
    return folder.write(name, text + "projection_matrix: [" + columns + "]\n");
  };
  // Each projection is that of the camera alone, with focal lengths of its own.
  EXPECT_THAT(read_refused(write("l", "500, 0, 320, 0, 0, 510, 240, 0, 0, 0, 1, 0") + "," +
                           write("r", "520, 0, 322, 0, 0, 530, 250, 0, 0, 0, 1, 0")),
              HasSubstr("a baseline of 0: its fourth value equals that in"));
  const std::string none =
      folder.write("none", left.substr(0, left.find("projection_matrix")) + "\n");
  EXPECT_THAT(read_refused(none + "," + none),
              HasSubstr("no entry projection_matrix, which states the position of the cameras; "
                        "calibrate both cameras together"));
}

TEST(CameraInfo, HasBothCamerasInOneFile) {
  const CalibrationFolder folder;
  const auto indented = [](const char* name) {
    std::string text = "  " + stored_text(name);
    for (std::size_t at = 0; (at = text.find('\n', at)) + 1 < text.size(); at += 3) {
      text.insert(at + 1, "  ");
    }
    return text + "\n";
  };
  const std::string left = stored_text("camera_info_left.yaml") + "\n";
  const std::string right = stored_text("camera_info_right.yaml") + "\n";
  const std::string maps =
      "a:\n" + indented("camera_info_left.yaml") + "b:\n" + indented("camera_info_right.yaml");
  for (const std::string& text : {maps, left + "---\n" + right, left + "---\n" + right + "---\n"}) {
    expect_near(read_valid(folder.write("both.yaml", text)), plumb_bob_pair(), 3e-6);
  }
  // Messages of one camera, the last one cut off.
  for (const std::string& more : {left, left.substr(0, 60) + "\n a: [", std::string()}) {
    const std::string path = folder.write("left.yaml", left + "---\n" + more);
    EXPECT_THAT(read_refused(path), HasSubstr("which has one camera"));
    expect_near(read_valid(path + "," + folder.write("right.yaml", right)), plumb_bob_pair(), 3e-6);
  }
}

TEST(CameraInfo, KnowsFisheyeLenses) {
  const CalibrationFolder folder;
  const auto fisheye = [&](const std::string& name) {
    std::string text = replaced(stored_text(name), "plumb_bob", "equidistant");
    text = replaced(text, "cols: 5", "cols: 4");
    const std::size_t data = text.find("data: [", text.find("distortion_coefficients"));
    text.replace(data, text.find(']', data) - data, "data: [-0.01, 0.02, -0.03, 0.004");
    return folder.write(name, text);
  };
  const StereoCalibration calibration =
      read_valid(fisheye("camera_info_left.yaml") + "," + fisheye("camera_info_right.yaml"));
  EXPECT_EQ(calibration.left.lens, LensModel::kFisheye);
  EXPECT_EQ(calibration.right.coefficients, (std::vector<double>{-0.01, 0.02, -0.03, 0.004}));
}

TEST(Kalibr, ChainMovesPointsFromTheCameraBefore) {
  const StereoCalibration calibration = read_valid(stored("camchain.yaml"));
  StereoCalibration expected;
  expected.left = {
      848,       480,       304.82145,           304.71032,
      418.66517, 239.12264, LensModel::kFisheye, {-0.012563, 0.019874, -0.021035, 0.0081526}};
  expected.right = {
      848,       480,       305.10267,           305.01853,
      421.30941, 241.87726, LensModel::kFisheye, {-0.011207, 0.017431, -0.018904, 0.0072817}};
  expected.rotation = {0.999911711, -0.006315017, 0.011691453,  0.006284598, 0.999976775,
                       0.002636775, -0.011707832, -0.002563066, 0.999928176};
  expected.translation = {-0.100987, -0.000912, 0.001274};
  expect_near(calibration, expected, 1e-8);
  EXPECT_EQ(calibration.format, "Kalibr camchain");
}

TEST(Kalibr, SelectionSwapsTheCameras) {
  // The same chain, with the topics in the order right, left.
  const CalibrationFolder folder;
  std::string text = stored_text("camchain.yaml");
  const StereoCalibration forward = read_valid(stored("camchain.yaml"));
  const auto line = [](double a, double b, double c, double d) {
    return "  - [" + std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c) +
           ", " + std::to_string(d) + "]\n";
  };
  const std::size_t begin = text.find("  - [");
  text.replace(begin, text.find("  - [0.0, 0.0") - begin,
               line(1, 0, 0, 0.1) + line(0, 1, 0, 0.002) + line(0, 0, 1, 0.003));
  const std::string file = folder.write("camchain.yaml", text);
  const StereoCalibration exchanged = read_valid(file);
  EXPECT_EQ(exchanged.remarks.size(), 1U);
  const StereoCalibration swapped = read_valid(file + "#cam1-cam0");
  EXPECT_TRUE(swapped.remarks.empty());
  expect_near(exchanged, swapped, 1e-12);
  expect_near(swapped.left, forward.right, 0);
  expect_near(swapped.right, forward.left, 0);
  expect_near(swapped.translation, Vector3{-0.1, -0.002, -0.003}, 1e-12);
}

TEST(Kalibr, CamerasThatAreNotNeighborsAreConnectedByTheChain) {
  const CalibrationFolder folder;
  std::string text = stored_text("camchain.yaml");
  std::string third = text.substr(text.find("cam1:"));
  text += replaced(third, "cam1:", "cam2:");
  const StereoCalibration pair = read_valid(stored("camchain.yaml"));
  const StereoCalibration outer = read_valid(folder.write("c.yaml", text) + "#cam0-cam2");
  // Twice the same motion.
  const Matrix3& r = pair.rotation;
  const Vector3& t = pair.translation;
  Vector3 expected = t;
  for (std::size_t i = 0; i < 3; ++i) {
    expected[i] += r[3 * i] * t[0] + r[3 * i + 1] * t[1] + r[3 * i + 2] * t[2];
  }
  expect_near(outer.translation, expected, 1e-12);
}

TEST(Euroc, PositionsOnTheBodyBecomeRAndT) {
  const StereoCalibration calibration =
      read_valid(stored("euroc_cam0.yaml") + "," + stored("euroc_cam1.yaml"));
  StereoCalibration expected;
  expected.left = {752,
                   480,
                   457.654,
                   456.297,
                   368.215,
                   247.375,
                   LensModel::kPlumbBob,
                   {-0.28140811, 0.07195907, 0.00021359, 1.77187114e-05}};
  expected.right = {752,
                    480,
                    456.587,
                    455.134,
                    378.999,
                    254.238,
                    LensModel::kPlumbBob,
                    {-0.28168365, 0.07251284, -0.00011473, -3.65590700e-05}};
  expected.rotation = {0.9999972750,  -0.0022971017, 0.0004162011, 0.0023027417, 0.9998979517,
                       -0.0140990600, -0.0003837717, 0.0140999800, 0.9999005167};
  expected.translation = {-0.110074, 0.000399, -0.000853};
  expect_near(calibration, expected, 1e-9);
  EXPECT_EQ(calibration.format, "EuRoC sensor.yaml");
}

TEST(KittiRaw, ColorCamerasAreTheDefault) {
  const StereoCalibration calibration = read_valid(stored("calib_cam_to_cam.txt"));
  StereoCalibration expected;
  expected.left = {1392,
                   512,
                   958.7,
                   957.1,
                   696.2,
                   224.3,
                   LensModel::kPlumbBob,
                   {-0.3691, 0.1968, 0.0014, 0.0007, -0.0677}};
  expected.right = {1392,
                    512,
                    902.6,
                    901.4,
                    695.9,
                    225.8,
                    LensModel::kPlumbBob,
                    {-0.3639, 0.1789, -0.0005, -0.0003, -0.0529}};
  expected.rotation = {0.999715912,  -0.010628212, -0.021333930, 0.010369287, 0.999871678,
                       -0.012210902, 0.021460972,  0.011986216,  0.999697833};
  expected.translation = {-0.5328, -0.0021, 0.0047};
  expect_near(calibration, expected, 2e-6, false);
  EXPECT_EQ(calibration.format, "KITTI calib_cam_to_cam");
  EXPECT_EQ(calibration.date, "2019-03-14T09:12:45");
  ASSERT_TRUE(calibration.rectification.has_value());
  const Rectification& views = *calibration.rectification;
  EXPECT_EQ(views.width, 1242);
  EXPECT_EQ(views.height, 375);
  EXPECT_DOUBLE_EQ(views.focal_length, 718.2);
  EXPECT_DOUBLE_EQ(views.left_center_x, 607.19);
  EXPECT_DOUBLE_EQ(views.right_center_x, 607.19);
  EXPECT_DOUBLE_EQ(views.center_y, 185.22);
  EXPECT_NEAR(views.baseline, 0.532824868, 1e-6);
}

TEST(KittiRaw, SuffixSelectsTheGrayCameras) {
  const StereoCalibration calibration = read_valid(stored("calib_cam_to_cam.txt") + "#gray");
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 983.1);
  EXPECT_DOUBLE_EQ(calibration.right.center_y, 245.1);
  expect_near(calibration.translation, Vector3{-0.5372, 0.0048, -0.0125}, 1e-9);
  expect_near(calibration.rotation,
              Matrix3{0.999353983, 0.018566828, -0.030771559, -0.018824678, 0.999789899,
                      -0.008111080, 0.030614497, 0.008685105, 0.999493533},
              1e-6);
  EXPECT_NEAR(calibration.rectification->baseline, 0.537366849, 1e-6);
}

TEST(KittiRaw, VideoOfTheRectifiedSizeIsRectifiedAlready) {
  const StereoCalibration calibration = read_valid(stored("calib_cam_to_cam.txt"), 1242, 375);
  EXPECT_EQ(calibration.left.width, 1242);
  EXPECT_EQ(calibration.left.lens, LensModel::kNone);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 718.2);
  EXPECT_EQ(calibration.rotation, kIdentity);
  EXPECT_EQ(calibration.rectification->left_rotation, kIdentity);
  EXPECT_NEAR(calibration.baseline(), 0.532824868, 1e-6);
}

TEST(KittiOdometry, ColorCamerasAreTheDefault) {
  const StereoCalibration calibration = read_valid(stored("kitti_calib.txt"), 1241, 376);
  EXPECT_EQ(calibration.format, "KITTI odometry");
  EXPECT_EQ(calibration.left.width, 1241);
  EXPECT_EQ(calibration.right.height, 376);
  EXPECT_DOUBLE_EQ(calibration.left.focal_y, 718.856);
  EXPECT_DOUBLE_EQ(calibration.right.center_x, 607.1928);
  EXPECT_EQ(calibration.left.lens, LensModel::kNone);
  EXPECT_NEAR(calibration.baseline(), (337.2877 + 45.38225) / 718.856, 1e-12);
  EXPECT_EQ(calibration.rectification->width, 1241);
}

TEST(KittiOdometry, SuffixSelectsTheGrayCameras) {
  const StereoCalibration calibration = read_valid(stored("kitti_calib.txt") + "#gray", 1241, 376);
  EXPECT_NEAR(calibration.baseline(), 386.1448 / 718.856, 1e-12);
}

TEST(KittiOdometry, LinesWithoutNamesAreReadAndTheSizeMayBeOpen) {
  const CalibrationFolder folder;
  std::string two;
  std::string four;
  std::istringstream lines(stored_text("kitti_calib.txt"));
  for (std::string line; std::getline(lines, line);) {
    four += line.substr(4) + "\n";
    if (line[1] <= '1') two += line.substr(4) + "\n";
  }
  const StereoCalibration pair = read_valid(folder.write("two.txt", two));
  EXPECT_NEAR(pair.baseline(), 386.1448 / 718.856, 1e-12);
  EXPECT_EQ(pair.left.width, 0);
  const std::string all = folder.write("four.txt", four);
  EXPECT_NEAR(read_valid(all).baseline(), (337.2877 + 45.38225) / 718.856, 1e-12);
  EXPECT_NEAR(read_valid(all + "#gray").baseline(), 386.1448 / 718.856, 1e-12);
}

TEST(DepthAi, StereoSocketsAndCentimetersAreUnderstood) {
  const StereoCalibration calibration = read_valid(stored("depthai.json"));
  EXPECT_EQ(calibration.format, "DepthAI");
  StereoCalibration expected;
  expected.left = {1280,
                   800,
                   799.74,
                   799.383,
                   662.934,
                   402.242,
                   LensModel::kPlumbBob,
                   {7.2356, -102.4821, 0.00038, -0.00112, 314.9071, 7.1123, -101.8832, 312.7216,
                    0.0004, -0.0002, 0.0011, 0.0003, 0.0061, -0.0043}};
  expected.right = {1280,
                    800,
                    801.326,
                    801.115,
                    652.743,
                    396.871,
                    LensModel::kPlumbBob,
                    {5.8211, -84.9033, -0.00071, 0.00064, 281.3422, 5.7416, -84.2119, 279.8815,
                     -0.0003, 0.0005, -0.0006, 0.0002, -0.0027, 0.0035}};
  expected.rotation = {0.999983600,  -0.001206432, -0.005598584, 0.001193552, 0.999996635,
                       -0.002303345, 0.005601344,  0.002296625,  0.999981675};
  expected.translation = {-0.07513, 0.000214, -0.000352};
  expect_near(calibration, expected, 1e-8);
}

TEST(DepthAi, ExtrinsicsAreFollowedOverAThirdSocketAndBackwards) {
  // From the left camera (1) to the color camera (0): over socket 2.
  const StereoCalibration chained = read_valid(stored("depthai.json"));
  const Result<StereoCalibration> color = read_calibration(stored("depthai.json") + "#1-0");
  ASSERT_TRUE(color.ok()) << color.error().message;
  // R2 (R1 X + T1) + T2 with R2 = Rodrigues(-0.0011, 0.0032, 0.0004), T2 = (3.7478, ...) cm.
  EXPECT_NEAR(color->translation[0], -0.07513 + 0.037478, 2e-4);
  EXPECT_EQ(color->right.width, 3840);
  // From the color camera to the right one (2): the inverse of the extrinsics of socket 2.
  const Result<StereoCalibration> right = read_calibration(stored("depthai.json") + "#0-2");
  ASSERT_TRUE(right.ok()) << right.error().message;
  EXPECT_NEAR(right->translation[0], -0.037478, 2e-4);
  EXPECT_NEAR(right->baseline(), std::hypot(0.037478, 0.000113, 0.000279), 1e-9);
  EXPECT_GT(chained.baseline(), right->baseline());
}

TEST(DepthAi, FisheyeCamerasHaveFourCoefficients) {
  const CalibrationFolder folder;
  std::string text = stored_text("depthai.json");
  text = replaced(text, "\"cameraType\": 0", "\"cameraType\": 1");
  const StereoCalibration calibration = read_valid(folder.write("fisheye.json", text));
  // The first camera of the file is that of socket 2.
  EXPECT_EQ(calibration.right.lens, LensModel::kFisheye);
  EXPECT_EQ(calibration.right.coefficients,
            (std::vector<double>{5.8211, -84.9033, -0.00071, 0.00064}));
}

TEST(Zed, ResolutionIsThatOfTheVideo) {
  const StereoCalibration calibration = read_valid(stored("SN12345.conf"), 1280, 720);
  EXPECT_EQ(calibration.format, "ZED");
  StereoCalibration expected;
  expected.left = {1280,
                   720,
                   700.455,
                   700.455,
                   646.99,
                   368.523,
                   LensModel::kPlumbBob,
                   {-0.171409, 0.0236517, 0.000107811, -0.000230552, 0.00112}};
  expected.right = {1280,
                    720,
                    701.14,
                    701.14,
                    640.835,
                    372.438,
                    LensModel::kPlumbBob,
                    {-0.169814, 0.0224703, -8.7304e-05, 0.000151907, 0.00203}};
  // Rodrigues(RX, CV, RZ) = (0.0035241, 0.0101827, -0.0013416).
  expected.rotation = {0.999947257,  0.001359516,  0.010180136, -0.001323631, 0.999992890,
                       -0.003530861, -0.010184864, 0.003517200, 0.999941947};
  expected.translation = {-0.119933, 0.0000845, -0.0003127};
  expect_near(calibration, expected, 1e-8);
}

TEST(Zed, OtherResolutionsAreSelectedBySizeOrSuffix) {
  EXPECT_DOUBLE_EQ(read_valid(stored("SN12345.conf"), 672, 376).left.focal_x, 350.2275);
  const StereoCalibration largest = read_valid(stored("SN12345.conf") + "#2K");
  EXPECT_EQ(largest.left.width, 2208);
  EXPECT_DOUBLE_EQ(largest.left.center_x, 1106.98);
}

TEST(Zed, SectionsForTheDistortionAreThoseOfTheCalibrationProgramForMonoCameras) {
  const CalibrationFolder folder;
  std::string text;
  for (const char* side : {"LEFT", "RIGHT"}) {
    text += std::string("[") + side + "_CAM_FHD1200]\nfx = 930\nfy = 931\ncx = 955\ncy = 605\n\n";
  }
  text +=
      "[LEFT_DISTO]\nk1 = 0.5\nk2 = 0.25\np1 = 0.001\np2 = 0.002\nk3 = 0.125\nk4 = 0.75\n"
      "k5 = 0.0625\nk6 = 0.03125\n\n";
  text += "[RIGHT_DISTO]\nk1 = -0.01\nk2 = 0.02\nk3 = -0.03\nk4 = 0.004\n\n";
  text +=
      "[STEREO]\nBaseline = 62.5\nTY = 0.5\nTZ = -0.25\nCV_FHD1200 = 0\nRX_FHD1200 = 0\n"
      "RZ_FHD1200 = 0\n";
  const StereoCalibration calibration = read_valid(folder.write("SN1.conf", text), 1920, 1200);
  EXPECT_EQ(calibration.left.lens, LensModel::kPlumbBob);
  EXPECT_EQ(calibration.left.coefficients,
            (std::vector<double>{0.5, 0.25, 0.001, 0.002, 0.125, 0.75, 0.0625, 0.03125}));
  EXPECT_EQ(calibration.right.lens, LensModel::kFisheye);
  EXPECT_EQ(calibration.right.coefficients, (std::vector<double>{-0.01, 0.02, -0.03, 0.004}));
  expect_near(calibration.translation, Vector3{-0.0625, 0.0005, -0.00025}, 1e-12);
}

}  // namespace
}  // namespace mtstereo::test::calibration_formats_test
