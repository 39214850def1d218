// SPDX-License-Identifier: LGPL-2.1-or-later
// DepthAI (OAK): the EEPROM of a board as JSON. Cameras are numbered by their socket; `extrinsics`
// moves points from a camera to that of toCameraSocket, in centimeters.
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/formats/parts.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo::formats {
namespace {

constexpr double kCentimeter = 0.01;
constexpr int kMostSockets = 64;

/// The entry of a camera.
struct Socket {
  int number;
  Entry entry;
};

std::vector<Socket> read_sockets(const Entry& file) {
  std::vector<Socket> sockets;
  for (const Entry& pair : file.at("cameraData", "the cameras").list()) {
    const std::vector<Entry> parts = pair.list();
    if (parts.size() != 2) pair.fail("has no socket and camera");
    sockets.push_back({parts[0].integer(-1, kMostSockets), parts[1]});
  }
  return sockets;
}

const Entry& camera_of(const Entry& file, const std::vector<Socket>& sockets, int number,
                       const char* side) {
  const auto found = std::find_if(sockets.begin(), sockets.end(),
                                  [&](const Socket& socket) { return socket.number == number; });
  if (found == sockets.end()) {
    file.fail(std::string("cameraData has no socket ") + std::to_string(number) + ", the " + side +
              " camera");
  }
  return found->entry;
}

/// The sockets of the pair: as selected, else as the board's own stereo matcher uses them.
Selection choose_sockets(const Entry& file, const std::string& selection) {
  if (!selection.empty()) return selected_pair(file, selection, "1-2");
  const std::optional<Entry> stereo = file.find("stereoRectificationData");
  const std::optional<Entry> left = stereo ? stereo->find("leftCameraSocket") : std::nullopt;
  const std::optional<Entry> right = stereo ? stereo->find("rightCameraSocket") : std::nullopt;
  if (!left || !right || left->number() < 0 || right->number() < 0) {
    file.fail(
        "stereoRectificationData names no left and right camera; add the sockets to the "
        "path, as in '#1-2'");
  }
  return {left->text(), right->text()};
}

int socket_number(const Entry& file, const std::string& text) {
  const std::optional<double> number = parse_number(text);
  for (int socket = 0; socket < kMostSockets; ++socket) {
    if (number && *number == socket) return socket;
  }
  file.fail("'" + printable(text) + "' is no socket; a number is needed");
}

CameraCalibration read_depthai_camera(const Entry& entry) {
  CameraCalibration camera;
  set_size(camera, entry.at("width"), entry.at("height"));
  set_camera_matrix(camera, entry.at("intrinsicMatrix"));
  const std::optional<Entry> type = entry.find("cameraType");
  constexpr int kPerspective = 0;
  constexpr int kFisheye = 1;
  const int model = type ? type->integer(0, kMostSockets) : kPerspective;
  if (model > kFisheye) {
    type->fail("is " + std::to_string(model) +
               "; only 0 (perspective) and 1 (fisheye) are "
               "supported");
  }
  const Entry coefficients = entry.at("distortionCoeff");
  if (model == kPerspective) {
    set_lens(camera, LensModel::kPlumbBob, coefficients);
    return camera;
  }
  // Fisheye lenses use the first four of the fourteen.
  Value four = coefficients.value();
  constexpr std::size_t kFisheyeCount = 4;
  if (four.items.size() > kFisheyeCount) four.items.resize(kFisheyeCount);
  set_lens(camera, LensModel::kFisheye, Entry(four, entry.file(), coefficients.name()));
  return camera;
}

/// A sensor of 16:10 that gives video of 16:9 leaves out rows at the top and at the bottom.
void crop_to_video(CameraCalibration& camera, const Request& request) {
  const int rows = camera.width * 9 / 16;
  const bool tall = camera.width * 10 == camera.height * 16 && camera.width % 16 == 0;
  if (!tall || request.width * 9 != request.height * 16) return;
  camera.center_y -= (camera.height - rows) / 2.0;
  camera.height = rows;
}

/// The motion that the extrinsics of a camera state.
Motion read_extrinsics(const Entry& extrinsics) {
  Motion motion;
  motion.rotation = rotation_from(extrinsics.at("rotationMatrix"));
  const auto vector = [](const Entry& entry) {
    return Eigen::Vector3d(entry.at("x").number(), entry.at("y").number(), entry.at("z").number());
  };
  motion.translation = vector(extrinsics.at("translation"));
  const std::optional<Entry> specified = extrinsics.find("specTranslation");
  // Boards that were never calibrated state the drawing's lengths only.
  if (motion.translation.isZero() && specified) motion.translation = vector(*specified);
  motion.translation *= kCentimeter;
  return motion;
}

/// Where a camera's chain of toCameraSocket leads to: the motions from the camera to each socket.
struct Step {
  int socket;
  Motion motion;
};
std::vector<Step> chain_of(const Entry& file, const std::vector<Socket>& sockets, int start) {
  std::vector<Step> chain = {{start, {}}};
  std::set<int> seen = {start};
  while (true) {
    const Step last = chain.back();
    const Entry extrinsics =
        camera_of(file, sockets, last.socket, "next").at("extrinsics", "position of the camera");
    const int next = extrinsics.at("toCameraSocket").integer(-1, kMostSockets);
    if (next < 0 || !seen.insert(next).second) return chain;
    chain.push_back({next, read_extrinsics(extrinsics).after(last.motion)});
  }
}

Motion motion_between(const Entry& file, const std::vector<Socket>& sockets, int left, int right) {
  const std::vector<Step> from_right = chain_of(file, sockets, right);
  for (const Step& a : chain_of(file, sockets, left)) {
    for (const Step& b : from_right) {
      if (a.socket == b.socket) return b.motion.inverse().after(a.motion);
    }
  }
  file.fail("the extrinsics do not connect the sockets " + std::to_string(left) + " and " +
            std::to_string(right));
}

}  // namespace

StereoCalibration read_depthai(const Entry& file, const Request& request) {
  const std::vector<Socket> sockets = read_sockets(file);
  const Selection pair = choose_sockets(file, request.selection);
  const int left = socket_number(file, pair.left);
  const int right = socket_number(file, pair.right);
  if (left == right) file.fail("the left and the right camera are both socket " + pair.left);
  StereoCalibration calibration;
  calibration.format = "DepthAI";
  calibration.left = read_depthai_camera(camera_of(file, sockets, left, "left"));
  const Entry& right_camera = camera_of(file, sockets, right, "right");
  calibration.right = read_depthai_camera(right_camera);
  for (CameraCalibration* camera : {&calibration.left, &calibration.right}) {
    if (request.width > 0) crop_to_video(*camera, request);
  }
  const Motion motion = motion_between(file, sockets, left, right);
  check_translation(motion.translation, camera_of(file, sockets, left, "left").at("extrinsics"),
                    "; translations are in centimeters");
  set_motion(calibration, motion);
  return calibration;
}

}  // namespace mtstereo::formats
