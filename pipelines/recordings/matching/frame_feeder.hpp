// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/piece.hpp"
#include "recordings/media/damage_notes.hpp"
#include "recordings/media/frame_reader.hpp"

namespace mtstereo::run {

/// Decodes pairs of a recording in a thread of its own, and pushes them into the sources `left` and
/// `right`, or `both`, of the lanes of a pipeline, in turn. The pair n gets the time n * period.
class FrameFeeder {
 public:
  /// The numbers of the pairs; they increase.
  FrameFeeder(const Work& work, std::vector<std::int64_t> pairs, const Pipeline& pipeline,
              int lanes);
  /// The pipeline must be stopped before: a source that is full blocks the thread.
  ~FrameFeeder();
  FrameFeeder(const FrameFeeder&) = delete;
  FrameFeeder& operator=(const FrameFeeder&) = delete;

  /// Starts the thread. `earlier`: the notes of an interrupted run, for damage().
  void start(std::vector<DamageNote> earlier);
  /// Asks the thread to end after the current pair.
  void stop() { stopped_ = true; }
  /// Throws what the thread has thrown.
  void check();
  /// Why pairs are missing or not as they were coded; empty if all are whole. After the end of the
  /// pipeline's streams.
  std::string damage();
  /// The notes up to this pair, but those of earlier calls.
  std::vector<DamageNote> take_notes(std::int64_t pair);

 private:
  // Where the frames of a lane go.
  struct Target {
    ElementPointer source;
    CapsPointer caps;  // as decoded
  };
  struct Side {
    std::unique_ptr<FrameReader> reader;
    std::vector<Target> targets;  // one for each lane
    std::string title;            // for messages
    int width = 0, height = 0;
  };
  void run() noexcept;
  void feed();
  bool feed_pair(std::int64_t pair);
  bool push(Side& side, DecodedFrame frame, std::int64_t pair) const;
  void note(const Side& side, std::int64_t frame, FrameState state);
  void note_damage(std::int64_t pair);
  UserError other_size(const Side& side, const GstVideoInfo& info, std::int64_t pair) const;
  void set_caps(const Side& side, Target& target, const DecodedFrame& frame,
                std::int64_t pair) const;

  const Work& work_;
  std::vector<std::int64_t> pairs_;
  std::vector<Side> sides_;
  std::size_t lanes_, lane_ = 0;  // the lane of the next pair
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::exception_ptr failure_;     // guarded by mutex_
  std::string missing_;            // pairs; guarded by mutex_
  std::vector<DamageNote> notes_;  // guarded by mutex_
  std::size_t taken_ = 0;          // of these; guarded by mutex_
  std::thread thread_;
};

}  // namespace mtstereo::run
