// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "recordings/inputs/view_rectifier.hpp"
#include "recordings/media/frame_reader.hpp"

namespace mtstereo::run {

/// Decodes frames of one source and reduces them to small gray images.
class GrayFrames {
 public:
  /// Images of at most this width [px]. Both references must outlive the object. Throws
  /// UserError.
  GrayFrames(const Source& source, const FrameIndex& index, int width);

  /// Rectifies the images as one side of this calibration, which is for whole frames.
  void rectify_as(const StereoCalibration& calibration, Rectifier::Side side);

  /// The image of a frame; empty if it cannot be decoded. Numbers that increase are fast. The
  /// last few images are kept.
  cv::Mat at(std::int64_t number);

  const FrameIndex& index() const { return index_; }

 private:
  struct FreeConverter {
    void operator()(GstVideoConverter* converter) const { gst_video_converter_free(converter); }
  };

  cv::Mat convert(const DecodedFrame& frame);
  void prepare(GstCaps* caps);

  const FrameIndex& index_;
  int width_;
  std::unique_ptr<FrameReader> reader_;
  CapsPointer caps_;
  GstVideoInfo in_{}, out_{};
  std::unique_ptr<GstVideoConverter, FreeConverter> converter_;
  std::map<std::int64_t, cv::Mat> kept_;
  std::optional<ViewRectifier> rectifier_;
};

}  // namespace mtstereo::run
