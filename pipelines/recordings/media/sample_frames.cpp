// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/sample_frames.hpp"

#include <gst/gst.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "lib/images/images.hpp"
#include "lib/media/decoding_problem.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/media/container.hpp"
#include "recordings/media/video_scan.hpp"
#include "shared/orientation.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

constexpr int kStored = cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION;

cv::Mat next_frame(VideoScan& scan) {
  std::optional<VideoFrame> frame = scan.next();
  const VideoFormat& format = scan.format();
  if (!frame || frame->pixels.empty()) return {};
  return cv::Mat(format.height, format.width, CV_8UC1, frame->pixels.data()).clone();
}

// The matcher refuses such video, too; files have another remedy than streams.
void refuse_interlaced(const fs::path& file, const GstCaps* caps) {
  const gchar* mode = gst_structure_get_string(gst_caps_get_structure(caps, 0), "interlace-mode");
  if (mode == nullptr || std::string_view(mode) == "progressive") return;
  throw UserError(file.string() +
                  ": the video is interlaced, and its two fields are from different times: "
                  "deinterlace it (ffmpeg -i FILE -vf bwdif=0 -c:v ffv1 view.mkv)");
}

std::vector<cv::Mat> frames_of_video(const fs::path& file, int count) {
  VideoScan scan(file, Reading::kGray);
  std::vector<cv::Mat> frames{next_frame(scan)};
  if (frames.front().empty()) {
    std::error_code error;
    if (fs::file_size(file, error) == 0) throw UserError(file.string() + ": the file is empty");
    const std::string missing = missing_end(file);
    std::string reason = scan.error().empty() ? "it has no frame" : scan.error();
    if (!missing.empty()) reason += " (" + missing + ")";
    throw UserError(file.string() + ": the video cannot be read: " + reason);
  }
  refuse_interlaced(file, gst_sample_get_caps(scan.sample()));
  if (const std::string turning = scan.turning(); !turning.empty()) {
    throw UserError(file.string() + ": " + plugin::turning_problem(turning));
  }
  const std::optional<Nanoseconds> duration = count > 1 ? scan.duration() : std::nullopt;
  for (int i = 1; i < count && duration; ++i) {
    if (!scan.seek(*duration * i / count)) break;
    cv::Mat frame = next_frame(scan);
    if (frame.empty()) break;
    frames.push_back(std::move(frame));
  }
  return frames;
}

cv::Mat gray_image(const fs::path& image, int unused_bits) {
  if (unused_bits == 0) return images::read(image, kStored);
  const cv::Mat read = images::read(image, kStored | cv::IMREAD_ANYDEPTH);
  cv::Mat frame;
  constexpr double kTo8Bits = 1.0 / 256;
  without_unused_bits(read, unused_bits).convertTo(frame, CV_8U, kTo8Bits);
  return frame;
}

std::vector<cv::Mat> frames_of_images(const Source& source, int count) {
  const std::vector<fs::path>& images = source.images;
  std::vector<cv::Mat> frames;
  const auto wanted = std::min(static_cast<std::size_t>(count), images.size());
  for (std::size_t i = 0; i < wanted; ++i) {
    const fs::path& image = images[i * images.size() / wanted];
    cv::Mat frame = gray_image(image, source.unused_bits);
    if (frame.empty()) throw UserError(media::unreadable_image(image));
    if (i == 0) images::refuse_turned(image);
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace

cv::Mat first_frame(const Source& source) { return sample_frames(source, 1).front(); }

std::vector<cv::Mat> sample_frames(const Source& source, int count) {
  if (source.empty()) throw UserError("there is no source");
  return source.video.empty() ? frames_of_images(source, count)
                              : frames_of_video(source.video, count);
}

}  // namespace mtstereo::run
