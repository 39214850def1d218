// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "mtstereo/geometry/calibration.hpp"
#include "mtstereo/geometry/rectification.hpp"

// What an mtrectify does with the frames of one size. Independent of GStreamer.

namespace mtstereo::plugin {

/// The values of the properties.
struct RectifySettings {
  Rectifier::Side side = Rectifier::Side::kLeft;
  std::string calibration;         ///< one file, or two separated by a comma
  RectificationOptions options{};  ///< 0 as a size: from the video or the file
  int border = 0;                  ///< gray value of pixels that the camera does not see
  bool color = false;              ///< keep the channels of the input
  unsigned files = 0;              ///< how often `calibration` has been set
};

/// The size of a frame [px].
struct FrameSize {
  int width = 0;
  int height = 0;
  friend bool operator==(const FrameSize&, const FrameSize&) = default;
};

/// How frames are rectified.
struct RectificationPlan {
  RectifySettings settings;
  FrameSize input;
  StereoCalibration calibration;  ///< for the size of the input
  Rectification rectification;

  FrameSize output() const { return {rectification.width, rectification.height}; }
  const CameraCalibration& camera() const {
    return settings.side == Rectifier::Side::kLeft ? calibration.left : calibration.right;
  }
  /// True if the other plan has the same maps.
  bool has_maps_of(const RectificationPlan& other) const;
};

/// A calibration that has been read, until another one is asked for.
class CalibrationFile {
 public:
  /// The calibration for video of this size, scaled if the file is for another one.
  Result<StereoCalibration> for_video(const RectifySettings& settings, FrameSize size);
  /// The size that the file is for; std::nullopt if it cannot be read without knowing that of the
  /// video.
  std::optional<FrameSize> size_of(const RectifySettings& settings);

 private:
  Status read(const RectifySettings& settings, FrameSize size);

  std::optional<StereoCalibration> calibration_;
  std::string path_;
  unsigned files_ = 0;
  FrameSize read_for_;
};

/// The plan for frames of the size `input`. `output` replaces the size in the settings, if it is
/// not 0x0.
Result<RectificationPlan> plan_rectification(CalibrationFile& file, const RectifySettings& settings,
                                             FrameSize input, FrameSize output = {});

}  // namespace mtstereo::plugin
