// SPDX-License-Identifier: LGPL-2.1-or-later
// Stereolabs ZED: SNnnnn.conf, with one section per camera and resolution. Lengths are in
// millimeters; the rotation is the vector (RX, CV, RZ).
#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

constexpr double kMillimeter = 0.001;

/// A resolution of the cameras, and the end of the names of its sections.
struct Resolution {
  const char* name;
  int width, height;
};
constexpr std::array<Resolution, 8> kResolutions = {{{"2K", 2208, 1242},
                                                     {"FHD", 1920, 1080},
                                                     {"HD", 1280, 720},
                                                     {"VGA", 672, 376},
                                                     {"FHD1200", 1920, 1200},
                                                     {"SVGA", 960, 600},
                                                     {"4K", 3840, 2160},
                                                     {"QHDPLUS", 3200, 1800}}};

Entry section(const Entry& file, const std::string& name) {
  if (std::optional<Entry> found = file.find_any_case(name)) return *std::move(found);
  file.fail("there is no section [" + name + "]");
}

/// The resolution of the video, or the one that was selected.
Resolution choose_resolution(const Entry& file, const Request& request) {
  const auto is_there = [&](const Resolution& resolution) {
    return file.find_any_case(std::string("LEFT_CAM_") + resolution.name).has_value();
  };
  std::string known;
  for (const Resolution& resolution : kResolutions) {
    if (!is_there(resolution)) continue;
    const bool fits = resolution.width == request.width && resolution.height == request.height;
    if (request.selection.empty() ? fits : request.selection == resolution.name) return resolution;
    known += (known.empty() ? "" : ", ") + std::string(resolution.name) + " (" +
             std::to_string(resolution.width) + "x" + std::to_string(resolution.height) + ")";
  }
  if (known.empty()) {
    file.fail(
        "there is no section [LEFT_CAM_...] of a known resolution; if it is no ZED file, write its "
        "matrices to a YAML file with the names M1, D1, M2, D2, R, T");
  }
  if (!request.selection.empty()) {
    file.fail("'#" + printable(request.selection) + "' selects no resolution; there are " + known);
  }
  if (request.width == 0) {
    file.fail(
        "the size of the video is not known, and the file has several; add one to the "
        "path, as in '#HD': " +
        known);
  }
  const bool side_by_side =
      std::any_of(kResolutions.begin(), kResolutions.end(), [&](const Resolution& resolution) {
        return request.width == 2 * resolution.width && request.height == resolution.height;
      });
  file.fail("there is no calibration for video of " + std::to_string(request.width) + "x" +
            std::to_string(request.height) +
            (side_by_side ? ", which has both views side by side: separate them first" : "") +
            "; there are " + known +
            (side_by_side ? "" : ": record with one of these resolutions"));
}

double number_or_zero(const Entry& section, const std::string& name) {
  const std::optional<Entry> entry = section.find_any_case(name);
  return entry ? entry->number() : 0;
}

double number(const Entry& section, const std::string& name) {
  const std::optional<Entry> entry = section.find_any_case(name);
  if (!entry) section.fail("has no entry " + name);
  return entry->number();
}

/// The distortion is in the section of the camera, or for all resolutions in one of its own.
/// There, four coefficients without p1 belong to a fisheye lens.
void read_lens(CameraCalibration& camera, const Entry& section, bool shared) {
  const auto k = [&](const char* name) { return number_or_zero(section, name); };
  (void)number(section, "k1");
  if (shared && !section.find_any_case("p1")) {
    camera.lens = LensModel::kFisheye;
    camera.coefficients = {k("k1"), k("k2"), k("k3"), k("k4")};
    return;
  }
  camera.lens = LensModel::kPlumbBob;
  camera.coefficients = {k("k1"), k("k2"), k("p1"), k("p2"), k("k3")};
  if (!section.find_any_case("k4")) return;
  for (const char* name : {"k4", "k5", "k6"}) camera.coefficients.push_back(k(name));
}

CameraCalibration read_camera(const Entry& file, const std::string& side,
                              const Resolution& resolution) {
  const Entry entry = section(file, side + "_CAM_" + resolution.name);
  CameraCalibration camera;
  camera.width = resolution.width;
  camera.height = resolution.height;
  set_camera_matrix(camera, entry,
                    {number(entry, "fx"), 0, number(entry, "cx"), 0, number(entry, "fy"),
                     number(entry, "cy"), 0, 0, 1});
  const std::optional<Entry> shared = file.find_any_case(side + "_DISTO");
  read_lens(camera, shared ? *shared : entry, shared.has_value());
  return camera;
}

/// "TY_HD", or "TY" for all resolutions; 0 without either.
double stereo_value(const Entry& stereo, const char* name, const Resolution& resolution) {
  const std::string full = std::string(name) + "_" + resolution.name;
  return stereo.find_any_case(full) ? number(stereo, full) : number_or_zero(stereo, name);
}

}  // namespace

StereoCalibration read_zed(const Entry& file, const Request& request) {
  const Resolution resolution = choose_resolution(file, request);
  StereoCalibration calibration;
  calibration.format = "ZED";
  calibration.left = read_camera(file, "LEFT", resolution);
  calibration.right = read_camera(file, "RIGHT", resolution);
  const Entry stereo = section(file, "STEREO");
  const std::optional<Entry> baseline = stereo.find_any_case("Baseline");
  if (!baseline) stereo.fail("has no entry Baseline");
  const auto value = [&](const char* name) { return stereo_value(stereo, name, resolution); };
  // Factory files state the place of the right camera (as in Stereolabs' zed-open-capture: -T);
  // files with a section for the distortion state TY and TZ of OpenCV's T (as Stereolabs'
  // calibration program for two mono cameras writes them).
  const double sign = file.find_any_case("LEFT_DISTO") ? 1 : -1;
  Motion motion;
  motion.rotation = rotation_of_vector(value("RX"), value("CV"), value("RZ"));
  motion.translation =
      Eigen::Vector3d(-baseline->number(), sign * value("TY"), sign * value("TZ")) * kMillimeter;
  check_translation(motion.translation, *baseline, "; it is in millimeters");
  set_motion(calibration, motion);
  return calibration;
}

}  // namespace mtstereo::formats
