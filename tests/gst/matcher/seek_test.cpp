// SPDX-License-Identifier: LGPL-2.1-or-later
// Seeks in two files whose key frames and lengths differ: no pair is wrong.
#include <gst/app/gstappsrc.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <mutex>

#include "support/numbered_views.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test {
namespace {

constexpr int kLeftFrames = 60;
constexpr int kRightFrames = 57;

/// A container format.
struct Container {
  const char* name;
  const char* muxer;
  const char* demuxer;
};
constexpr Container kMatroska = {"Matroska", "matroskamux", "matroskademux"};
constexpr Container kMp4 = {"Mp4", "mp4mux", "qtdemux"};

void PrintTo(const Container& container, std::ostream* stream) { *stream << container.name; }

std::string missing_element() {
  for (const char* name : {"x264enc", "avdec_h264", "h264parse", "matroskamux", "qtdemux"}) {
    GstElement* element = gst_element_factory_make(name, nullptr);
    if (element == nullptr) return name;
    gst_object_unref(element);
  }
  return "";
}

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

/// A seek in steps of frames.
struct Seek {
  double rate = 1;
  int flags = 0;
  int from = 0;
  int to = -1;  ///< -1: the end
  bool flush = true;
};

/// Plays two files without a clock and counts the maps.
class Player {
 public:
  Player(const std::string& left, const std::string& right, const Container& container)
      : pipeline_("mtstereo name=m max-disparity=64 threads=1 ! fakesink sync=false" +
                  source(left, "sink_left", container) + source(right, "sink_right", container)) {
    GstPad* output = gst_element_get_static_pad(pipeline_.named("m"), "src");
    gst_pad_add_probe(output, GST_PAD_PROBE_TYPE_BUFFER, on_map, this, nullptr);
    gst_pad_add_probe(output, GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM, on_event, this, nullptr);
    gst_object_unref(output);
    pipeline_.set_state(GST_STATE_PAUSED);
    EXPECT_TRUE(pipeline_.wait_until_settled());
    pipeline_.set_state(GST_STATE_PLAYING);
  }
  ~Player() { pipeline_.set_state(GST_STATE_NULL); }

  /// Seeks, and plays at least `maps` maps or to the end of the segment.
  DifferenceCounter play(const Seek& seek, int maps = 1000) {
    GstEvent* event = gst_event_new_seek(
        seek.rate, GST_FORMAT_TIME,
        static_cast<GstSeekFlags>((seek.flush ? GST_SEEK_FLAG_FLUSH : GST_SEEK_FLAG_NONE) |
                                  seek.flags),
        GST_SEEK_TYPE_SET, time_of(seek.from), GST_SEEK_TYPE_SET,
        seek.to < 0 ? -1 : time_of(seek.to));
    const guint32 seqnum = gst_event_get_seqnum(event);
    DifferenceCounter before = count();
    EXPECT_TRUE(gst_element_send_event(pipeline_.element(), event));
    wait(seqnum, before.maps + maps);
    const DifferenceCounter after = count();
    return {after.maps - before.maps, after.wrong - before.wrong, after.unknown - before.unknown};
  }

 private:
  static gint64 time_of(int frame) { return static_cast<gint64>(frame) * kFrame; }
  static std::string source(const std::string& file, const char* pad, const Container& container) {
    return " filesrc location=" + file + " ! " + container.demuxer +
           " ! h264parse ! avdec_h264 max-threads=1 ! queue max-size-buffers=2 ! m." + pad;
  }
  static GstPadProbeReturn on_map(GstPad*, GstPadProbeInfo* info, gpointer self) {
    auto& player = *static_cast<Player*>(self);
    const auto difference = frame_difference(GST_PAD_PROBE_INFO_BUFFER(info));
    const std::lock_guard<std::mutex> lock(player.mutex_);
    player.count_.add(difference);
    return GST_PAD_PROBE_OK;
  }
  /// Demuxers post the message of the end of a segment before its last frames are decoded, so the
  /// event counts.
  static GstPadProbeReturn on_event(GstPad*, GstPadProbeInfo* info, gpointer self) {
    GstEvent* event = GST_PAD_PROBE_INFO_EVENT(info);
    if (GST_EVENT_TYPE(event) != GST_EVENT_EOS && GST_EVENT_TYPE(event) != GST_EVENT_SEGMENT_DONE) {
      return GST_PAD_PROBE_OK;
    }
    auto& player = *static_cast<Player*>(self);
    const std::lock_guard<std::mutex> lock(player.mutex_);
    player.ended_ = gst_event_get_seqnum(event);
    return GST_PAD_PROBE_OK;
  }
  bool ended(guint32 seqnum) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ == seqnum;
  }
  DifferenceCounter count() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }
  /// Waits for that number of maps, or the end of the segment that follows this seek.
  void wait(guint32 seqnum, int maps) {
    GstBus* bus = gst_element_get_bus(pipeline_.element());
    const gint64 end = g_get_monotonic_time() + 30 * G_USEC_PER_SEC;
    while (!ended(seqnum) && count().maps < maps) {
      const MessagePointer error(
          gst_bus_timed_pop_filtered(bus, 2 * GST_MSECOND, GST_MESSAGE_ERROR));
      if (!error && g_get_monotonic_time() < end) continue;
      ADD_FAILURE() << (error ? "error" : "neither maps nor the end of the segment");
      break;
    }
    gst_object_unref(bus);
  }

  std::mutex mutex_;
  DifferenceCounter count_;
  guint32 ended_ = GST_SEQNUM_INVALID;  // of the last end of the stream or a segment
  Pipeline pipeline_;
};

class Seeks : public testing::TestWithParam<Container> {
 protected:
  static void SetUpTestSuite() {
    if (!missing_element().empty()) return;
    std::string pattern = (std::filesystem::temp_directory_path() / "mtstereo-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    for (const Container& container : {kMatroska, kMp4}) {
      encode(file(container, Side::kLeft), container, Side::kLeft, kLeftFrames, 15);
      encode(file(container, Side::kRight), container, Side::kRight, kRightFrames, 40);
    }
  }
  static void TearDownTestSuite() {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
    folder_.clear();
  }
  void SetUp() override {
    if (folder_.empty()) GTEST_SKIP() << "there is no " << missing_element();
    player = std::make_unique<Player>(file(GetParam(), Side::kLeft), file(GetParam(), Side::kRight),
                                      GetParam());
  }
  /// All seeks of a list, each to the end of the segment.
  void play(const std::vector<Seek>& seeks) {
    for (const Seek& seek : seeks) {
      const DifferenceCounter count = player->play(seek);
      const int end = std::min(seek.to < 0 ? kRightFrames : seek.to, kRightFrames);
      // In reverse some demuxers begin at a key frame.
      const bool key_frames = seek.rate < 0 && (seek.flags & GST_SEEK_FLAG_KEY_UNIT) != 0;
      const int least = key_frames ? 30 : end - seek.from - 1;
      const auto text = "rate " + std::to_string(seek.rate) + " flags " +
                        std::to_string(seek.flags) + " from " + std::to_string(seek.from) + " to " +
                        std::to_string(seek.to) + ": " + std::to_string(count.maps) + " maps";
      EXPECT_EQ(count.wrong, 0) << text;
      EXPECT_EQ(count.unknown, 0) << text;
      EXPECT_GE(count.maps, least) << text;
    }
  }

  std::unique_ptr<Player> player;

 private:
  static std::string file(const Container& container, Side side) {
    return folder_ + "/" + container.name + (side == Side::kLeft ? "-left" : "-right");
  }
  static inline std::string folder_;
};

TEST_P(Seeks, ToKeyFrames) {
  const int flags = GST_SEEK_FLAG_KEY_UNIT;
  play({{1, flags, 5},
        {1, flags, 16},
        {1, flags, 20},
        {1, flags, 44},
        {1, flags, 31},
        {1, flags, 50},
        {1, flags, 0},
        {1, flags | GST_SEEK_FLAG_SNAP_BEFORE, 38}});
}

TEST_P(Seeks, ToTheNearestOrNextKeyFrame) {
  for (const int snap : {GST_SEEK_FLAG_SNAP_AFTER, GST_SEEK_FLAG_SNAP_NEAREST}) {
    for (const int from : {3, 12, 20, 33, 38}) {
      const Seek seek = {1, GST_SEEK_FLAG_KEY_UNIT | snap, from};
      const DifferenceCounter count = player->play(seek);
      EXPECT_EQ(count.wrong + count.unknown, 0) << "frame " << from << ", flags " << snap;
      EXPECT_GE(count.maps, kRightFrames - 45 - 1) << "frame " << from << ", flags " << snap;
    }
  }
}

TEST_P(Seeks, WhilePlaying) {
  for (int i = 0; i < 24; ++i) {
    const int flags = i % 3 == 2 ? GST_SEEK_FLAG_ACCURATE : GST_SEEK_FLAG_KEY_UNIT;
    const int from = i * 17 % 48;
    const DifferenceCounter count = player->play({i % 4 == 3 ? 2.0 : 1.0, flags, from}, 3);
    EXPECT_EQ(count.wrong + count.unknown, 0) << "seek " << i << " to frame " << from;
    EXPECT_GE(count.maps, 3) << "seek " << i << " to frame " << from;
  }
}

TEST_P(Seeks, WithoutAFlush) {
  // Each stream plays a few more frames of the old segment than the other one.
  for (int i = 0; i < 24; ++i) {
    const int from = i * 17 % 40;
    const int flags = i % 2 == 0 ? GST_SEEK_FLAG_KEY_UNIT : GST_SEEK_FLAG_ACCURATE;
    player->play({.from = (from + 20) % 40}, 4 + i % 3);
    const DifferenceCounter count = player->play(
        {.rate = i % 4 == 3 ? 2.0 : 1.0, .flags = flags, .from = from, .flush = false}, 15);
    EXPECT_EQ(count.wrong + count.unknown, 0) << "seek " << i << " to frame " << from;
    EXPECT_GE(count.maps, 10) << "seek " << i << " to frame " << from;
  }
}

TEST_P(Seeks, ToExactPositions) {
  const int flags = GST_SEEK_FLAG_ACCURATE;
  play({{1, flags, 0}, {1, flags, 7}, {1, flags, 16}, {1, flags, 41}, {1, flags, 52}});
}

TEST_P(Seeks, OfSegments) {
  for (const int kind : {GST_SEEK_FLAG_ACCURATE, GST_SEEK_FLAG_KEY_UNIT}) {
    const int flags = kind | GST_SEEK_FLAG_SEGMENT;
    play({{1, flags, 4, 30}, {1, flags, 20, 50}, {1, flags, 42, 55}});
  }
}

TEST_P(Seeks, AtDoubleRate) {
  for (const int flags : {GST_SEEK_FLAG_ACCURATE, GST_SEEK_FLAG_KEY_UNIT}) {
    play({{2, flags, 0}, {2, flags, 20}, {2, flags, 44}, {0.5, flags, 33}});
  }
}

TEST_P(Seeks, Backward) {
  for (const int flags : {0, int{GST_SEEK_FLAG_ACCURATE}, int{GST_SEEK_FLAG_KEY_UNIT}}) {
    play({{-1, flags, 0, kLeftFrames}, {-1, flags, 0}, {-1, flags, 0, 50}, {-2, flags, 0, 33}});
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Seeks, testing::Values(kMatroska, kMp4),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace mtstereo::test
