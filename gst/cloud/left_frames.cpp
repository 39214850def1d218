// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/left_frames.hpp"

#include <utility>

namespace mtstereo::plugin {

void LeftFrames::set_timeout(Duration timeout) {
  const std::lock_guard lock(mutex_);
  timeout_ = timeout;
}

GstFlowReturn LeftFrames::push(LeftFrame frame) {
  std::unique_lock lock(mutex_);
  const auto may_add = [this] { return !full() || flushing_ || finished_ || no_maps_; };
  while (!may_add()) {
    const unsigned maps = maps_;
    const bool held = held_;
    const auto changed = [&] { return may_add() || held_ != held || maps_ != maps; };
    if (held) {
      changed_.wait(lock, changed);
    } else if (!changed_.wait_for(lock, timeout_, changed)) {
      no_maps_ = true;
    }
  }
  if (flushing_) return GST_FLOW_FLUSHING;
  if (finished_) return GST_FLOW_OK;
  if (full()) frames_.pop_front();
  frames_.push_back(std::move(frame));
  no_frames_ = false;
  changed_.notify_all();
  return GST_FLOW_OK;
}

void LeftFrames::skip_to(Nanoseconds time) {
  const std::lock_guard lock(mutex_);
  reached_ = time;
  changed_.notify_all();
}

void LeftFrames::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

void LeftFrames::set_flushing(bool flushing) {
  const std::lock_guard lock(mutex_);
  flushing_ = flushing;
  frames_.clear();
  reached_.reset();
  ended_ = no_frames_ = no_maps_ = false;
  changed_.notify_all();
}

void LeftFrames::drop_before(Nanoseconds time) {
  const auto is_older = [&](const LeftFrame& frame) {
    return frame.time && *frame.time + kSameTime < time;
  };
  while (!frames_.empty() && is_older(frames_.front())) frames_.pop_front();
}

bool LeftFrames::none_will_come(std::optional<Nanoseconds> time) const {
  const bool in_gap = reached_ && time && *reached_ > *time + kSameTime;
  return ended_ || in_gap || no_frames_;
}

LeftFrames::Outcome LeftFrames::find(std::optional<Nanoseconds> time, LeftFrame& frame) {
  std::unique_lock lock(mutex_);
  ++maps_;
  no_maps_ = false;
  const auto end = std::chrono::steady_clock::now() + timeout_;
  for (;;) {
    if (time) drop_before(*time);
    changed_.notify_all();
    if (interrupted_) return Outcome::kInterrupted;
    if (!frames_.empty()) break;
    if (none_will_come(time)) return Outcome::kNone;
    const auto changed = [&] { return interrupted_ || !frames_.empty() || none_will_come(time); };
    if (!changed_.wait_until(lock, end, changed)) no_frames_ = true;
  }
  const std::optional<Nanoseconds> first = frames_.front().time;
  if (time && first && *first > *time + kSameTime) return Outcome::kNone;
  frame = std::move(frames_.front());
  frames_.pop_front();
  return Outcome::kFound;
}

void LeftFrames::hold(bool held) {
  const std::lock_guard lock(mutex_);
  held_ = held;
  changed_.notify_all();
}

void LeftFrames::interrupt(bool interrupted) {
  const std::lock_guard lock(mutex_);
  interrupted_ = interrupted;
  changed_.notify_all();
}

void LeftFrames::finish(bool finished) {
  const std::lock_guard lock(mutex_);
  finished_ = finished;
  if (finished) frames_.clear();
  changed_.notify_all();
}

}  // namespace mtstereo::plugin
