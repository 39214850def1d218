// SPDX-License-Identifier: LGPL-2.1-or-later
// Broken files: every one is refused with a message that names the file, the entry, the value and
// what to do, and nothing is printed.
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

#include "calibration_support.hpp"
#include "geometry/formats/document.hpp"

namespace mtstereo::test::calibration_errors_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class BrokenFile : public ::testing::Test {
 protected:
  /// The message for a file with this content.
  std::string refused(const std::string& text, int width = 640, int height = 480) {
    const std::string message = read_refused(folder_.write("broken", text), width, height);
    EXPECT_THAT(message, HasSubstr(folder_.path("broken")));
    EXPECT_LT(message.size(), 600U);
    return message;
  }
  /// The message for a stored file with one change.
  std::string changed(const std::string& name, const std::string& from, const std::string& to,
                      int width = 640, int height = 480) {
    return refused(replaced(stored_text(name), from, to), width, height);
  }
  /// The same for the pair of OpenCV in one file.
  std::string opencv(const std::string& from, const std::string& to) {
    const std::string both = stored_text("intrinsics.yml") +
                             replaced(stored_text("extrinsics.yml"), "%YAML:1.0\n---", "");
    return refused(replaced(both, from, to));
  }
  /// The same for the right file of a pair.
  std::string right(const std::string& left_name, const std::string& right_name,
                    const std::string& from, const std::string& to) {
    const std::string path = folder_.write("right", replaced(stored_text(right_name), from, to));
    return read_refused(stored(left_name) + "," + path);
  }

  CalibrationFolder folder_;
};

TEST_F(BrokenFile, ThatIsNotThere) {
  EXPECT_THAT(read_refused(folder_.path("none.yml")),
              HasSubstr("none.yml: cannot be read: No such file or directory"));
  EXPECT_THAT(read_refused(""), HasSubstr("name of the calibration file is empty"));
  EXPECT_THAT(read_refused(stored("intrinsics.yml") + ",none.yml"), StartsWith("none.yml: cannot"));
}

TEST_F(BrokenFile, ThatIsNoFile) {
  EXPECT_THAT(read_refused(folder_.path("")), HasSubstr("is a folder, a file is needed"));
  EXPECT_THAT(read_refused("/dev/zero"), HasSubstr("is not a regular file"));
  const std::string pipe = folder_.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(read_refused(pipe), HasSubstr("is not a regular file"));
}

TEST_F(BrokenFile, WithoutPermission) {
  const std::string path = folder_.write("secret.yml", stored_text("camchain.yaml"));
  ASSERT_EQ(chmod(path.c_str(), 0), 0);
  // Root may read every file, so it becomes another user for the call.
  constexpr uid_t kNobody = 65534;
  const bool root = geteuid() == 0;
  if (root) {
    ASSERT_EQ(seteuid(kNobody), 0);
  }
  const std::string message = read_refused(path);
  if (root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  EXPECT_THAT(message, HasSubstr("secret.yml: cannot be read: Permission denied"));
}

TEST_F(BrokenFile, ThatIsEmptyBinaryOrCompressed) {
  EXPECT_THAT(refused(""), HasSubstr("the file is empty"));
  EXPECT_THAT(refused(" \n\t\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(refused(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)), HasSubstr("binary"));
  EXPECT_THAT(refused(stored_text("camchain.yaml") + '\0'), HasSubstr("is a binary file"));
  EXPECT_THAT(refused(std::string("\xff\xfe"
                                  "M\0001\0:\0",
                                  8)),
              HasSubstr("is a text in UTF-16"));
  EXPECT_THAT(refused("\x1f\x8b\x08\x01"), HasSubstr("unpack it (tar xzf, or gunzip)"));
  EXPECT_THAT(refused(std::string(257, '\0') + "ustar  "), HasSubstr("unpack it (tar xf)"));
}

TEST_F(BrokenFile, OfAnotherKindIsNamed) {
  const char* remedy = "write its matrices to a YAML file";
  EXPECT_THAT(refused(std::string("PK\x03\x04\x14\0\0\0", 8)), HasSubstr("unpack it (unzip)"));
  EXPECT_THAT(refused("% Stereo calibration parameters:\nom = [ 0.01 ; 0.02 ; 0.03 ];\n"),
              AllOf(HasSubstr("is a MATLAB script; "), HasSubstr(remedy)));
  EXPECT_THAT(refused("{\"CameraParameters1\": {\"K\": [[500, 0, 321], [0, 501, 243], [0, 0, 1]], "
                      "\"RadialDistortion\": [0.1, 0]}, \"RotationOfCamera2\": [1]}"),
              AllOf(HasSubstr("is of MATLAB's stereoParameters"),
                    HasSubstr("what stereoParametersToOpenCV states")));
  EXPECT_THAT(
      refused("stereoParams = \n\n  stereoParameters with properties:\n\n    PoseCamera2: [1x1]\n"),
      HasSubstr("is of MATLAB's stereoParameters"));
  EXPECT_THAT(refused("[StereoLeft]\nfc_x=785.4\nfc_y=785.2\n"),
              AllOf(HasSubstr("if it is no ZED file, "), HasSubstr(remedy)));
  EXPECT_THAT(refused("Calibration results\n====\nCamera-system parameters:\n\tcam0 (/left):\n"),
              HasSubstr("is a report of Kalibr; give its camchain"));
  EXPECT_THAT(refused("version https://git-lfs.github.com/spec/v1\noid sha256:12\nsize 345\n"),
              HasSubstr("is a pointer of Git LFS without the calibration; get it (git lfs pull)"));
  EXPECT_THAT(refused("\n<!DOCTYPE html>\n<html><body>M1: 404</body></html>\n"),
              HasSubstr("is a web page; download the file itself"));
  EXPECT_THAT(
      refused(" Intrinsic of \"Infrared 1\" / 848x480 / {Y8}\n  Width:      848\n  PPX: 424\n"),
      HasSubstr("is a list of rs-enumerate-devices; "));
  EXPECT_THAT(
      refused("Device info: \n  Name : Intel RealSense D435\n Intrinsic of \"Infrared 1\"\n"),
      HasSubstr("to a YAML file: fx, fy, cx (PPX), cy (PPY) of Infrared 1, and baseline"));
  EXPECT_THAT(refused("{\"parameters\": {\"aux-param-disparityshift\": \"0\"}}"),
              HasSubstr("has settings of a RealSense camera, not its calibration"));
  EXPECT_THAT(refused("calib_time: 15-Mar-2012 11:37:16\nR: 1 0 0 0 1 0 0 0 1\nT: 0.1 0 0\n"),
              HasSubstr("states no cameras (S_02, K_02 and others): KITTI has them in"));
  EXPECT_THAT(refused("S_101: 881 400\nK_101: 1000 0 440 0 1000 200 0 0 1\n"),
              HasSubstr("write the projections P_rect to a file, left as P0: and right as P1:"));
}

TEST_F(BrokenFile, OfAProgramGetsTheCommandThatConvertsIt) {
  const auto conversion = [&](const std::string& text) {
    return AllOf(HasSubstr(text), HasSubstr("python3 -c \"import json,sys,"),
                 HasSubstr("> converted.json, and give converted.json"));
  };
  EXPECT_THAT(refused(std::string("PK\x03\x04\x14\0\0\0mtx.npy", 15)),
              conversion("is a NumPy .npz; convert it: "));
  EXPECT_THAT(refused(std::string("\x93NUMPY\x01\0", 8)),
              conversion("is a NumPy array; convert all arrays of its folder: "));
  for (const std::string& start : {std::string("(dp0\nS'K'\n"), std::string("\x80\x02}q", 4),
                                   std::string("\x80\x05\x95\0", 4)}) {
    EXPECT_THAT(refused(start), conversion("is a Python pickle; convert its dictionary: "));
  }
  EXPECT_THAT(refused(std::string("MATLAB 5.0 MAT-file\0", 20)),
              AllOf(conversion("is a MATLAB .mat; "), HasSubstr("stereoParametersToOpenCV")));
  folder_.write("mtx.npy", "");
  EXPECT_THAT(read_refused(folder_.path("")), conversion("is a folder of NumPy arrays; "));
  EXPECT_THAT(refused(R"({"board_config": {"cameras": {"CAM_B": {"hfov": 71.86}}}})"),
              HasSubstr("describes a board of DepthAI, without its calibration"));
  EXPECT_THAT(refused("K1 = 1 : 2 : 3\n"), HasSubstr("if it is no YAML, write its matrices"));
}

TEST_F(BrokenFile, ThatIsHuge) {
  const std::string path = folder_.write("huge", "");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40);
  EXPECT_THAT(read_refused(path), HasSubstr("more than any calibration"));
  EXPECT_THAT(refused(std::string(formats::kLargestCalibrationFile - 1, '#')),
              HasSubstr("known format"));
}

TEST_F(BrokenFile, OfAnUnknownFormat) {
  EXPECT_THAT(
      refused("fx: 500\nfy: 500\n"),
      HasSubstr("is not a calibration of a known format: it has fx, fy. docs/calibration.md"));
  EXPECT_THAT(refused("Dear reader,\nthis is a letter.\n"),
              HasSubstr("known format: it has no entries with names. "));
  std::string many;
  for (int i = 0; i < 300; ++i) many += "entry" + std::to_string(i) + ": 1\n";
  const std::string message = refused(many);
  EXPECT_THAT(message, HasSubstr("entry4, entry5 and 294 more"));
  EXPECT_LT(message.size(), 400u);
  EXPECT_THAT(refused("{\"fx\": 500}"), HasSubstr("known format"));
  EXPECT_THAT(refused("<page><body>404</body></page>"), HasSubstr("<page>, <opencv_storage>"));
  EXPECT_THAT(refused("<?xml version=\"1.0\"?>\n<opencv_storage></opencv_storage>"),
              HasSubstr("known format"));
}

TEST_F(BrokenFile, WithWrongSyntaxNamesTheLine) {
  EXPECT_THAT(refused("%YAML:1.0\n---\nM1: [1, 2\nD1: 3\n"), HasSubstr("is not valid YAML"));
  EXPECT_THAT(refused("M1: 1\nD1: 2: 3\n"), HasSubstr("line 2 is not valid YAML"));
  EXPECT_THAT(refused("{\n\"M1\": [1,\n}"), HasSubstr("line 3 is not valid JSON"));
  EXPECT_THAT(refused("<opencv_storage>\n<M1>1</M2>\n</opencv_storage>"),
              HasSubstr("line 2: </M1> is needed"));
  EXPECT_THAT(refused("<opencv_storage><M1>&huge;</M1></opencv_storage>"), HasSubstr("&huge;"));
  EXPECT_THAT(refused("cam0=[1 0 0; 0 1 0; 0 0 1]\nhello\n"), HasSubstr("line 2 is 'hello'"));
  EXPECT_THAT(refused("[LEFT_CAM_HD]\nfx\n"), HasSubstr("line 2 is 'fx', NAME= VALUE"));
}

TEST_F(BrokenFile, TruncatedAtAnyByteIsAnError) {
  // What follows after the last needed entry may be missing.
  const std::pair<const char*, std::size_t> files[] = {
      {"intrinsics.yml", 100},      {"camchain.yaml", 95}, {"depthai.json", 99},
      {"middlebury_calib.txt", 45}, {"SN12345.conf", 80},  {"calib_cam_to_cam.txt", 45},
      {"kitti_calib.txt", 45},
  };
  for (const auto& [name, percent] : files) {
    const std::string text = stored_text(name);
    const std::size_t needed = text.size() * percent / 100;
    for (std::size_t size = 1; size < needed; size += 1 + text.size() / 60) {
      const std::string path = folder_.write("broken", text.substr(0, size));
      EXPECT_FALSE(read_calibration(path, 1280, 720).ok()) << name << " up to byte " << size;
    }
  }
}

TEST_F(BrokenFile, WithNestedListsOrAliasesWithoutEnd) {
  const std::string deep(100000, '[');
  EXPECT_THAT(refused("M1: " + deep), HasSubstr("nested"));
  EXPECT_THAT(refused("{\"M1\": " + deep), HasSubstr("nested more than 50 times"));
  std::string xml = "<opencv_storage>";
  for (int i = 0; i < 100000; ++i) xml += "<a>";
  EXPECT_THAT(refused(xml), HasSubstr("nested too deep"));
  std::string bomb = "a0: &a0 [0, 0, 0, 0, 0, 0, 0, 0, 0]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before;
    for (int k = 0; k < 8; ++k) bomb += ", " + before;
    bomb += "]\n";
  }
  EXPECT_THAT(refused(bomb), HasSubstr("more than 200000 values"));
  EXPECT_THAT(refused("M1: &a [1, *a]\n"), HasSubstr("refers to the list or map that it is in"));
  std::string texts = "a: &a \"" + std::string(1 << 20, 'x') + "\"\nM1: [*a";
  for (int i = 0; i < 10000; ++i) texts += ", *a";
  EXPECT_THAT(refused(texts + "]\n"), HasSubstr("more than 200000 values"));
}

TEST_F(BrokenFile, WithMissingEntries) {
  EXPECT_THAT(read_refused(stored("intrinsics.yml")),
              AllOf(HasSubstr("there is no entry R (rotation between the cameras)"),
                    HasSubstr("give both, separated by a comma")));
  const std::string k = "[ 500., 0., 320., 0., 500., 240., 0., 0., 1. ]";
  EXPECT_THAT(refused("M1: " + k + "\nD1: [ 0., 0., 0., 0. ]\nT: [ -0.1, 0., 0. ]\n"),
              AllOf(HasSubstr("there is no entry M2 (K of the right camera)"),
                    HasSubstr("Matrices found: M1 (9 values), D1 (4 values), T (3 values)"),
                    HasSubstr("Names needed: M1, D1, M2, D2, R, T")));
  EXPECT_THAT(opencv("D1:", "Other:"), HasSubstr("there is no entry D1"));
  EXPECT_THAT(changed("camchain.yaml", "cam1:", "cam7:"), HasSubstr("no entry cam1 (the right"));
  EXPECT_THAT(changed("camchain.yaml", "T_cn_cnm1", "T_other"),
              AllOf(HasSubstr("cam1 has no entry T_cn_cnm1"),
                    HasSubstr("cam0 and cam1 have no T_cam_imu or T_imu_cam")));
  EXPECT_THAT(changed("middlebury_calib.txt", "cam1=", "cam2="), HasSubstr("no entry cam1"));
  EXPECT_THAT(refused("width=465\nheight=370\nndisp=85\n"), HasSubstr("no entry cam0"));
  EXPECT_THAT(changed("calib_cam_to_cam.txt", "R_rect_03", "R_rekt_03"),
              HasSubstr("there is no entry R_rect_03"));
  EXPECT_THAT(changed("SN12345.conf", "[RIGHT_CAM_HD]", "[CAM]", 1280, 720),
              HasSubstr("there is no section [RIGHT_CAM_HD]"));
  EXPECT_THAT(changed("SN12345.conf", "Baseline", "Line", 1280, 720),
              HasSubstr("STEREO has no entry Baseline"));
  EXPECT_THAT(changed("depthai.json", "\"leftCameraSocket\": 1", "\"leftCameraSocket\": -1"),
              HasSubstr("names no left and right camera; add the sockets"));
  EXPECT_THAT(changed("depthai.json", "\"leftCameraSocket\": 1", "\"leftCameraSocket\": 5"),
              HasSubstr("cameraData has no socket 5, the left camera"));
  EXPECT_THAT(right("euroc_cam0.yaml", "euroc_cam1.yaml", "T_BS", "T_SB"),
              HasSubstr("known format: it has sensor_type, comment, T_SB"));
}

TEST_F(BrokenFile, WithOneCameraOnly) {
  EXPECT_THAT(read_refused(stored("camera_info_left.yaml")),
              HasSubstr("has one camera; give two files, separated by a comma: LEFT,RIGHT"));
  EXPECT_THAT(read_refused(stored("euroc_cam0.yaml")), HasSubstr("has one camera"));
  EXPECT_THAT(read_refused(stored("camchain.yaml") + "," + stored("camchain.yaml")),
              HasSubstr("has both cameras in one file"));
  EXPECT_THAT(read_refused(stored("camera_info_left.yaml") + "," + stored("euroc_cam1.yaml")),
              HasSubstr("must have the same format"));
  const std::string mono =
      "%YAML:1.0\n---\nimage_width: 640\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n"
      "   dt: d\n   data: [ 500., 0., 320., 0., 500., 240., 0., 0., 1. ]\n";
  EXPECT_THAT(read_refused(folder_.write("1.yml", mono) + "," + folder_.write("2.yml", mono)),
              HasSubstr("have one camera each"));
}

TEST_F(BrokenFile, WithABaselineThatCannotBe) {
  const std::string t = "-1.2153000000000000e-01";
  EXPECT_THAT(opencv(t, "-121.53"), AllOf(HasSubstr("T states a baseline of 121.53"),
                                          HasSubstr("most likely in millimeters")));
  EXPECT_THAT(opencv(t, "1.2153e-01"), HasSubstr("the rectification has the baseline -0.12"));
  EXPECT_THAT(changed("middlebury_calib.txt", "baseline=193.001", "baseline=0"),
              HasSubstr("baseline states a baseline of 0 m"));
  EXPECT_THAT(changed("middlebury_calib.txt", "baseline=193.001", "baseline=60000"),
              HasSubstr("baseline states a baseline of 60 m, more than 10 m"));
  EXPECT_THAT(changed("SN12345.conf", "Baseline=119.933", "Baseline=0", 1280, 720),
              HasSubstr("STEREO.Baseline states"));
  const std::string left = stored("camera_info_left.yaml");
  EXPECT_THAT(read_refused(left + "," + left), HasSubstr("calibrate both cameras together"));
  EXPECT_THAT(right("camera_info_left.yaml", "camera_info_right.yaml", "-64.455658", "-64455.6"),
              HasSubstr("more than 10 m: the length is most likely in millimeters"));
  const std::string kitti = stored_text("kitti_calib.txt");
  const std::size_t p2 = kitti.find("P2:");
  const std::size_t p3 = kitti.find("P3:");
  EXPECT_THAT(refused(kitti.substr(0, p3) + "P3:" + kitti.substr(p2 + 3, p3 - p2 - 3)),
              HasSubstr("P3 states a baseline of 0 m"));
}

TEST_F(BrokenFile, WithValuesThatCannotBe) {
  const std::string fx = "5.3607344999999998e+02";
  EXPECT_THAT(opencv(fx, ".Nan"), HasSubstr("M1.data is .Nan, which is not finite"));
  EXPECT_THAT(opencv(fx, "-.Inf"), HasSubstr("not finite"));
  EXPECT_THAT(opencv(fx, "1e999"), HasSubstr("not finite"));
  EXPECT_THAT(opencv(fx, "wide"), HasSubstr("M1.data is 'wide', a number is needed"));
  EXPECT_THAT(opencv(fx, "0."), HasSubstr("M1 is singular: fx = 0"));
  EXPECT_THAT(opencv(fx, "-536."), HasSubstr("M1 has the focal lengths -536 and"));
  EXPECT_THAT(opencv(fx, "{a: 1}"), HasSubstr("is not a list of numbers"));
  EXPECT_THAT(opencv(fx + ", 0.,", fx + ", 3.,"),
              HasSubstr("M1 has the skew 3; calibrate without skew"));
  EXPECT_THAT(opencv(", 2.5231220999999998e-01", ""), HasSubstr("has 4 values, but states 1x5"));
  EXPECT_THAT(changed("camchain.yaml", ", 0.0081526]", "]"),
              HasSubstr("cam0.distortion_coeffs has 3 coefficients, 4 are needed"));
  EXPECT_THAT(changed("camchain.yaml", "[848, 480]", "[848.5, 480]"),
              HasSubstr("cam0.resolution is 848.5x480, integers from 1"));
  EXPECT_THAT(changed("camchain.yaml", "pinhole", "eucm"),
              HasSubstr("cam0.camera_model is 'eucm', which is not supported"));
  EXPECT_THAT(changed("depthai.json", "\"cameraType\": 0", "\"cameraType\": 2"),
              HasSubstr("cameraType is 2; only 0 (perspective) and 1 (fisheye)"));
  EXPECT_THAT(right("camera_info_left.yaml", "camera_info_right.yaml", "plumb_bob", "fov"),
              HasSubstr("distortion_model is 'fov', a lens model that is not supported"));
  EXPECT_THAT(changed("calib_cam_to_cam.txt", "K_02: 9.587000e+02", "K_02:"),
              HasSubstr("K_02 has 8 values, 9 are needed"));
  EXPECT_THAT(changed("SN12345.conf", "fx=700.455", "fx=", 1280, 720),
              HasSubstr("LEFT_CAM_HD.fx is '', a number is needed"));
}

TEST_F(BrokenFile, WithAMatrixThatIsNoRotation) {
  // A determinant of -1, and rows that are not orthonormal to 1e-3.
  EXPECT_THAT(opencv("R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ ",
                     "R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ -"),
              HasSubstr("R is not a rotation"));
  EXPECT_THAT(changed("camchain.yaml", "  - [0.99", "  - [0.98"),
              HasSubstr("cam1.T_cn_cnm1 is not a rotation: its rows are not orthonormal"));
  EXPECT_THAT(right("camera_info_left.yaml", "camera_info_right.yaml", "0.999777", "-0.999777"),
              HasSubstr("rectification_matrix is not a rotation"));
  EXPECT_THAT(
      right("euroc_cam0.yaml", "euroc_cam1.yaml", "0.0, 0.0, 0.0, 1.0", "0.0, 0.1, 0.0, 1.0"),
      HasSubstr("T_BS has a last row that is not 0 0 0 1"));
}

TEST_F(BrokenFile, WithAProjectionThatIsNotRectified) {
  const char* left = "camera_info_left.yaml";
  const char* right_name = "camera_info_right.yaml";
  EXPECT_THAT(right(left, right_name, "0.000000, 530.250000", "0.000000, 531.250000"),
              HasSubstr("projection_matrix has the focal lengths 530.25 and 531.25; they must be"));
  EXPECT_THAT(right(left, right_name, "240.500000", "241.000000"),
              HasSubstr("projection_matrix has the row of the principal point 241"));
  EXPECT_THAT(opencv("P2: !!opencv-matrix\n   rows: 3\n   cols: 4\n   dt: d\n"
                     "   data: [ 5.3025000000000000e+02",
                     "P2: !!opencv-matrix\n   rows: 3\n   cols: 4\n   dt: d\n   data: [ 540."),
              HasSubstr("P2 has the focal lengths 540 and 530.25"));
  EXPECT_THAT(changed("middlebury_calib.txt", "doffs=124.343", "doffs=12"),
              HasSubstr("doffs is 12, but cam0 and cam1 state 124.343"));
}

TEST_F(BrokenFile, WithSizesThatContradict) {
  EXPECT_THAT(changed("camchain.yaml", "[848, 480]", "[212, 120]"),
              HasSubstr("(418.66517, 239.12264) outside of its image of 212x120"));
  EXPECT_THAT(read_refused(stored("SN12345.conf"), 640, 480),
              AllOf(HasSubstr("no calibration for video of 640x480"), HasSubstr("HD (1280x720)")));
  EXPECT_THAT(read_refused(stored("SN12345.conf")), HasSubstr("as in '#HD'"));
  EXPECT_THAT(opencv("M1:", "image_size: [ 640, 480 ]\nimage_size_1: [ 320, 240 ]\nM1:"),
              HasSubstr("image_size_1 has another value than image_size; remove one of them"));
  const std::string other = folder_.write(
      "other.yml", replaced(stored_text("extrinsics.yml"), "R:", "image_width: 1280\nR:"));
  const std::string one = folder_.write(
      "one.yml", replaced(stored_text("intrinsics.yml"), "M1:", "image_width: 640\nM1:"));
  EXPECT_THAT(read_refused(one + "," + other), HasSubstr("image_width has another value in"));
}

TEST_F(BrokenFile, WithDuplicatesOrNamesThatAreLists) {
  EXPECT_THAT(refused("P0: 1 0 0 0 0 1 0 0 0 0 1 0\nP0: 1 0 0 0 0 1 0 0 0 0 1 0\n"
                      "P1: 1 0 0 0 0 1 0 0 0 0 1 0\n"),
              HasSubstr("P0 appears twice"));
  EXPECT_THAT(refused("? [1, 2]\n: 3\nM1: 4\n"), HasSubstr("name of an entry is a list"));
}

TEST_F(BrokenFile, WithASelectionThatSelectsNothing) {
  EXPECT_THAT(read_refused(stored("kitti_calib.txt") + "#blue"),
              HasSubstr("'#blue' selects no cameras; '#gray' or '#color' is needed"));
  EXPECT_THAT(read_refused(stored("SN12345.conf") + "#8K"), HasSubstr("'#8K' selects no reso"));
  EXPECT_THAT(read_refused(stored("camchain.yaml") + "#cam0"), HasSubstr("write LEFT-RIGHT"));
  EXPECT_THAT(read_refused(stored("camchain.yaml") + "#cam0-cam5"), HasSubstr("no entry cam5"));
  EXPECT_THAT(read_refused(stored("camchain.yaml") + "#cam0-dog"), HasSubstr("no camera dog"));
  EXPECT_THAT(read_refused(stored("camchain.yaml") + "#cam0-cam0"), HasSubstr("are both cam0"));
  EXPECT_THAT(read_refused(stored("depthai.json") + "#1-x"), HasSubstr("'x' is no socket"));
  EXPECT_THAT(read_refused(stored("middlebury_calib.txt") + "#a"), HasSubstr("has no choices"));
  EXPECT_THAT(read_refused(stored("intrinsics.yml") + "#a"), HasSubstr("has no choices"));
}

TEST_F(BrokenFile, WithControlCharactersInValuesGivesAMessageWithoutThem) {
  const std::string message = refused("P0: \x80\xff\t7 0 0 0 0 1 0 0 0 0 1 0\nP1: 1\n");
  EXPECT_THAT(message, HasSubstr("P0 is '?"));
}

TEST(CalibrationPath, NamesOfFilesMayHaveCommasAndNumberSigns) {
  const CalibrationFolder folder;
  const std::string text = stored_text("camchain.yaml");
  EXPECT_EQ(read_valid(folder.write("a,b#c.yaml", text)).left.width, 848);
  const std::string left = folder.write("left,1.yaml", stored_text("camera_info_left.yaml"));
  const std::string right = folder.write("right,1.yaml", stored_text("camera_info_right.yaml"));
  EXPECT_EQ(read_valid(left + "," + right).left.width, 640);
}

}  // namespace
}  // namespace mtstereo::test::calibration_errors_test
