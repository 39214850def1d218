// SPDX-License-Identifier: LGPL-2.1-or-later

// Frames from images.

#include <gst/app/gstappsrc.h>
#include <gst/video/video.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/images/images.hpp"
#include "recordings/media/frame_reader.hpp"
#include "recordings/media/jpeg_check.hpp"
#include "recordings/media/sample_frames.hpp"

namespace mtstereo::run {
namespace {

DecodedFrame missing() {
  DecodedFrame frame;
  frame.state = FrameState::kMissing;
  return frame;
}

// JPEG by the decoder of pipelines: its luma is that of the file.
class JpegDecoder {
 public:
  JpegDecoder()
      // With a frame rate the decoder takes each buffer as one image.
      : pipeline_(parse_pipeline("appsrc name=in caps=image/jpeg,framerate=30000/1001 ! jpegdec ! "
                                 "appsink name=out sync=false enable-last-sample=false")),
        in_(element_of(pipeline_, "in")),
        out_(element_of(pipeline_, "out")) {
    gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
  }

  DecodedFrame decode(const std::string& bytes, std::string& problem) {
    constexpr int kAttempts = 50;
    GstBuffer* const buffer = gst_buffer_new_memdup(bytes.data(), bytes.size());
    GST_BUFFER_PTS(buffer) = 0;
    gst_app_src_push_buffer(GST_APP_SRC(in_.get()), buffer);
    SamplePointer sample;
    for (int i = 0; i < kAttempts && !sample; ++i) {
      const Taken taken = take_sample(out_.get(), sample);
      problem = posted_error(pipeline_);
      if (taken == Taken::kEnd || !problem.empty()) break;
    }
    if (!sample) {
      problem = problem.empty() ? "it is not a whole JPEG file"
                                : "it is broken, or of a kind that is not decoded, such as CMYK: "
                                  "convert it to PNG (" +
                                      problem + ")";
      return missing();
    }
    DecodedFrame frame;
    frame.state = FrameState::kDecoded;
    frame.caps.reset(gst_caps_ref(gst_sample_get_caps(sample.get())));
    frame.buffer.reset(gst_buffer_ref(gst_sample_get_buffer(sample.get())));
    return frame;
  }

 private:
  Pipeline pipeline_;
  ElementPointer in_, out_;
};

// The format of an image of OpenCV; unknown if GStreamer has none.
GstVideoFormat format_of(const cv::Mat& image) {
  constexpr bool kLittle = G_BYTE_ORDER == G_LITTLE_ENDIAN;
  switch (image.type()) {
    case CV_8UC1:
      return GST_VIDEO_FORMAT_GRAY8;
    case CV_8UC3:
      return GST_VIDEO_FORMAT_BGR;
    case CV_8UC4:
      return GST_VIDEO_FORMAT_BGRA;
    case CV_16UC1:
      return kLittle ? GST_VIDEO_FORMAT_GRAY16_LE : GST_VIDEO_FORMAT_GRAY16_BE;
    case CV_16UC3:
    case CV_16UC4:
      return kLittle ? GST_VIDEO_FORMAT_BGRA64_LE : GST_VIDEO_FORMAT_BGRA64_BE;
    default:
      return GST_VIDEO_FORMAT_UNKNOWN;
  }
}

// GStreamer has no format of three channels with 16 bits.
cv::Mat with_alpha(const cv::Mat& image) {
  if (image.type() != CV_16UC3) return image;
  cv::Mat result(image.size(), CV_16UC4);
  for (int y = 0; y < image.rows; ++y) {
    const auto* from = image.ptr<cv::Vec3w>(y);
    auto* to = result.ptr<cv::Vec4w>(y);
    for (int x = 0; x < image.cols; ++x) to[x] = {from[x][0], from[x][1], from[x][2], 0xffff};
  }
  return result;
}

DecodedFrame frame_of(const cv::Mat& decoded, int unused_bits) {
  const cv::Mat image = with_alpha(without_unused_bits(decoded, unused_bits));
  const GstVideoFormat format = format_of(image);
  if (image.empty() || format == GST_VIDEO_FORMAT_UNKNOWN) return missing();
  GstVideoInfo info;
  gst_video_info_set_format(&info, format, static_cast<guint>(image.cols),
                            static_cast<guint>(image.rows));
  DecodedFrame frame;
  frame.state = FrameState::kDecoded;
  frame.caps.reset(gst_video_info_to_caps(&info));
  frame.buffer.reset(gst_buffer_new_allocate(nullptr, info.size, nullptr));
  for (int y = 0; y < image.rows; ++y) {
    gst_buffer_fill(frame.buffer.get(), static_cast<gsize>(y) * info.stride[0], image.ptr(y),
                    static_cast<gsize>(image.cols) * image.elemSize());
  }
  return frame;
}

class ImageReader : public FrameReader {
 public:
  ImageReader(std::vector<std::filesystem::path> files, int unused_bits)
      : files_(std::move(files)), unused_bits_(unused_bits) {}

  DecodedFrame read(std::int64_t number) override {
    const std::filesystem::path& file = files_[static_cast<std::size_t>(number)];
    problem_ = "it cannot be read";
    DecodedFrame frame = files::is_jpeg(file) ? read_jpeg(file) : read_other(file);
    if (frame.state == FrameState::kMissing) problem_ = file.string() + ": " + problem_;
    return frame;
  }

  const std::string& problem() const override { return problem_; }

  std::vector<DamagedFrame> take_damaged() override { return std::exchange(damaged_, {}); }

 private:
  DecodedFrame read_jpeg(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!bytes.starts_with("\xff\xd8")) {
      problem_ = "it is not a JPEG file";
      return missing();
    }
    if (!jpeg_) jpeg_ = std::make_unique<JpegDecoder>();
    DecodedFrame frame = jpeg_->decode(bytes, problem_);
    if (frame.state == FrameState::kMissing) jpeg_.reset();
    const std::string damage = damage_of_jpeg(bytes);
    if (frame.state == FrameState::kDecoded && !damage.empty()) {
      damaged_.push_back({std::nullopt, file.string() + ": " + damage});
    }
    return frame;
  }

  DecodedFrame read_other(const std::filesystem::path& file) const {
    return frame_of(images::read(file, cv::IMREAD_UNCHANGED), unused_bits_);
  }

  std::vector<std::filesystem::path> files_;
  int unused_bits_;
  std::unique_ptr<JpegDecoder> jpeg_;
  std::string problem_;
  std::vector<DamagedFrame> damaged_;
};

}  // namespace

cv::Mat without_unused_bits(const cv::Mat& image, int unused_bits) {
  if (unused_bits == 0 || image.depth() != CV_16U) return image;
  cv::Mat result;
  image.convertTo(result, CV_16U, 1 << unused_bits);
  return result;
}

std::unique_ptr<FrameReader> open_images(const std::vector<std::filesystem::path>& files,
                                         int unused_bits) {
  return std::make_unique<ImageReader>(files, unused_bits);
}

}  // namespace mtstereo::run
