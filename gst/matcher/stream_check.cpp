// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/stream_check.hpp"

#include <array>
#include <optional>
#include <string>

#include "shared/stereo_geometry.hpp"

namespace mtstereo::plugin {
namespace {

/// A warning if the left view is smaller than the one whose geometry its caps state.
void check_region(ElementState& state, const StereoGeometry& geometry) {
  const GstVideoInfo& video = state.formats[Side::kLeft].video;
  const std::string sizes = larger_frame(geometry, video.width, video.height);
  if (sizes.empty()) return;
  state.messages.warning(
      "The geometry in the caps of sink_left is that of a larger view: an element downstream of "
      "mtrectify scales or crops it, but keeps the caps fields. Depths of a scaled view and points "
      "of a cropped one are wrong: set width and height of both mtrectify instead of scaling; "
      "after cropping, set principal-x and principal-y of mtcloud.",
      sizes);
}

/// Warnings if the caps of the streams state two rectifications, or one of other views: once for
/// each change of the caps.
void compare_geometry(ElementState& state) {
  if (state.geometry_compared) return;
  state.geometry_compared = true;
  std::array<std::optional<StereoGeometry>, 2> sides;
  for (const Side side : kSides) {
    const auto& fields = state.formats[side].geometry;
    if (fields) sides[index_of(side)] = read_geometry(fields.get());
  }
  // Both views have one size, and the map has the geometry of the left one.
  if (sides[0]) check_region(state, *sides[0]);
  if (!sides[0] || !sides[1] || same_rectification(*sides[0], *sides[1])) return;
  const auto text = [](const StereoGeometry& geometry) {
    return "focal length " + std::to_string(geometry.focal_length) + " px, baseline " +
           std::to_string(geometry.baseline) + " m, principal offset " +
           std::to_string(geometry.principal_offset) + " px";
  };
  state.messages.warning(
      "The two streams are not rectified as a pair: their caps state different focal "
      "lengths, baselines or principal offsets. Give both mtrectify the same calibration "
      "and the same alpha, size and zero-disparity. The values of the left stream are "
      "used.",
      "left: " + text(*sides[0]) + "; right: " + text(*sides[1]));
}

}  // namespace

bool check_streams(ElementState& state) {
  const StreamFormat& left = state.formats[Side::kLeft];
  const StreamFormat& right = state.formats[Side::kRight];
  if (!left.has_caps || !right.has_caps) {
    state.messages.error(GST_CORE_ERROR, GST_CORE_ERROR_NEGOTIATION,
                         std::string("Frames arrived on ") +
                             pad_name(left.has_caps ? Side::kRight : Side::kLeft) +
                             " before any caps. Put a capsfilter upstream of it.");
    return false;
  }
  if (left.video.width == right.video.width && left.video.height == right.video.height) {
    compare_geometry(state);
    return true;
  }
  const auto size = [](const GstVideoInfo& info) {
    return std::to_string(info.width) + "x" + std::to_string(info.height);
  };
  state.messages.error(
      GST_STREAM_ERROR, GST_STREAM_ERROR_WRONG_TYPE,
      "The two streams have different sizes: left " + size(left.video) + ", right " +
          size(right.video) +
          ". Both frames of a rectified pair must have the same size: set both cameras to "
          "the same size, or put videoscale and a capsfilter upstream of one pad.");
  return false;
}

}  // namespace mtstereo::plugin
