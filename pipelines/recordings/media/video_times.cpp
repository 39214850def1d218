// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/video_times.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

constexpr double kUsualRate = 30;
// A video with fewer frames is decoded as a whole: the start and the end of a longer one are.
constexpr std::size_t kShortVideo = 300;  // frames
constexpr std::size_t kStart = 60;        // frames, at least
constexpr Nanoseconds kBefore = kSecond;  // that a seek to the end begins earlier

// Of these, each frame of the file is one frame that is shown.
constexpr std::array<std::string_view, 8> kPlainCodecs{
    "video/x-h264", "video/x-h265", "image/jpeg",     "image/png",
    "video/x-ffv",  "video/x-raw",  "video/x-prores", "video/x-huffyuv"};
// The first ones of them refer to other frames.
constexpr std::span<const std::string_view> kIntraCodecs = std::span(kPlainCodecs).subspan(2);

bool has_codec_of(std::span<const std::string_view> codecs, const VideoTimes& coded) {
  return std::find(codecs.begin(), codecs.end(), coded.format.media) != codecs.end();
}

Nanoseconds usual_step(const VideoFormat& format) {
  return std::llround(kSecond / (format.frame_rate > 0 ? format.frame_rate : kUsualRate));
}

// A frame without a time follows its predecessor by a period.
void add(VideoTimes& video, const VideoFrame& frame, const VideoFormat& format) {
  const bool first = video.times.empty();
  const Nanoseconds step = usual_step(format);
  const Nanoseconds time = frame.time.value_or(first ? 0 : video.times.back() + step);
  if (!frame.time || (frame.discontinuous && !first)) video.complete = false;
  if (!frame.time) ++video.untimed;
  if (frame.decoding_time) video.decoding_times.push_back(*frame.decoding_time);
  ++video.frames;
  if (frame.keyframe) video.keyframes.push_back(time);
  video.times.push_back(time);
}

// Equal times: only the first frame with a time can be selected by it.
void put_in_order(VideoTimes& video) {
  for (std::vector<Nanoseconds>* times : {&video.times, &video.keyframes}) {
    std::sort(times->begin(), times->end());
    const auto end = std::unique(times->begin(), times->end());
    if (end != times->end()) video.complete = false;
    times->erase(end, times->end());
  }
}

// Whether the decoder shows the first frames of the file, up to some after the second keyframe.
bool start_is_shown(const fs::path& file, const VideoTimes& video) {
  std::size_t count = kStart;
  if (video.keyframes.size() > 1) {
    const auto second =
        std::lower_bound(video.times.begin(), video.times.end(), video.keyframes[1]);
    count = std::max(count, static_cast<std::size_t>(second - video.times.begin()) + kStart / 2);
  }
  VideoScan scan(file, Reading::kDecoded);
  for (std::size_t i = 0; i < std::min(count, video.times.size()); ++i) {
    const std::optional<VideoFrame> frame = scan.next();
    if (!frame || frame->time != video.times[i]) return false;
  }
  return true;
}

// Whether the decoder shows the last frames, from the last keyframe but one on.
bool end_is_shown(const fs::path& file, const VideoTimes& video) {
  const std::size_t keyframes = video.keyframes.size();
  const Nanoseconds from = video.keyframes[keyframes < 2 ? 0 : keyframes - 2];
  VideoScan scan(file, Reading::kDecoded);
  if (!scan.next() || !scan.seek(std::max<Nanoseconds>(from - kBefore, 0))) return false;
  auto expected = std::lower_bound(video.times.begin(), video.times.end(), from);
  while (const std::optional<VideoFrame> frame = scan.next()) {
    if (frame->time && *frame->time < from) continue;
    if (expected == video.times.end() || frame->time != *expected) return false;
    ++expected;
  }
  return expected == video.times.end();
}

}  // namespace

VideoTimes read_times(const fs::path& file, Reading reading) {
  VideoScan scan(file, reading);
  VideoTimes video;
  while (const std::optional<VideoFrame> frame = scan.next()) {
    add(video, *frame, scan.format());
  }
  video.format = scan.format();
  video.error = scan.error();
  video.video_streams = scan.video_streams();
  video.starts_with_keyframe = scan.starts_with_keyframe();
  put_in_order(video);
  return video;
}

bool has_plain_codec(const VideoTimes& coded) { return has_codec_of(kPlainCodecs, coded); }

bool has_intra_codec(const VideoTimes& coded) { return has_codec_of(kIntraCodecs, coded); }

bool parser_suffices(const fs::path& file, const VideoTimes& coded) {
  if (!coded.complete || !coded.error.empty() || !has_plain_codec(coded)) return false;
  if (coded.times.size() < kShortVideo || coded.keyframes.empty()) return false;
  return start_is_shown(file, coded) && end_is_shown(file, coded);
}

}  // namespace mtstereo::run
