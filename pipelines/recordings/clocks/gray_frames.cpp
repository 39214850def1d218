// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/clocks/gray_frames.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::run {
namespace {

constexpr std::size_t kKept = 8;  // images
constexpr int kFewestRows = 16;   // of an image [px]

}  // namespace

GrayFrames::GrayFrames(const Source& source, const FrameIndex& index, int width)
    : index_(index), width_(width) {
  start_gstreamer();
  reader_ = open_reader(source, index);
}

void GrayFrames::prepare(GstCaps* caps) {
  if (caps_ && gst_caps_is_equal(caps_.get(), caps) != FALSE) return;
  if (gst_video_info_from_caps(&in_, caps) == FALSE) {
    throw UserError("frames of an unknown format cannot be compared");
  }
  const int width = std::min(width_, in_.width);
  const int height =
      std::max(kFewestRows,
               static_cast<int>(std::lround(static_cast<double>(in_.height) * width / in_.width)));
  gst_video_info_set_format(&out_, GST_VIDEO_FORMAT_GRAY8, static_cast<guint>(width),
                            static_cast<guint>(height));
  out_.fps_n = in_.fps_n, out_.fps_d = in_.fps_d;
  converter_.reset(gst_video_converter_new(&in_, &out_, nullptr));
  if (!converter_) throw UserError("frames of this format cannot be converted to gray");
  caps_.reset(gst_caps_ref(caps));
}

cv::Mat GrayFrames::convert(const DecodedFrame& frame) {
  prepare(frame.caps.get());
  GstVideoFrame in, out;
  if (gst_video_frame_map(&in, &in_, frame.buffer.get(), GST_MAP_READ) == FALSE) return {};
  BufferPointer buffer(gst_buffer_new_allocate(nullptr, out_.size, nullptr));
  if (gst_video_frame_map(&out, &out_, buffer.get(), GST_MAP_WRITE) == FALSE) {
    gst_video_frame_unmap(&in);
    return {};
  }
  gst_video_converter_frame(converter_.get(), &in, &out);
  const cv::Mat view(out_.height, out_.width, CV_8UC1, GST_VIDEO_FRAME_PLANE_DATA(&out, 0),
                     static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&out, 0)));
  cv::Mat image = view.clone();
  gst_video_frame_unmap(&out);
  gst_video_frame_unmap(&in);
  return image;
}

void GrayFrames::rectify_as(const StereoCalibration& calibration, Rectifier::Side side) {
  rectifier_.emplace(calibration, side);
}

cv::Mat GrayFrames::at(std::int64_t number) {
  if (number < 0 || number >= static_cast<std::int64_t>(index_.times.size())) return {};
  const auto known = kept_.find(number);
  if (known != kept_.end()) return known->second;
  const DecodedFrame frame = reader_->read(number);
  cv::Mat image = frame.state == FrameState::kDecoded ? convert(frame) : cv::Mat();
  if (rectifier_) image = rectifier_->apply(image);
  if (kept_.size() >= kKept) {
    // Frames are asked for in increasing order, so the farthest one is the oldest.
    const bool first =
        std::abs(kept_.begin()->first - number) >= std::abs(kept_.rbegin()->first - number);
    kept_.erase(first ? kept_.begin() : std::prev(kept_.end()));
  }
  kept_.emplace(number, image);
  return image;
}

}  // namespace mtstereo::run
