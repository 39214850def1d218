// SPDX-License-Identifier: LGPL-2.1-or-later
// The files of OpenCV's FileStorage, with the names of its sample stereo_calib and those that
// other programs give to the same matrices, and the file of write_calibration().
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "geometry/calibration_remarks.hpp"
#include "geometry/formats/opencv_entries.hpp"
#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

constexpr const char* kOwnFormat = "mtstereo";
constexpr Names kSize =
    "imagesize imagesize1 size imgsize framesize resolution leftsize "
    "leftimagesize leftresolution res1";
constexpr Names kWidth =
    "imagewidth width leftwidth leftimagewidth imagesizewidth resolutionwidth camwidth";
constexpr Names kHeight =
    "imageheight height leftheight leftimageheight imagesizeheight resolutionheight camheight";
constexpr const char* kUnitRemedy =
    "add the entry 'length_unit: mm' (or cm, in, or the meters that the length 1 has, such as the "
    "side of a square of the board: 'length_unit: 0.025')";
constexpr Names kRightProjection = "p2 pr pright rightp";

/// How far the principal point is from the middle, as a part of the sides.
double distance_from_middle(const CameraCalibration& camera, int width, int height) {
  return std::abs(camera.center_x - (width - 1) / 2.0) / width +
         std::abs(camera.center_y - (height - 1) / 2.0) / height;
}

/// Exchanges the sides of a camera that the file states as NumPy and MATLAB do: rows first.
void put_width_first(CameraCalibration& camera, std::vector<std::string>& remarks) {
  constexpr double kClearly = 0.15;
  if (camera.width < 1 || camera.height < 1) return;
  const double stated = distance_from_middle(camera, camera.width, camera.height);
  if (stated - distance_from_middle(camera, camera.height, camera.width) < kClearly) return;
  std::swap(camera.width, camera.height);
  if (!remarks.empty()) return;
  remarks.push_back(
      "By the principal point, the file states the height of the image first: its "
      "size is read as " +
      std::to_string(camera.width) + "x" + std::to_string(camera.height) + " px.");
}

/// The size that the files state, else the caller's.
void read_sizes(const OpenCvEntries& files, const Request& request,
                StereoCalibration& calibration) {
  CameraCalibration& left = calibration.left;
  std::optional<Entry> width = files.find(kWidth);
  std::optional<Entry> height = files.find(kHeight);
  // Only without the others: of a video that is another size, or of the images.
  if (!width) width = files.find("framewidth");
  if (!height) height = files.find("frameheight");
  const std::optional<Entry> both = files.find(kSize);
  if (both) {
    set_size(left, *both);
  } else if (width && height) {
    set_size(left, *width, *height);
  } else {
    left.width = request.width;
    left.height = request.height;
  }
  calibration.right.width = left.width;
  calibration.right.height = left.height;
  if (const std::optional<Entry> other =
          files.find("imagesize2 rightsize rightimagesize rightresolution res2")) {
    set_size(calibration.right, *other);
  }
  if (!both || calibration.format == kOwnFormat) return;
  for (CameraCalibration* camera : {&calibration.left, &calibration.right}) {
    put_width_first(*camera, calibration.remarks);
  }
}

/// The lens model, if it is stated.
std::optional<LensModel> stated_lens(const OpenCvEntries& files, Names names,
                                     const Entry& coefficients) {
  if (const std::optional<Entry> model = files.find(names)) return lens_model(*model);
  const std::optional<Entry> model = files.find("lensmodel distortionmodel cameramodel model");
  if (model) return lens_model(*model);
  const std::optional<Entry> flag = files.find("fisheye fisheyemodel isfisheye usefisheye");
  if (flag) {
    const std::string word = flag->text();
    if (word == "1" || word == "true" || word == "True") return LensModel::kFisheye;
  }
  const std::string name = plain_name(coefficients.name());
  const bool fisheye = name.size() > 2 && name.substr(name.size() - 2) == "fe";
  return fisheye ? std::optional(LensModel::kFisheye) : std::nullopt;
}

/// Sets the lens of a camera; one that is not stated is a plumb bob.
void read_lens(const OpenCvEntries& files, Names names, const Entry& coefficients,
               CameraCalibration& camera, std::vector<std::string>& remarks) {
  constexpr std::size_t kOfFisheye = 4;
  const std::optional<LensModel> stated = stated_lens(files, names, coefficients);
  set_lens(camera, stated.value_or(LensModel::kPlumbBob), coefficients);
  const std::vector<double>& values = camera.coefficients;
  const bool zero = std::all_of(values.begin(), values.end(), [](double v) { return v == 0; });
  if (stated || zero || values.size() != kOfFisheye || !remarks.empty()) return;
  remarks.push_back(coefficients.name() +
                    " has 4 coefficients, and the file states no lens model: they are taken as k1, "
                    "k2, p1, p2. If they are from cv2.fisheye, add the entry 'lens_model: "
                    "fisheye'.");
}

/// The unit at the end of a name such as translation_mm [m].
std::optional<double> unit_in_name(const std::optional<Entry>& entry) {
  const std::string name = entry ? entry->name() : std::string();
  const std::string end = name.substr(std::min(name.rfind('_'), name.size()));
  if (end == "_mm") return 0.001;
  if (end == "_cm") return 0.01;
  return end == "_m" ? std::optional(1.0) : std::nullopt;
}

/// The unit of T that an entry such as baseline_mm implies, if T has that length in any unit.
std::optional<double> unit_by_baseline(const OpenCvEntries& files,
                                       const std::optional<Entry>& translation) {
  if (!translation) return std::nullopt;
  const std::vector<double> t = translation->numbers(3, "a vector");
  const double length = std::hypot(t[0], t[1], t[2]);
  for (const Names names : {"baselinemm stereobaselinemm", "baselinecm stereobaselinecm",
                            "baselinem stereobaselinem"}) {
    const std::optional<Entry> entry = files.find(names);
    const std::optional<double> unit = unit_in_name(entry);
    if (!unit || !entry->is_scalar()) continue;
    const double stated = parse_number(entry->text()).value_or(0) * *unit;
    constexpr double kTolerance = 0.01;
    for (const double of_translation : {1.0, 0.01, 0.001}) {
      const double meters = of_translation * length;
      if (std::abs(stated - meters) <= kTolerance * meters) return of_translation;
    }
  }
  return std::nullopt;
}

/// The unit of T and of the fourth columns of P1 and P2 [m], if it is stated.
std::optional<double> unit_of(const OpenCvEntries& files, const std::optional<Entry>& translation) {
  const std::optional<Entry> entry = files.find("lengthunit units unit worldunits");
  if (entry) return length_unit(*entry);
  const std::optional<double> named = unit_in_name(translation);
  return named ? named : unit_by_baseline(files, translation);
}

/// Why no rectified view can have this projection, or nothing. stereoRectify() writes negative
/// focal lengths for lens polynomials that turn back near the border of the image; other programs
/// write the pixels of the camera. The cameras themselves may be right.
std::string no_view_text(const std::vector<double>& projection) {
  if (projection[0] < 0) {
    return " has the focal length " + number_text(projection[0]) +
           ", which no view can have: the distortion may be wrong at the border of the image; "
           "calibrate with views that cover it.";
  }
  if (std::abs(projection[0] - projection[5]) <= kRelativeFocalDifference * projection[0]) {
    return {};
  }
  return " has the focal lengths " + number_text(projection[0]) + " and " +
         number_text(projection[5]) + ", which must be equal in a rectified view.";
}

/// The rectification, if all four matrices are there. One that no view can have is left out if R
/// and T are there (`motion`).
void read_rectification(const OpenCvEntries& files, double unit, bool motion,
                        StereoCalibration& calibration) {
  const std::optional<Entry> r1 = files.find_matrix("r1 rl rleft leftr");
  const std::optional<Entry> r2 = files.find_matrix("r2 rr rright rightr");
  const std::optional<Entry> p1 = files.find_matrix("p1 pl pleft leftp");
  const std::optional<Entry> p2 = files.find_matrix(kRightProjection);
  if (!r1 || !r2 || !p1 || !p2) return;
  constexpr const char* kShape = "a 3x4 projection";
  const RectifiedViews views = {rotation_from(*r1), rotation_from(*r2), p1->numbers(12, kShape),
                                p2->numbers(12, kShape)};
  const std::string problem = no_view_text(views.left_projection);
  if (motion && !problem.empty()) {
    calibration.remarks.push_back(p1->name() + problem +
                                  " The rectification of the file is not used, but computed from "
                                  "the cameras, R and T.");
    return;
  }
  Rectification rectification = rectification_from(views, *p1, *p2, unit);
  rectification.width = calibration.left.width;
  rectification.height = calibration.left.height;
  if (const std::optional<Entry> size = files.find("rectifiedsize")) {
    CameraCalibration stated;
    set_size(stated, *size);
    rectification.width = stated.width;
    rectification.height = stated.height;
  }
  // The product with the focal length is rounded; write_calibration() states the length itself.
  if (const std::optional<Entry> baseline = files.find("rectifiedbaseline")) {
    const double stated = baseline->number() * unit;
    if (std::abs(stated - rectification.baseline) > 1e-6 * std::abs(stated)) {
      baseline->fail("is " + number_text(stated) + " m, but " + p2->name() + " states " +
                     number_text(rectification.baseline) + " m");
    }
    rectification.baseline = stated;
  }
  calibration.rectification = rectification;
}

/// Fails for files of cameras that are calibrated alone, unless others state the rest.
void refuse_single_cameras(const OpenCvEntries& files, const std::vector<Entry>& documents,
                           const PairEntries& pair) {
  constexpr const char* kRemedy =
      "; give the files of both cameras and the one with R and T, separated by commas "
      "(LEFT,RIGHT,EXTRINSICS); if there is none, calibrate the cameras as a pair (mtcalibrate)";
  const int cameras = files.single_cameras();
  if (cameras == 1 && !(pair.left_matrix && pair.right_matrix)) {
    files.file().fail(std::string(documents.size() > 1 ? "and the others have" : "has") +
                      " one camera" + kRemedy);
  }
  if (cameras > 1 && !(pair.rotation && pair.translation)) {
    files.file().fail("and " + documents[1].file() +
                      " have one camera each, and neither states how they stand to each other" +
                      kRemedy);
  }
}

void read_cameras(const OpenCvEntries& files, const PairEntries& pair,
                  StereoCalibration& calibration) {
  if (!pair.left_matrix && files.has_projections_only()) {
    files.file().fail(
        "has P1 and P2 of rectified views only; of P1 = [f 0 cx 0, 0 f cy 0, ...] and P2 = [f 0 "
        "cx_right t, ...] write fx, fy, cx, cy, cx_right and baseline (-t / f in meters, or "
        "baseline_mm) to a YAML file");
  }
  if (!pair.left_matrix) files.fail_without("M1", "K of the left camera");
  if (!pair.right_matrix) files.fail_without("M2", "K of the right camera");
  if (!pair.left_lens) files.fail_without("D1", "distortion of the left camera");
  if (!pair.right_lens) files.fail_without("D2", "distortion of the right camera");
  set_camera_matrix(calibration.left, *pair.left_matrix);
  set_camera_matrix(calibration.right, *pair.right_matrix);
  if (pair.left_xi || pair.right_xi) {
    if (!pair.left_xi) files.fail_without("xi1", "of the left camera");
    if (!pair.right_xi) files.fail_without("xi2", "of the right camera");
    constexpr const char* kShape = "k1, k2, p1, p2, as cv::omnidir states them beside xi";
    set_omnidirectional(calibration.left, *pair.left_xi, pair.left_lens->numbers(4, kShape));
    set_omnidirectional(calibration.right, *pair.right_xi, pair.right_lens->numbers(4, kShape));
    return;
  }
  read_lens(files, "lensmodel1 leftdistortionmodel", *pair.left_lens, calibration.left,
            calibration.remarks);
  read_lens(files, "lensmodel2 rightdistortionmodel", *pair.right_lens, calibration.right,
            calibration.remarks);
}

/// R and T, or what the rectification implies if the files state neither.
void read_motion(const OpenCvEntries& files, const PairEntries& pair, double unit,
                 StereoCalibration& calibration) {
  const std::string hint = std::string(": ") + kUnitRemedy;
  if (!pair.rotation && !pair.translation && calibration.rectification) {
    const Motion motion = motion_of(*calibration.rectification);
    check_translation(motion.translation, files.find_matrix(kRightProjection).value(), hint);
    set_motion(calibration, motion);
    return;
  }
  if (!pair.rotation) files.fail_without("R", "rotation between the cameras");
  if (!pair.translation) files.fail_without("T", "translation between the cameras");
  const std::vector<double> v = pair.translation->numbers(3, "a vector");
  const std::vector<double> r = pair.rotation->numbers();
  constexpr double kLargeTurn = 0.2;  // [rad]
  if (r.size() == 3 && std::hypot(r[0], r[1], r[2]) > kLargeTurn) {
    calibration.remarks.push_back(
        pair.rotation->name() + " is a vector that turns the cameras by " +
        number_text(std::round(std::hypot(r[0], r[1], r[2]) * 180 / std::numbers::pi)) +
        " degrees to each other: it must be a rotation vector in radians.");
  }
  Motion motion;
  motion.rotation = rotation_from(*pair.rotation);
  motion.translation = Eigen::Vector3d(v[0], v[1], v[2]) * unit;
  check_translation(motion.translation, *pair.translation, hint);
  set_motion(calibration, motion);
}

std::string date_of(const OpenCvEntries& files) {
  const std::optional<Entry> entry =
      OpenCvEntries({files.file()}).find("date calibrationdate calibrationtime");
  if (!entry || !entry->is_scalar()) return {};
  std::string date = entry->text();
  // YYYY-MM-DD; OpenCV's sample "calibration" writes the words of the user's language.
  const bool iso = date.size() >= 10 && date.size() <= 40 && date[4] == '-' && date[7] == '-' &&
                   date.find_first_not_of("0123456789") == 4;
  return iso ? printable(date) : std::string();
}

}  // namespace

bool is_opencv(const Entry& file) { return OpenCvEntries({file}).is_opencv(); }

StereoCalibration read_opencv(const std::vector<Entry>& documents, const Request& request) {
  const OpenCvEntries files(documents);
  no_selection(files.file(), request.selection);
  StereoCalibration calibration;
  const std::optional<Entry> writer = files.find("writtenby");
  calibration.format = writer && writer->text() == kOwnFormat ? kOwnFormat : "OpenCV";
  const PairEntries pair = files.find_pair();
  refuse_single_cameras(files, documents, pair);
  read_cameras(files, pair, calibration);
  read_sizes(files, request, calibration);
  const std::optional<double> unit = unit_of(files, pair.translation);
  const bool motion = pair.rotation && pair.translation;
  read_rectification(files, unit.value_or(1), motion, calibration);
  read_motion(files, pair, unit.value_or(1), calibration);
  if (!unit) note_length(calibration, kUnitRemedy);
  calibration.date = date_of(files);
  return calibration;
}

}  // namespace mtstereo::formats
