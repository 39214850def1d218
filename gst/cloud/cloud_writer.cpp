// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/cloud_writer.hpp"

#include <cstdint>

#include "shared/confidence_meta.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {
namespace {

bool refuse(gpointer element, const char* what, const std::string& problem) {
  GST_ELEMENT_ERROR(element, STREAM, WRONG_TYPE, ("The %s is invalid: %s.", what, problem.c_str()),
                    (nullptr));
  return false;
}

bool refuse_missing_confidence(gpointer element) {
  GST_ELEMENT_ERROR(
      element, STREAM, WRONG_TYPE,
      ("min-confidence is set, and a disparity map has no confidence map. Put an mtstereo with "
       "confidence-map=true upstream, and nothing between it and mtcloud that changes the maps "
       "into other frames, such as videoscale, an encoder, a file or a network."),
      ("no sample \"%s\" in a meta %s", kConfidenceField, kConfidenceMeta));
  return false;
}

/// A mapped frame that may be absent.
class OptionalFrame {
 public:
  /// Maps the frame; the text is why it cannot be mapped.
  std::string map(const GstVideoInfo& info, GstBuffer* buffer) {
    frame_.emplace(info, buffer, GST_MAP_READ);
    return frame_->mapped() ? "" : frame_->problem();
  }
  /// The 8-bit values of the first plane; no data without a frame.
  ImageView<const std::uint8_t> view() const { return frame_ ? frame_->luma() : GrayView{}; }

 private:
  std::optional<MappedFrame> frame_;
};

std::string map_left(const LeftFrame& left, const GstVideoInfo& disparity, OptionalFrame& frame) {
  if (left.info.width != disparity.width || left.info.height != disparity.height) {
    return "it has " + std::to_string(left.info.width) + "x" + std::to_string(left.info.height) +
           " px, the disparity map has " + std::to_string(disparity.width) + "x" +
           std::to_string(disparity.height) + " px";
  }
  return frame.map(left.info, left.buffer.get());
}

}  // namespace

ImageView<const std::uint16_t> CloudWriter::values(ImageView<std::uint16_t> image) {
  constexpr std::uintptr_t kMask = alignof(std::uint16_t) - 1;
  const std::uintptr_t address =
      reinterpret_cast<std::uintptr_t>(image.data) | static_cast<std::uintptr_t>(image.stride);
  if (G_BYTE_ORDER == G_LITTLE_ENDIAN && (address & kMask) == 0) {
    return {image.data, image.width, image.height, image.stride};
  }
  const auto width = static_cast<std::size_t>(image.width);
  values_.resize(width * static_cast<std::size_t>(image.height));
  std::uint16_t* to = values_.data();
  for (int y = 0; y < image.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint8_t*>(image.data) + y * image.stride;
    for (int x = 0; x < image.width; ++x, row += 2) *to++ = read16(row);
  }
  return {values_.data(), image.width, image.height, static_cast<std::ptrdiff_t>(2 * width)};
}

bool CloudWriter::make(gpointer element, GstBuffer* map, const GstVideoInfo& info,
                       const LeftFrame* left, const DepthGeometry& geometry,
                       const CloudOptions& options) {
  const MappedFrame disparity(info, map, GST_MAP_READ);
  if (!disparity.mapped()) return refuse(element, "disparity map", disparity.problem());
  OptionalFrame color;
  if (left != nullptr) {
    const std::string problem = map_left(*left, info, color);
    if (!problem.empty()) return refuse(element, "left view", problem);
  }
  OptionalFrame confidence;
  if (GstSample* sample = confidence_of(map)) {
    GstVideoInfo of_confidence;
    std::string problem = confidence_problem(sample, info, of_confidence);
    if (problem.empty()) problem = confidence.map(of_confidence, gst_sample_get_buffer(sample));
    if (!problem.empty()) return refuse(element, "confidence map of a disparity map", problem);
  } else if (options.min_confidence > 0) {
    return refuse_missing_confidence(element);
  }
  const bool rgb = left != nullptr && GST_VIDEO_INFO_FORMAT(&left->info) == GST_VIDEO_FORMAT_RGB;
  const CloudInput input = {values(disparity.gray16()), color.view(), rgb ? 3 : 1,
                            confidence.view()};
  const Status status = make_cloud(input, geometry, options, points_);
  return status.ok() || refuse(element, "cloud", status.error().message);
}

bool CloudWriter::write(gpointer element, CloudFormat format, const std::string& path) const {
  const Status status = write_cloud(points_, format, path);
  if (status) return true;
  GST_ELEMENT_ERROR(element, RESOURCE, WRITE,
                    ("A cloud was not written: %s.", status.error().message.c_str()), (nullptr));
  return false;
}

void CloudWriter::clear() {
  points_ = {};
  values_ = {};
}

}  // namespace mtstereo::plugin
