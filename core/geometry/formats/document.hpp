// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>

#include "geometry/formats/value.hpp"

// A file of a calibration, parsed and recognized.

namespace mtstereo::formats {

/// Larger files are not read [bytes]. Calibrations with all their board corners have some 100 KB.
inline constexpr std::size_t kLargestCalibrationFile = 4 << 20;

/// The formats.
enum class Format {
  kOpenCv,
  kCameraInfo,
  kKalibr,
  kEuroc,
  kKittiRaw,
  kKittiOdometry,
  kMiddlebury,
  kDepthAi,
  kZed,
  kOrbSlam,
  kVins,
  kVinsCamera,
  kOv2Slam,
  kBasalt,
  kMrcal,
  kCameraList,
  kStella,
  kFoundationStereo,
  kCityscapes,
  kDsec,
  kArgoverse,
  kCameraTables,
  kAirSlam,
  kCalibIo,
  kRectifiedView,
};

/// The name of a format in messages, with its article.
const char* name_of(Format format);

/// A file after parsing.
struct Document {
  std::string file;
  std::string name;  ///< of the entry with the calibration; empty if that is the whole file
  Value root;
  Format format = Format::kOpenCv;

  Entry entry() const { return {root, file, name}; }
};

/// Reads a file and recognises the syntax, and then the format, from its content.
Document parse_document(const std::string& file);

}  // namespace mtstereo::formats
