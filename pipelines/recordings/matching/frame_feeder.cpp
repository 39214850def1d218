// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/frame_feeder.hpp"

#include <gst/app/gstappsrc.h>

#include <future>
#include <utility>

#include "recordings/matching/matching_line.hpp"

namespace mtstereo::run {

FrameFeeder::FrameFeeder(const Work& work, std::vector<std::int64_t> pairs,
                         const Pipeline& pipeline, int lanes)
    : work_(work), pairs_(std::move(pairs)), lanes_(static_cast<std::size_t>(lanes)) {
  const bool two = work.recording.arrangement == Arrangement::kTwoSources;
  const auto add = [&](const Source& source, const FrameIndex& index, const char* name) {
    Side side;
    side.reader = open_reader(source, index);
    for (int lane = 0; lane < lanes; ++lane) {
      side.targets.push_back({element_of(pipeline, lane_name(name, lane)), nullptr});
    }
    side.title = title_of_side(static_cast<int>(sides_.size()), two);
    side.width = index.width;
    side.height = index.height;
    sides_.push_back(std::move(side));
  };
  add(work.recording.left, work.left, two ? "left" : "both");
  if (two) add(work.recording.right, work.right, "right");
}

FrameFeeder::~FrameFeeder() {
  stopped_ = true;
  if (thread_.joinable()) thread_.join();
}

void FrameFeeder::start(std::vector<DamageNote> earlier) {
  notes_ = std::move(earlier);
  taken_ = notes_.size();
  thread_ = std::thread([this] { run(); });
}

void FrameFeeder::check() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

std::string FrameFeeder::damage() {
  const std::lock_guard lock(mutex_);
  std::string damage = missing_;
  add_damage(damage, damage_text(notes_, sides_.size() == 2));
  return damage;
}

std::vector<DamageNote> FrameFeeder::take_notes(std::int64_t pair) {
  const std::lock_guard lock(mutex_);
  std::vector<DamageNote> notes;
  for (; taken_ < notes_.size() && notes_[taken_].pair <= pair; ++taken_) {
    notes.push_back(notes_[taken_]);
  }
  return notes;
}

void FrameFeeder::run() noexcept {
  try {
    feed();
    note_damage(pairs_.empty() ? 0 : pairs_.back());
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
  for (const Side& side : sides_) {
    for (const Target& target : side.targets) {
      gst_app_src_end_of_stream(GST_APP_SRC(target.source.get()));
    }
  }
}

void FrameFeeder::feed() {
  for (const std::int64_t pair : pairs_) {
    if (stopped_ || !feed_pair(pair)) return;
  }
}

// False after the last pair that can be decoded.
bool FrameFeeder::feed_pair(std::int64_t pair) {
  const FramePair& frames = work_.pairs.pairs[static_cast<std::size_t>(pair)];
  const bool two = sides_.size() == 2;
  std::future<DecodedFrame> reading;
  if (two) {
    reading = std::async(std::launch::async,
                         [this, &frames] { return sides_[1].reader->read(frames.right); });
  }
  std::vector<DecodedFrame> decoded;
  decoded.push_back(sides_[0].reader->read(frames.left));
  if (two) decoded.push_back(reading.get());
  note_damage(pair);
  bool complete = true, more = true;
  for (std::size_t i = 0; i < decoded.size(); ++i) {
    if (decoded[i].state == FrameState::kDecoded) continue;
    note(sides_[i], i == 0 ? frames.left : frames.right, decoded[i].state);
    complete = false;
    more = more && decoded[i].state == FrameState::kMissing;
  }
  if (!complete) return more;
  for (std::size_t i = 0; i < decoded.size(); ++i) {
    if (!push(sides_[i], std::move(decoded[i]), pair)) return false;
  }
  lane_ = (lane_ + 1) % lanes_;
  return true;
}

// The first frame that is missing is reported, and where the frames end.
void FrameFeeder::note(const Side& side, std::int64_t frame, FrameState state) {
  const FrameIndex& index = &side == &sides_.front() ? work_.left : work_.right;
  const std::lock_guard lock(mutex_);
  if (!missing_.empty() && state == FrameState::kMissing) return;
  std::string text = "frame " + std::to_string(frame) + " of the " + side.title + " (" +
                     seconds_text(index.times[static_cast<std::size_t>(frame)]) + ")" +
                     (state == FrameState::kEnd ? " and all after it" : "") + " cannot be decoded";
  if (!side.reader->problem().empty()) text += ": " + side.reader->problem();
  add_damage(missing_, text);
}

// What the decoders had to conceal.
void FrameFeeder::note_damage(std::int64_t pair) {
  for (std::size_t side = 0; side < sides_.size(); ++side) {
    for (DamagedFrame& frame : sides_[side].reader->take_damaged()) {
      const std::lock_guard lock(mutex_);
      if (notes_.size() >= kMostNotes) return;
      notes_.push_back({pair, static_cast<int>(side), std::move(frame)});
    }
  }
}

UserError FrameFeeder::other_size(const Side& side, const GstVideoInfo& info,
                                  std::int64_t pair) const {
  const FramePair& frames = work_.pairs.pairs[static_cast<std::size_t>(pair)];
  const bool first = &side == &sides_.front();
  const Source& source = first ? work_.recording.left : work_.recording.right;
  const auto number = static_cast<std::size_t>(first ? frames.left : frames.right);
  const bool images = source.video.empty();
  return UserError(side.title + ": its frames change from " + std::to_string(side.width) + "x" +
                   std::to_string(side.height) +
                   (images ? " (" + source.images.front().string() + ")" : "") + " to " +
                   std::to_string(info.width) + "x" + std::to_string(info.height) + " px (" +
                   (images ? source.images[number].string() : "frame " + std::to_string(number)) +
                   "): give frames of one size only" +
                   (images ? ", such as by a pattern, or the folder of both views" : ""));
}

void FrameFeeder::set_caps(const Side& side, Target& target, const DecodedFrame& frame,
                           std::int64_t pair) const {
  GstVideoInfo info;
  if (gst_video_info_from_caps(&info, frame.caps.get()) == FALSE) {
    throw UserError(side.title + ": the decoder gives no raw video");
  }
  if (side.width > 0 && (info.width != side.width || info.height != side.height)) {
    throw other_size(side, info, pair);
  }
  gint numerator = 0, denominator = 1;
  gst_video_guess_framerate(static_cast<GstClockTime>(work_.period), &numerator, &denominator);
  const CapsPointer caps(gst_caps_copy(frame.caps.get()));
  gst_caps_set_simple(caps.get(), "framerate", GST_TYPE_FRACTION, numerator, denominator, nullptr);
  gst_app_src_set_caps(GST_APP_SRC(target.source.get()), caps.get());
  target.caps.reset(gst_caps_ref(frame.caps.get()));
}

bool FrameFeeder::push(Side& side, DecodedFrame frame, std::int64_t pair) const {
  Target& target = side.targets[lane_];
  if (!target.caps || gst_caps_is_equal(target.caps.get(), frame.caps.get()) == FALSE) {
    set_caps(side, target, frame, pair);
  }
  GstBuffer* const buffer = gst_buffer_make_writable(frame.buffer.release());
  GST_BUFFER_PTS(buffer) = static_cast<GstClockTime>(pair * work_.period);
  GST_BUFFER_DTS(buffer) = GST_CLOCK_TIME_NONE;
  GST_BUFFER_DURATION(buffer) = static_cast<GstClockTime>(work_.period);
  GST_BUFFER_FLAG_UNSET(buffer, GST_BUFFER_FLAG_DISCONT);
  return gst_app_src_push_buffer(GST_APP_SRC(target.source.get()), buffer) == GST_FLOW_OK;
}

}  // namespace mtstereo::run
