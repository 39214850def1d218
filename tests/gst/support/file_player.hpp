// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <array>
#include <atomic>
#include <mutex>
#include <string>

#include "support/numbered_views.hpp"
#include "support/pipeline.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::test {

/// A container format.
struct Container {
  const char* name;
  const char* muxer;
  const char* demuxer;
};
inline constexpr Container kMatroska = {"Matroska", "matroskamux", "matroskademux"};
inline constexpr Container kMp4 = {"Mp4", "mp4mux", "qtdemux"};

void PrintTo(const Container& container, std::ostream* stream);

/// An element that file_player needs and that is not installed; "" if all are.
std::string missing_element();

/// Numbered views of two files in a temporary folder, as H.264: kLeftFrames with a key frame every
/// 15, and kRightFrames with one every 40.
class NumberedFiles {
 public:
  static constexpr int kLeftFrames = 60;
  static constexpr int kRightFrames = 57;

  NumberedFiles();

  std::string file(const Container& container, Side side) const;

 private:
  TemporaryFolder folder_;
};

/// A seek in steps of frames.
struct Seek {
  double rate = 1;
  int flags = 0;
  int from = 0;
  int to = -1;  ///< -1: the end
  bool flush = true;
};

/// "rate 2 flags 4 from 3 to -1"
std::string seek_text(const Seek& seek);

/// Plays the two files without a clock and counts the maps.
class FilePlayer {
 public:
  FilePlayer(const NumberedFiles& files, const Container& container);
  ~FilePlayer();
  FilePlayer(const FilePlayer&) = delete;
  FilePlayer& operator=(const FilePlayer&) = delete;

  GstElement* matcher() const { return pipeline_.named("m"); }
  /// Seeks, and plays at least `maps` maps or to the end of the segment. Maps after a warning are
  /// not counted as wrong.
  DifferenceCounter play(const Seek& seek, int maps = 1000);
  /// From now on, this share of the frames of one side is lost: always the same frames.
  void lose(Side side, double share) { lost_[static_cast<std::size_t>(side)] = share; }
  /// From the next seek on, the right stream is delayed by this number of frames.
  void delay_right(int frames);
  /// A warning was posted since the last seek.
  bool warned() const { return warned_; }

 private:
  static GstPadProbeReturn on_map(GstPad*, GstPadProbeInfo* info, gpointer self);
  static GstPadProbeReturn on_event(GstPad*, GstPadProbeInfo* info, gpointer self);
  static GstPadProbeReturn on_frame(GstPad* pad, GstPadProbeInfo* info, gpointer self);
  static GstBusSyncReply on_message(GstBus*, GstMessage* message, gpointer self);
  void begin_count(guint32 after_flush);
  bool ended(guint32 seqnum);
  DifferenceCounter count();
  void wait(guint32 seqnum, int maps);

  std::array<std::atomic<double>, 2> lost_{};
  std::atomic<bool> warned_ = false;
  std::atomic<int> delay_ = 0;  // of the right stream [frames]
  std::mutex mutex_;
  DifferenceCounter count_;
  guint32 awaited_flush_ = GST_SEQNUM_INVALID;  // maps are not counted before its end
  guint32 ended_ = GST_SEQNUM_INVALID;          // of the last end of the stream or a segment
  Pipeline pipeline_;
};

}  // namespace mtstereo::test
