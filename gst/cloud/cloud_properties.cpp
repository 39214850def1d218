// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/cloud_properties.hpp"

namespace mtstereo::plugin {
namespace {

GType format_type() {
  static const GType type = enum_type<CloudFormatChoice>(
      "GstMtStereoCloudFormat",
      {{CloudFormatChoice::kAuto, "By the extension of the location", "auto"},
       {CloudFormatChoice::kPly, "PLY, binary", "ply"},
       {CloudFormatChoice::kPcd, "PCD of the Point Cloud Library, binary", "pcd"}});
  return type;
}

}  // namespace

std::optional<CloudFormat> CloudProperties::format() const {
  switch (format_choice) {
    case CloudFormatChoice::kPly:
      return CloudFormat::kPly;
    case CloudFormatChoice::kPcd:
      return CloudFormat::kPcd;
    default:
      return std::nullopt;
  }
}

const PropertyTable<CloudProperties>& cloud_properties() {
  using Values = CloudProperties;
  using Row = Property<Values>;
  static const PropertyTable<Values> table(
      {
          {"location", &Values::location,
           "Path of the files. A number such as %05d in it becomes the number of the disparity "
           "map, from 0; without one, each file replaces the previous one",
           kBeforeStart},
          {"format", &Values::format_choice, format_type(), "Format of the files", kBeforeStart},
          {"every-nth", &Values::every_nth, 1, G_MAXINT,
           "Write only every n-th disparity map, starting with the first"},
          Row("near", {&Values::range, &DepthRange::near}, 0, kLargestDepthLimit,
              "Minimum depth in meters; nearer points are omitted"),
          Row("far", {&Values::range, &DepthRange::far}, 0, kLargestDepthLimit,
              "Maximum depth in meters; farther points are omitted (0: no limit)"),
          {"min-confidence", &Values::min_confidence, 0, 255,
           "Omit points of lower confidence (0: write all)"},
          {"step", &Values::step, 1, 16384, "Write only every n-th pixel and row"},
          {"timeout", &Values::timeout, 0, 3600 * GST_SECOND,
           "Longest wait for a frame of the left view or for a disparity map, in ns; then the "
           "points are white, or the oldest left frame is dropped",
           kBeforeStart},
      },
      geometry_rows<Values>());
  return table;
}

}  // namespace mtstereo::plugin
