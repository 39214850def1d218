// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/sample_frames.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>

#include "lib/outputs/user_error.hpp"
#include "recordings/media/container.hpp"
#include "recordings/media/video_scan.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

cv::Mat next_frame(VideoScan& scan) {
  std::optional<VideoFrame> frame = scan.next();
  const VideoFormat& format = scan.format();
  if (!frame || frame->pixels.empty()) return {};
  return cv::Mat(format.height, format.width, CV_8UC1, frame->pixels.data()).clone();
}

std::vector<cv::Mat> frames_of_video(const fs::path& file, int count) {
  VideoScan scan(file, Reading::kGray);
  std::vector<cv::Mat> frames{next_frame(scan)};
  if (frames.front().empty()) {
    const std::string missing = missing_end(file);
    std::string reason = scan.error().empty() ? "it has no frame" : scan.error();
    if (!missing.empty()) reason += " (" + missing + ")";
    throw UserError(file.string() + ": the video cannot be read: " + reason);
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

std::vector<cv::Mat> frames_of_images(const std::vector<fs::path>& images, int count) {
  std::vector<cv::Mat> frames;
  const auto wanted = std::min(static_cast<std::size_t>(count), images.size());
  for (std::size_t i = 0; i < wanted; ++i) {
    const fs::path& image = images[i * images.size() / wanted];
    cv::Mat frame = cv::imread(image.string(), cv::IMREAD_GRAYSCALE);
    if (frame.empty()) throw UserError(image.string() + ": the image cannot be read");
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace

cv::Mat first_frame(const Source& source) { return sample_frames(source, 1).front(); }

std::vector<cv::Mat> sample_frames(const Source& source, int count) {
  if (source.empty()) throw UserError("there is no source");
  return source.video.empty() ? frames_of_images(source.images, count)
                              : frames_of_video(source.video, count);
}

}  // namespace mtstereo::run
