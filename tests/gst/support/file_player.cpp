// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/file_player.hpp"

#include <gst/app/gstappsrc.h>
#include <gtest/gtest.h>

#include <cstring>
#include <ostream>

namespace mtstereo::test {
namespace {

/// Writes numbered views as H.264 with a key frame every `key_interval` frames.
void encode(const std::string& file, const Container& container, Side side, int frames,
            int key_interval) {
  Pipeline pipeline(
      "appsrc name=in format=time caps=" + raw_caps("GRAY8", kNumberedWidth, kNumberedHeight) +
      " ! videoconvert ! video/x-raw,format=I420 ! x264enc quantizer=24 pass=quant "
      "tune=zerolatency speed-preset=ultrafast threads=1 option-string=scenecut=0 "
      "key-int-max=" +
      std::to_string(key_interval) + " ! h264parse ! " + container.muxer +
      " ! filesink location=" + file);
  pipeline.set_state(GST_STATE_PLAYING);
  auto* source = GST_APP_SRC(pipeline.named("in"));
  for (int i = 0; i < frames; ++i) {
    gst_app_src_push_buffer(source, numbered_frame(side, i, static_cast<GstClockTime>(i) * kFrame));
  }
  gst_app_src_end_of_stream(source);
  EXPECT_EQ(pipeline.wait_for_end(), "");
}

std::string source(const std::string& file, const char* side, const Container& container) {
  return " filesrc location=" + file + " ! " + container.demuxer +
         " ! h264parse ! avdec_h264 name=" + side +
         " max-threads=1 ! queue max-size-buffers=2 ! m.sink_" + side;
}

gint64 time_of(int frame) { return static_cast<gint64>(frame) * kFrame; }

/// A number from 0 to 1 that looks random and is always the same for this frame.
double chance_of(GstClockTime pts) {
  const std::uint64_t mixed = (pts / (kFrame / 2) + 7) * 0x9e3779b97f4a7c15u;
  return static_cast<double>((mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9u >> 11) * 0x1p-53;
}

}  // namespace

void PrintTo(const Container& container, std::ostream* stream) { *stream << container.name; }

std::string missing_element() {
  for (const char* name : {"x264enc", "avdec_h264", "h264parse", "matroskamux", "qtdemux"}) {
    GstElement* element = gst_element_factory_make(name, nullptr);
    if (element == nullptr) return name;
    gst_object_unref(element);
  }
  return "";
}

NumberedFiles::NumberedFiles() {
  for (const Container& container : {kMatroska, kMp4}) {
    encode(file(container, Side::kLeft), container, Side::kLeft, kLeftFrames, 15);
    encode(file(container, Side::kRight), container, Side::kRight, kRightFrames, 40);
  }
}

std::string NumberedFiles::file(const Container& container, Side side) const {
  return folder_ / (std::string(container.name) + (side == Side::kLeft ? "-left" : "-right"));
}

std::string seek_text(const Seek& seek) {
  return "rate " + std::to_string(seek.rate) + " flags " + std::to_string(seek.flags) + " from " +
         std::to_string(seek.from) + " to " + std::to_string(seek.to);
}

FilePlayer::FilePlayer(const NumberedFiles& files, const Container& container)
    : pipeline_(std::string("mtstereo name=m ") + kNumberedMatching + " ! fakesink sync=false" +
                source(files.file(container, Side::kLeft), "left", container) +
                source(files.file(container, Side::kRight), "right", container)) {
  GstPad* output = gst_element_get_static_pad(pipeline_.named("m"), "src");
  gst_pad_add_probe(output, GST_PAD_PROBE_TYPE_BUFFER, on_map, this, nullptr);
  gst_pad_add_probe(output,
                    static_cast<GstPadProbeType>(GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM |
                                                 GST_PAD_PROBE_TYPE_EVENT_FLUSH),
                    on_event, this, nullptr);
  gst_object_unref(output);
  for (const char* side : {"left", "right"}) {
    GstPad* decoded = gst_element_get_static_pad(pipeline_.named(side), "src");
    gst_pad_add_probe(decoded, GST_PAD_PROBE_TYPE_BUFFER, on_frame, this, nullptr);
    gst_object_unref(decoded);
  }
  GstBus* bus = gst_element_get_bus(pipeline_.element());
  gst_bus_set_sync_handler(bus, on_message, this, nullptr);
  gst_object_unref(bus);
  pipeline_.set_state(GST_STATE_PAUSED);
  EXPECT_TRUE(pipeline_.wait_until_settled());
  pipeline_.set_state(GST_STATE_PLAYING);
}

FilePlayer::~FilePlayer() { pipeline_.set_state(GST_STATE_NULL); }

DifferenceCounter FilePlayer::play(const Seek& seek, int maps) {
  GstEvent* event =
      gst_event_new_seek(seek.rate, GST_FORMAT_TIME,
                         static_cast<GstSeekFlags>(
                             (seek.flush ? GST_SEEK_FLAG_FLUSH : GST_SEEK_FLAG_NONE) | seek.flags),
                         GST_SEEK_TYPE_SET, time_of(seek.from), GST_SEEK_TYPE_SET,
                         seek.to < 0 ? -1 : time_of(seek.to));
  const guint32 seqnum = gst_event_get_seqnum(event);
  begin_count(seek.flush ? seqnum : GST_SEQNUM_INVALID);
  EXPECT_TRUE(gst_element_send_event(pipeline_.element(), event));
  wait(seqnum, maps);
  return count();
}

/// Counts from here on, or from the end of that flush on: before it, maps of the old segment still
/// come.
void FilePlayer::begin_count(guint32 after_flush) {
  const std::lock_guard<std::mutex> lock(mutex_);
  awaited_flush_ = after_flush;
  warned_ = false;
  count_ = {};
}

void FilePlayer::delay_right(int frames) {
  GstPad* pad = gst_element_get_static_pad(pipeline_.named("m"), "sink_right");
  gst_pad_set_offset(pad, time_of(frames));
  gst_object_unref(pad);
  delay_ = frames;
}

GstPadProbeReturn FilePlayer::on_map(GstPad*, GstPadProbeInfo* info, gpointer self) {
  auto& player = *static_cast<FilePlayer*>(self);
  auto difference = frame_difference(GST_PAD_PROBE_INFO_BUFFER(info));
  if (difference) *difference += player.delay_;
  const std::lock_guard<std::mutex> lock(player.mutex_);
  if (player.awaited_flush_ == GST_SEQNUM_INVALID)
    player.count_.add(player.warned_ ? 0 : difference);
  return GST_PAD_PROBE_OK;
}

/// Demuxers post the message of the end of a segment before its last frames are decoded, so the
/// event counts.
GstPadProbeReturn FilePlayer::on_event(GstPad*, GstPadProbeInfo* info, gpointer self) {
  GstEvent* event = GST_PAD_PROBE_INFO_EVENT(info);
  auto& player = *static_cast<FilePlayer*>(self);
  const std::lock_guard<std::mutex> lock(player.mutex_);
  switch (GST_EVENT_TYPE(event)) {
    case GST_EVENT_FLUSH_STOP:
      if (gst_event_get_seqnum(event) != player.awaited_flush_) break;
      player.awaited_flush_ = GST_SEQNUM_INVALID;
      player.warned_ = false;
      break;
    case GST_EVENT_EOS:
    case GST_EVENT_SEGMENT_DONE:
      player.ended_ = gst_event_get_seqnum(event);
      break;
    default:
      break;
  }
  return GST_PAD_PROBE_OK;
}

GstPadProbeReturn FilePlayer::on_frame(GstPad* pad, GstPadProbeInfo* info, gpointer self) {
  const auto& player = *static_cast<const FilePlayer*>(self);
  const bool left = std::strcmp(GST_OBJECT_NAME(GST_OBJECT_PARENT(pad)), "left") == 0;
  const double share = player.lost_[left ? 0 : 1];
  return chance_of(GST_BUFFER_PTS(GST_PAD_PROBE_INFO_BUFFER(info))) < share ? GST_PAD_PROBE_DROP
                                                                            : GST_PAD_PROBE_OK;
}

GstBusSyncReply FilePlayer::on_message(GstBus*, GstMessage* message, gpointer self) {
  if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_WARNING) {
    static_cast<FilePlayer*>(self)->warned_ = true;
  }
  return GST_BUS_PASS;
}

bool FilePlayer::ended(guint32 seqnum) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return ended_ == seqnum;
}

DifferenceCounter FilePlayer::count() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return count_;
}

/// Waits for that number of maps, or the end of the segment that follows this seek.
void FilePlayer::wait(guint32 seqnum, int maps) {
  GstBus* bus = gst_element_get_bus(pipeline_.element());
  const gint64 end = g_get_monotonic_time() + 30 * G_USEC_PER_SEC;
  while (!ended(seqnum) && count().maps < maps) {
    const MessagePointer error(gst_bus_timed_pop_filtered(bus, 2 * GST_MSECOND, GST_MESSAGE_ERROR));
    if (!error && g_get_monotonic_time() < end) continue;
    ADD_FAILURE() << (error ? "error" : "neither maps nor the end of the segment");
    break;
  }
  gst_object_unref(bus);
}

}  // namespace mtstereo::test
