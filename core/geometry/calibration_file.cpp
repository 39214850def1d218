// SPDX-License-Identifier: LGPL-2.1-or-later
// Splits the path into files, and calls the reader of their format.
#include "geometry/calibration_file.hpp"

#include <sys/stat.h>

#include <utility>

#include "base/guard.hpp"
#include "geometry/calibration_remarks.hpp"
#include "geometry/formats/document.hpp"
#include "geometry/formats/readers.hpp"

namespace mtstereo {
namespace {

using formats::Document;
using formats::Entry;
using formats::FileError;
using formats::Format;
using formats::Value;

[[noreturn]] void fail_as_one_camera(const Document& document) {
  document.entry().fail(std::string("is ") + name_of(document.format) +
                        ", which has one camera; give two files, separated by a comma: LEFT,RIGHT");
}

/// The INI of ROS may have both cameras in one file.
StereoCalibration read_one_camera_info(const Document& document, const formats::Request& request) {
  if (!document.entry().is_list()) fail_as_one_camera(document);
  const std::vector<Value>& cameras = document.root.items;
  if (cameras.size() != 2) {
    document.entry().fail("has " + std::to_string(cameras.size()) + " cameras, 2 are needed");
  }
  return formats::read_camera_info(Entry(cameras[0], document.file, {}),
                                   Entry(cameras[1], document.file, {}), request);
}

StereoCalibration read_one(const Document& document, const formats::Request& request) {
  const Entry entry = document.entry();
  switch (document.format) {
    case Format::kOpenCv:
      return formats::read_opencv({entry}, request);
    case Format::kOrbSlam:
      return formats::read_orbslam(entry, request);
    case Format::kVins:
      return formats::read_vins(entry, request);
    case Format::kBasalt:
      return formats::read_basalt(entry, request);
    case Format::kCameraList:
      return formats::read_camera_list(entry, request);
    case Format::kFoundationStereo:
      return formats::read_foundation_stereo(entry, request);
    case Format::kStella:
      return formats::read_stella(entry, request);
    case Format::kVinsCamera:
      entry.fail(std::string("is ") + name_of(document.format) +
                 "; give the file that names both cameras as cam0_calib and cam1_calib");
    case Format::kCameraInfo:
      return read_one_camera_info(document, request);
    case Format::kEuroc:
    case Format::kMrcal:
      fail_as_one_camera(document);
    case Format::kKalibr:
      return formats::read_kalibr(entry, request);
    case Format::kKittiRaw:
      return formats::read_kitti_raw(entry, request);
    case Format::kKittiOdometry:
      return formats::read_kitti_odometry(entry, request);
    case Format::kMiddlebury:
      return formats::read_middlebury(entry, request);
    case Format::kDepthAi:
      return formats::read_depthai(entry, request);
    case Format::kZed:
      break;
  }
  return formats::read_zed(entry, request);
}

StereoCalibration read_two(const Document& first, const Document& second,
                           const formats::Request& request) {
  if (first.format != second.format) {
    throw FileError(first.file + " is " + name_of(first.format) + ", but " + second.file + " is " +
                    name_of(second.format) + "; both files must have the same format");
  }
  switch (first.format) {
    case Format::kOpenCv:
      return formats::read_opencv({first.entry(), second.entry()}, request);
    case Format::kCameraInfo:
      for (const Document* document : {&first, &second}) {
        if (document->entry().is_list()) {
          document->entry().fail("has several cameras; give this file alone");
        }
      }
      return formats::read_camera_info(first.entry(), second.entry(), request);
    case Format::kEuroc:
      return formats::read_euroc(first.entry(), second.entry(), request);
    case Format::kMrcal:
      return formats::read_mrcal(first.entry(), second.entry(), request);
    case Format::kVinsCamera:
      return read_one(first, request);
    default:
      throw FileError(first.file + " is " + name_of(first.format) +
                      ", which has both cameras in one file; give one file");
  }
}

StereoCalibration read_files(const std::string& path, int width, int height) {
  const CalibrationPath parts = split_calibration_path(path);
  const formats::Request request = {width, height, parts.selection};
  const Document first = formats::parse_document(parts.files[0]);
  StereoCalibration calibration;
  if (parts.files.size() == 1) {
    calibration = read_one(first, request);
  } else {
    calibration = read_two(first, formats::parse_document(parts.files[1]), request);
  }
  put_in_order(calibration);
  if (const Status status = check_calibration(calibration); !status) {
    throw FileError(path + ": " + status.error().message);
  }
  note_centers(calibration);
  return calibration;
}

bool exists(const std::string& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0;
}

}  // namespace

CalibrationPath split_calibration_path(const std::string& path) {
  CalibrationPath result;
  std::string files = path;
  const std::size_t mark = path.rfind('#');
  if (mark != std::string::npos && path.find('/', mark) == std::string::npos && !exists(path)) {
    files = path.substr(0, mark);
    result.selection = path.substr(mark + 1);
  }
  if (exists(files)) {
    result.files = {files};
    return result;
  }
  // Of several commas, that between two files.
  std::size_t split = files.find(',');
  for (std::size_t at = split; at != std::string::npos; at = files.find(',', at + 1)) {
    if (exists(files.substr(0, at)) && exists(files.substr(at + 1))) {
      split = at;
      break;
    }
  }
  if (split == std::string::npos) {
    result.files = {files};
  } else {
    result.files = {files.substr(0, split), files.substr(split + 1)};
  }
  return result;
}

Result<StereoCalibration> read_calibration(const std::string& path, int width,
                                           int height) noexcept {
  return guarded([&]() -> Result<StereoCalibration> {
    try {
      return read_files(path, width, height);
    } catch (const FileError& error) {
      return Error{ErrorCode::kInvalidCalibration, error.what()};
    }
  });
}

}  // namespace mtstereo
