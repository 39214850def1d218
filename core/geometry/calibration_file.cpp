// SPDX-License-Identifier: LGPL-2.1-or-later
// Reads the files that a path names, by the readers of their formats.

#include <string>
#include <vector>

#include "base/guard.hpp"
#include "geometry/calibration_path.hpp"
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
    case Format::kOv2Slam:
      return formats::read_ov2slam(entry, request);
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
    case Format::kCityscapes:
      return formats::read_cityscapes(entry, request);
    case Format::kCameraTables:
      return formats::read_camera_tables(entry, request);
    case Format::kCalibIo:
      return formats::read_calib_io(entry, request);
    case Format::kAirSlam:
      return formats::read_airslam(entry, request);
    case Format::kRectifiedView:
      return formats::read_rectified_view(entry, request);
    case Format::kDsec:
      return formats::read_dsec(entry, request);
    case Format::kArgoverse:
      return formats::read_argoverse(entry, request);
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

/// Only the calibration of single cameras, by OpenCV or ROS, leads to three files.
StereoCalibration read_three(const std::vector<Document>& documents,
                             const formats::Request& request) {
  std::vector<Entry> entries;
  for (const Document& document : documents) {
    if (document.format != Format::kOpenCv && document.format != Format::kCameraInfo) {
      throw FileError(document.file + " is " + name_of(document.format) +
                      "; only files of OpenCV and ROS are read by three (LEFT,RIGHT,EXTRINSICS)");
    }
    entries.push_back(document.entry());
  }
  return formats::read_opencv(entries, request);
}

StereoCalibration read_files(const std::string& path, int width, int height) {
  const CalibrationPath parts = split_calibration_path(path);
  const formats::Request request = {width, height, parts.selection};
  std::vector<Document> documents;
  for (const std::string& file : parts.files) documents.push_back(formats::parse_document(file));
  StereoCalibration calibration = documents.size() == 1 ? read_one(documents[0], request)
                                  : documents.size() == 2
                                      ? read_two(documents[0], documents[1], request)
                                      : read_three(documents, request);
  put_in_order(calibration);
  if (const Status status = check_calibration(calibration); !status) {
    throw FileError(path + ": " + status.error().message);
  }
  state_rectification(calibration);
  note_centers(calibration);
  return calibration;
}

}  // namespace

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
