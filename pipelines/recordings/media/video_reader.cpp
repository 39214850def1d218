// SPDX-License-Identifier: LGPL-2.1-or-later

// Frames of a video by their numbers: after a seek a frame is recognized by its time.

#include <gst/video/video.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "recordings/media/frame_reader.hpp"
#include "recordings/media/video_scan.hpp"

namespace mtstereo::run {
namespace {

constexpr std::int64_t kFar = 64;  // a seek takes less time than decoding so many frames

// How far before a frame a seek aims: the one after a seek that found no key frame before it.
constexpr std::array<Nanoseconds, 3> kLead{0, 5 * kSecond, 30 * kSecond};

// Decoders of lossless gray video state no matrix of colors: converters would take gray for red.
CapsPointer with_usual_matrix(GstCaps* caps) {
  GstVideoInfo info;
  if (gst_video_info_from_caps(&info, caps) == FALSE || !GST_VIDEO_INFO_IS_GRAY(&info) ||
      info.colorimetry.matrix != GST_VIDEO_COLOR_MATRIX_UNKNOWN) {
    return CapsPointer(gst_caps_ref(caps));
  }
  CapsPointer usual(gst_caps_copy(caps));
  gst_structure_remove_field(gst_caps_get_structure(usual.get(), 0), "colorimetry");
  return usual;
}

class VideoReader : public FrameReader {
 public:
  VideoReader(std::filesystem::path file, const FrameIndex& index)
      : file_(std::move(file)), index_(index) {}

  DecodedFrame read(std::int64_t number) override {
    if (!scan_) start(number);
    if (number >= next_ && (index_.by_order || number - next_ <= kFar)) return forward(number);
    for (const Nanoseconds lead : kLead) {
      if (index_.by_order || !seek(number, lead)) continue;
      DecodedFrame frame = forward(number);
      if (frame.state == FrameState::kDecoded && !is_corrupt(frame)) return frame;
    }
    start(number);
    return forward(number);
  }

  const std::string& problem() const override { return problem_; }

  std::vector<DamagedFrame> take_damaged() override {
    std::vector<DamagedFrame> frames = std::exchange(damaged_, {});
    if (!scan_ || next_ == 0) return frames;
    const auto last = std::min(static_cast<std::size_t>(next_), index_.times.size()) - 1;
    for (DamagedFrame& frame : scan_->take_damaged_until(index_.times[last])) {
      if (!frame.time || *frame.time >= first_) frames.push_back(std::move(frame));
    }
    return frames;
  }

 private:
  // A frame that was decoded, but not asked for yet.
  struct Waiting {
    BufferPointer buffer;
    CapsPointer caps;
    std::optional<Nanoseconds> time;
  };

  // Starts at the first frame. Damage of those before `wanted` does not count.
  void start(std::int64_t wanted) {
    damaged_ = take_damaged();
    waiting_ = {};
    scan_.reset();
    scan_ = std::make_unique<VideoScan>(file_, Reading::kDecoded);
    next_ = 0;
    from_start_ = true;
    first_ = index_.times[static_cast<std::size_t>(wanted)];
  }

  bool seek(std::int64_t number, Nanoseconds lead) {
    const Nanoseconds wanted = index_.times[static_cast<std::size_t>(number)];
    const Nanoseconds target = wanted - lead;
    // Reading from the start takes no longer, and is reliable.
    if (target <= index_.times.front()) return false;
    waiting_ = {};
    from_start_ = false;
    return scan_->seek(target, wanted);
  }

  Waiting next_frame() {
    const std::optional<VideoFrame> frame = scan_->next();
    if (!frame) return {};
    GstSample* const sample = scan_->sample();
    return {BufferPointer(gst_buffer_ref(gst_sample_get_buffer(sample))),
            usual_caps(gst_sample_get_caps(sample)), frame->time};
  }

  // All frames between two changes of the caps have the same object.
  CapsPointer usual_caps(GstCaps* caps) {
    if (caps != decoded_caps_.get()) {
      decoded_caps_.reset(gst_caps_ref(caps));
      usual_caps_ = with_usual_matrix(caps);
    }
    return CapsPointer(gst_caps_ref(usual_caps_.get()));
  }

  // Decodes up to a frame.
  DecodedFrame forward(std::int64_t number) {
    DecodedFrame result;
    for (;;) {
      if (!waiting_.buffer) waiting_ = next_frame();
      if (!waiting_.buffer) {
        problem_ = scan_->error();
        return result;
      }
      const std::optional<std::int64_t> found = number_of(waiting_);
      if (!found) return result;
      if (*found > number) {
        result.state = FrameState::kMissing;
        problem_ = scan_->error();
        return result;
      }
      Waiting frame = std::exchange(waiting_, {});
      next_ = *found + 1;
      if (*found == number) return decoded(std::move(frame));
    }
  }

  static DecodedFrame decoded(Waiting frame) {
    DecodedFrame result;
    result.state = FrameState::kDecoded;
    result.caps = std::move(frame.caps);
    result.buffer = std::move(frame.buffer);
    return result;
  }

  // The number of a frame. From the start it is known even if the time is not in the index.
  std::optional<std::int64_t> number_of(const Waiting& frame) const {
    if (index_.by_order) return next_;
    const std::optional<std::int64_t> by_time = frame.time ? number_at(*frame.time) : std::nullopt;
    if (!from_start_) return by_time;
    return by_time && *by_time >= next_ ? by_time : std::optional(next_);
  }

  // The frame whose time is this one, up to a quarter of the distance to the next frame.
  std::optional<std::int64_t> number_at(Nanoseconds time) const {
    const std::vector<Nanoseconds>& times = index_.times;
    const auto after = std::lower_bound(times.begin(), times.end(), time);
    auto nearest = after;
    if (after == times.end() ||
        (after != times.begin() && time - *std::prev(after) < *after - time)) {
      nearest = std::prev(after);
    }
    Nanoseconds gap = index_.period > 0 ? index_.period : kSecond;
    if (nearest != times.begin()) gap = std::min(gap, *nearest - *std::prev(nearest));
    if (std::next(nearest) != times.end()) gap = std::min(gap, *std::next(nearest) - *nearest);
    if (std::abs(*nearest - time) > gap / 4) return std::nullopt;
    return nearest - times.begin();
  }

  static bool is_corrupt(const DecodedFrame& frame) {
    return GST_BUFFER_FLAG_IS_SET(frame.buffer.get(), GST_BUFFER_FLAG_CORRUPTED);
  }

  std::filesystem::path file_;
  const FrameIndex& index_;
  std::unique_ptr<VideoScan> scan_;
  Waiting waiting_;
  CapsPointer decoded_caps_, usual_caps_;  // of the last frame, as decoded and as it is given
  std::int64_t next_ = 0;                  // the frame after the last one that was decoded
  bool from_start_ = true;                 // since the start of the file no seek took place
  Nanoseconds first_ = 0;                  // the time of the frame for which it was started
  std::string problem_;
  std::vector<DamagedFrame> damaged_;  // before the last start
};

}  // namespace

std::unique_ptr<FrameReader> open_video(const std::filesystem::path& file,
                                        const FrameIndex& index) {
  return std::make_unique<VideoReader>(file, index);
}

std::unique_ptr<FrameReader> open_reader(const Source& source, const FrameIndex& index) {
  return source.video.empty() ? open_images(source.images, source.unused_bits)
                              : open_video(source.video, index);
}

}  // namespace mtstereo::run
