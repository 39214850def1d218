// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/rectify_properties.hpp"

#include "mtstereo/parameters.hpp"

namespace mtstereo::plugin {
namespace {

GType camera_type() {
  static const GType type = enum_type<Rectifier::Side>(
      "GstMtStereoCamera", {{Rectifier::Side::kLeft, "The left camera", "left"},
                            {Rectifier::Side::kRight, "The right camera", "right"}});
  return type;
}

Status set_calibration(RectifySettings& settings, const GValue& value) {
  from_value(value, settings.calibration);
  ++settings.files;
  return {};
}

void get_calibration(const RectifySettings& settings, GValue& value) {
  to_value(value, settings.calibration);
}

}  // namespace

const PropertyTable<RectifySettings>& rectify_properties() {
  using Values = RectifySettings;
  using Row = Property<Values>;
  using Options = RectificationOptions;
  static const PropertyTable<Values> table({
      {"camera", &Values::side, camera_type(), "Camera of the video"},
      {g_param_spec_string("calibration", "calibration",
                           "Calibration file of both cameras: of OpenCV, ROS, Kalibr, EuRoC, "
                           "KITTI, Middlebury, DepthAI, ZED, ORB-SLAM, VINS-Fusion, Basalt, mrcal "
                           "or mtcalibrate, recognized by its content. Two files are separated by "
                           "a comma: left and right, or intrinsics and extrinsics",
                           nullptr, kWhilePlaying),
       set_calibration, get_calibration},
      Row("alpha", {&Values::options, &Options::alpha}, -1, 1,
          "Part of the scene in the output: 0 = only what both cameras see, without a border; 1 = "
          "all pixels of both cameras, with a border; -1 = keep the focal length of the cameras"),
      Row("width", {&Values::options, &Options::width}, 0, kLargestImageSide,
          "Width of the output in px (0: as downstream requires, else from the rectification in "
          "the calibration file or the video)"),
      Row("height", {&Values::options, &Options::height}, 0, kLargestImageSide,
          "Height of the output in px (0: as downstream requires, else from the rectification in "
          "the calibration file or the video)"),
      Row("zero-disparity", {&Values::options, &Options::zero_disparity},
          "Give points at infinity the disparity 0; otherwise the views are shifted to share more "
          "of "
          "the scene, and disparities have an offset, which the caps state"),
      {"border", &Values::border, 0, 255,
       "Value of the pixels that the camera does not see, in every channel"},
      {"color", &Values::color,
       "Keep the colors of RGB formats; otherwise the output is the luma (GRAY8), which the "
       "matcher needs"},
  });
  return table;
}

}  // namespace mtstereo::plugin
