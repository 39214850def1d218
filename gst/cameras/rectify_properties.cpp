// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/rectify_properties.hpp"

#include <gst/gst.h>

#include "mtstereo/parameters.hpp"

namespace mtstereo::plugin {
namespace {

enum Property : guint {
  kCamera = 1,
  kCalibration,
  kAlpha,
  kWidth,
  kHeight,
  kZeroDisparity,
  kBorder,
  kColor
};

constexpr auto kFlags = static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS |
                                                 GST_PARAM_MUTABLE_PLAYING);

enum CameraValue : gint { kLeftCamera, kRightCamera };

GType camera_type() {
  static const GEnumValue values[] = {{kLeftCamera, "The left camera", "left"},
                                      {kRightCamera, "The right camera", "right"},
                                      {0, nullptr, nullptr}};
  static const GType type = g_enum_register_static("GstMtStereoCamera", values);
  return type;
}

void install_size(GObjectClass* object_class, Property id, const char* name, const char* blurb) {
  g_object_class_install_property(
      object_class, id, g_param_spec_int(name, name, blurb, 0, kLargestImageSide, 0, kFlags));
}

}  // namespace

void install_rectify_properties(GObjectClass* object_class) {
  g_object_class_install_property(
      object_class, kCamera,
      g_param_spec_enum("camera", "camera", "Which of the two cameras the video is from",
                        camera_type(), kLeftCamera, kFlags));
  g_object_class_install_property(
      object_class, kCalibration,
      g_param_spec_string("calibration", "calibration",
                          "File with the calibration of both cameras: of OpenCV, ROS, Kalibr, "
                          "EuRoC, KITTI, Middlebury, DepthAI, ZED, ORB-SLAM, VINS-Fusion, "
                          "Basalt, mrcal or mtcalibrate, which is recognized from the content. Two "
                          "files are separated by a comma: left and right, or intrinsics and "
                          "extrinsics",
                          nullptr, kFlags));
  g_object_class_install_property(
      object_class, kAlpha,
      g_param_spec_double("alpha", "alpha",
                          "Part of the scene in the output: 0 = only what both cameras see, "
                          "without a border; 1 = all pixels of both cameras, with a border; -1 = "
                          "the focal length of the cameras is kept",
                          -1, 1, 0, kFlags));
  install_size(object_class, kWidth, "width",
               "Width of the output in px (0: what downstream requires, otherwise that of the "
               "calibration file's rectification or of the video)");
  install_size(object_class, kHeight, "height",
               "Height of the output in px (0: what downstream requires, otherwise that of the "
               "calibration file's rectification or of the video)");
  g_object_class_install_property(
      object_class, kZeroDisparity,
      g_param_spec_boolean("zero-disparity", "zero-disparity",
                           "Points at infinity have the disparity 0; otherwise the views are moved "
                           "to share more of the scene, and disparities have an offset, which is "
                           "in the caps",
                           TRUE, kFlags));
  g_object_class_install_property(
      object_class, kBorder,
      g_param_spec_int("border", "border",
                       "Value of the pixels that the camera does not see, in every channel", 0, 255,
                       0, kFlags));
  g_object_class_install_property(
      object_class, kColor,
      g_param_spec_boolean("color", "color",
                           "Keep the colors of RGB formats; otherwise the output is the luma "
                           "(GRAY8), which the matcher needs",
                           FALSE, kFlags));
  gst_type_mark_as_plugin_api(camera_type(), static_cast<GstPluginAPIFlags>(0));
}

bool set_rectify_property(RectifySettings& settings, guint id, const GValue* value) {
  switch (id) {
    case kCamera:
      settings.side =
          g_value_get_enum(value) == kLeftCamera ? Rectifier::Side::kLeft : Rectifier::Side::kRight;
      return true;
    case kCalibration: {
      const gchar* path = g_value_get_string(value);
      settings.calibration = path != nullptr ? path : "";
      ++settings.files;
      return true;
    }
    case kAlpha:
      settings.options.alpha = g_value_get_double(value);
      return true;
    case kWidth:
      settings.options.width = g_value_get_int(value);
      return true;
    case kHeight:
      settings.options.height = g_value_get_int(value);
      return true;
    case kZeroDisparity:
      settings.options.zero_disparity = g_value_get_boolean(value) != FALSE;
      return true;
    case kBorder:
      settings.border = g_value_get_int(value);
      return true;
    case kColor:
      settings.color = g_value_get_boolean(value) != FALSE;
      return true;
    default:
      return false;
  }
}

bool get_rectify_property(const RectifySettings& settings, guint id, GValue* value) {
  switch (id) {
    case kCamera:
      g_value_set_enum(value, settings.side == Rectifier::Side::kLeft ? kLeftCamera : kRightCamera);
      return true;
    case kCalibration:
      g_value_set_string(value,
                         settings.calibration.empty() ? nullptr : settings.calibration.c_str());
      return true;
    case kAlpha:
      g_value_set_double(value, settings.options.alpha);
      return true;
    case kWidth:
      g_value_set_int(value, settings.options.width);
      return true;
    case kHeight:
      g_value_set_int(value, settings.options.height);
      return true;
    case kZeroDisparity:
      g_value_set_boolean(value, settings.options.zero_disparity ? TRUE : FALSE);
      return true;
    case kBorder:
      g_value_set_int(value, settings.border);
      return true;
    case kColor:
      g_value_set_boolean(value, settings.color ? TRUE : FALSE);
      return true;
    default:
      return false;
  }
}

}  // namespace mtstereo::plugin
