// SPDX-License-Identifier: LGPL-2.1-or-later
// A sequence of operations on an mtstereo that plays: frames with any size, meta, time stamp and
// flag on both pads, events, queries, properties, states. Whatever happens, the element must end
// its output when both inputs end, or post an error with a cause, and free everything.
#include <gst/video/video.h>

#include <optional>
#include <set>

#include "fuzz_gst.hpp"
#include "fuzz_input.hpp"
#include "stream_worker.hpp"

namespace mtstereo::fuzz {
namespace {

constexpr std::array kCaps = {
    "video/x-raw,format=GRAY8,width=32,height=16,framerate=30/1",
    "video/x-raw,format=GRAY8,width=33,height=9,framerate=25/1",
    "video/x-raw,format=I420,width=32,height=16,framerate=30/1",
    "video/x-raw,format=NV12,width=32,height=16,framerate=0/1",
    "video/x-raw,format=GRAY8,width=32,height=16,framerate=30/1,interlace-mode=interleaved",
    "video/x-raw,format=YUY2,width=32,height=16,framerate=30/1",
    "video/x-raw,format=RGB,width=32,height=16,framerate=30/1",
    "video/x-raw,format=GRAY16_LE,width=32,height=16,framerate=30/1",
    "video/x-raw,format=GRAY8,width=1,height=1,framerate=2147483647/1",
    "video/x-raw(meta:GstVideoOverlayComposition),format=GRAY8,width=32,height=16,framerate=30/1",
    "video/x-raw(memory:GLMemory),format=GRAY8,width=32,height=16,framerate=30/1",
    "video/x-bayer,format=bggr,width=32,height=16,framerate=30/1"};

constexpr std::array kProperties = {"preset=fast",
                                    "preset=paper",
                                    "preset=default",
                                    "mode=sparse",
                                    "mode=dense",
                                    "max-disparity=1",
                                    "max-disparity=300",
                                    "max-disparity=8",
                                    "disparity-scale=1",
                                    "disparity-scale=256",
                                    "disparity-scale=65535",
                                    "sync-tolerance=-1",
                                    "sync-tolerance=0",
                                    "qos=false",
                                    "sync-tolerance=9223372036854775807",
                                    "latency=0",
                                    "latency=40000000",
                                    "latency=9223372036854775807",
                                    "threads=2",
                                    "threads=1",
                                    "census-kernel-size=2",
                                    "census-kernel-size=3",
                                    "confidence-map=false",
                                    "alignment=off",
                                    "alignment=correct",
                                    "alignment=hold",
                                    "right-blur=1.5",
                                    "alignment-field=1,0,0,0,0",
                                    "alignment-field=x",
                                    "alignment-interval=1"};

/// A time that is near the usual ones, or far from all.
GstClockTime time_of(FuzzInput& input) {
  constexpr std::array<GstClockTime, 5> kFar = {GST_CLOCK_TIME_NONE, 0, GST_CLOCK_TIME_NONE - 1,
                                                G_MAXINT64, 3600 * GST_SECOND};
  const int kind = input.byte();
  if (kind >= 240) return input.one_of(kFar);
  return static_cast<GstClockTime>(kind % 16) * 33'333'333 + input.byte() * GstClockTime{100'000};
}

/// Adds a video meta that is right, or wrong in one number.
void add_meta(GstBuffer* buffer, const GstVideoInfo& info, FuzzInput& input) {
  gsize offset[GST_VIDEO_MAX_PLANES] = {};
  gint stride[GST_VIDEO_MAX_PLANES] = {};
  for (guint i = 0; i < GST_VIDEO_INFO_N_PLANES(&info); ++i) {
    offset[i] = GST_VIDEO_INFO_PLANE_OFFSET(&info, i);
    stride[i] = GST_VIDEO_INFO_PLANE_STRIDE(&info, i);
  }
  guint width = static_cast<guint>(info.width);
  guint height = static_cast<guint>(info.height);
  auto format = GST_VIDEO_INFO_FORMAT(&info);
  switch (input.byte() % 8) {
    case 0:
      stride[0] = input.between(-300, 300);
      break;
    case 1:
      offset[0] = input.bits(2);
      break;
    case 2:
      width = static_cast<guint>(input.between(0, 40));
      break;
    case 3:
      height = static_cast<guint>(input.between(0, 40));
      break;
    case 4:
      format = static_cast<GstVideoFormat>(input.between(2, 60));
      break;
    default:
      break;
  }
  gst_buffer_add_video_meta_full(buffer, GST_VIDEO_FRAME_FLAG_NONE, format, width, height,
                                 GST_VIDEO_INFO_N_PLANES(&info), offset, stride);
}

class Session {
 public:
  explicit Session(FuzzInput& input) : input_(input), element_("mtstereo") {
    g_object_set(element_.get(), "max-disparity", 8, "threads", 1, nullptr);
    const bool live = input.flag();
    harness_[0] = test::new_harness(element_.get(), "sink_left", "src", live);
    harness_[1] = test::new_harness(element_.get(), "sink_right", nullptr, live);
    for (auto& worker : worker_) worker.emplace();
    if (input.flag()) start_both();
  }

  ~Session() {
    // Stopping the element ends every push that still waits.
    gst_element_set_state(element_.get(), GST_STATE_NULL);
    for (auto& worker : worker_) worker.reset();
    gst_harness_teardown(harness_[1]);
    gst_harness_teardown(harness_[0]);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void run() {
    for (int count = 0; count < 64 && !input_.empty(); ++count) {
      step();
      take_output();
    }
    finish();
  }

 private:
  void start_both() {
    for (std::size_t side = 0; side < 2; ++side) {
      send(side, gst_event_new_stream_start(side == 0 ? "left" : "right"));
      send_caps(side, kCaps[0]);
      send_segment(side, 0, 1);
    }
  }

  /// Does something on a pad in the pad's own thread, which may have to wait.
  void send(std::size_t side, GstEvent* event) {
    GstHarness* harness = harness_[side];
    worker_[side]->run([=] { gst_harness_push_event(harness, event); });
  }

  void send_caps(std::size_t side, const char* text) {
    const CapsPointer caps(gst_caps_from_string(text));
    gst_video_info_init(&info_[side]);
    if (!gst_video_info_from_caps(&info_[side], caps.get())) gst_video_info_init(&info_[side]);
    send(side, gst_event_new_caps(caps.get()));
  }

  void send_segment(std::size_t side, GstClockTime start, double rate) {
    GstSegment segment;
    gst_segment_init(&segment, GST_FORMAT_TIME);
    segment.rate = rate;
    segment.start = GST_CLOCK_TIME_IS_VALID(start) ? start : 0;
    if (rate < 0) segment.stop = segment.start + GST_SECOND;
    has_segment_[side] = true;
    send(side, gst_event_new_segment(&segment));
  }

  /// No frame is sent before the segment: a source must not do that.
  void push_frame(std::size_t side) {
    if (!has_segment_[side]) send_segment(side, 0, 1);
    const GstVideoInfo& info = info_[side];
    gsize size = info.size != 0 ? info.size : 512;
    const int what = input_.byte();
    if (what % 16 == 1) size = input_.bits(2);
    if (what % 16 == 2) size -= size > 0 ? 1 : 0;
    GstBuffer* buffer = pattern_buffer(size, side == 0 ? 1 : what / 128 + 1);
    if (what % 16 == 3) gst_buffer_append(buffer, pattern_buffer(input_.byte(), 3));
    if (what % 16 >= 12 && info.size != 0) add_meta(buffer, info, input_);
    GST_BUFFER_PTS(buffer) = time_of(input_);
    const int more = input_.byte();
    if (more % 4 == 1) GST_BUFFER_DURATION(buffer) = 33'333'333;
    if (more % 4 == 2) GST_BUFFER_DURATION(buffer) = time_of(input_);
    if (more % 64 == 63) GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_GAP);
    if (more % 32 == 31) GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_DISCONT);
    if (more % 16 == 15) GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_CORRUPTED);
    if (side == 0) left_times_.insert(GST_BUFFER_PTS(buffer));
    GstHarness* harness = harness_[side];
    worker_[side]->run([=] { gst_harness_push(harness, buffer); });
  }

  void flush(bool only_one, std::size_t side) {
    GstEvent* start = gst_event_new_flush_start();
    GstEvent* stop = gst_event_new_flush_stop(input_.flag() ? TRUE : FALSE);
    gst_event_set_seqnum(stop, gst_event_get_seqnum(start));
    for (GstEvent* event : {start, stop}) {
      for (std::size_t i = 0; i < 2; ++i) {
        if (only_one && i != side) continue;
        // A flush is not serialized with what waits on the pad: it ends the wait.
        gst_harness_push_event(harness_[i], gst_event_copy(event));
        worker_[i]->settle();
        has_segment_[i] = false;
      }
      gst_event_unref(event);
    }
    const bool restart = input_.flag();
    for (std::size_t i = 0; i < 2 && restart; ++i) send_segment(i, 0, 1);
  }

  void send_other_event(std::size_t side) {
    switch (input_.byte() % 6) {
      case 0:
        return send(side, gst_event_new_segment_done(GST_FORMAT_TIME, input_.byte()));
      case 1:
        return send(side, gst_event_new_tag(gst_tag_list_new_empty()));
      case 2:
        return send(side, gst_event_new_stream_start("again"));
      case 3:
        return send(side, gst_event_new_custom(GST_EVENT_CUSTOM_DOWNSTREAM,
                                               gst_structure_new_empty("custom")));
      case 4: {
        GstSegment bytes;
        gst_segment_init(&bytes, GST_FORMAT_BYTES);
        return send(side, gst_event_new_segment(&bytes));
      }
      default:
        return send(side, gst_event_new_stream_group_done(1));
    }
  }

  void send_upstream() {
    switch (input_.byte() % 4) {
      case 0: {
        const auto late = static_cast<GstClockTimeDiff>(time_of(input_));
        const GstClockTime time = time_of(input_);
        // GStreamer refuses a frame that was shown before the time 0.
        const bool valid =
            late >= 0 || GST_CLOCK_TIME_NONE - static_cast<GstClockTime>(late) < time;
        gst_harness_push_upstream_event(
            harness_[0], gst_event_new_qos(GST_QOS_TYPE_UNDERFLOW, 1.5, valid ? late : 0, time));
        return;
      }
      case 1:
        gst_harness_push_upstream_event(harness_[0], gst_event_new_reconfigure());
        return;
      case 2:
        gst_harness_push_upstream_event(harness_[0], gst_event_new_latency(input_.bits(4)));
        return;
      default:
        gst_harness_push_upstream_event(
            harness_[0],
            gst_event_new_seek(input_.flag() ? 1.0 : -1.0, GST_FORMAT_TIME, GST_SEEK_FLAG_NONE,
                               GST_SEEK_TYPE_SET, 0, GST_SEEK_TYPE_SET, GST_SECOND));
    }
  }

  void query() {
    GstPad* pad = gst_element_get_static_pad(element_.get(), "src");
    gint64 value = 0;
    gst_pad_query_position(pad, GST_FORMAT_TIME, &value);
    gst_pad_query_duration(pad, GST_FORMAT_TIME, &value);
    for (GstQuery* query : {gst_query_new_latency(), gst_query_new_seeking(GST_FORMAT_TIME),
                            gst_query_new_segment(GST_FORMAT_TIME), gst_query_new_formats(),
                            gst_query_new_allocation(nullptr, TRUE)}) {
      gst_pad_query(pad, query);
      gst_query_unref(query);
    }
    gst_object_unref(pad);
  }

  void set_property() {
    const std::string text = input_.one_of(kProperties);
    const std::size_t equals = text.find('=');
    gst_util_set_object_arg(G_OBJECT(element_.get()), text.substr(0, equals).c_str(),
                            text.substr(equals + 1).c_str());
    GstStructure* stats = nullptr;
    g_object_get(element_.get(), "stats", &stats, nullptr);
    require(stats != nullptr, "there are statistics at any time");
    gst_structure_free(stats);
  }

  void change_state() {
    const bool stop = input_.flag();
    gst_element_set_state(element_.get(), stop ? GST_STATE_READY : GST_STATE_PAUSED);
    gst_element_set_state(element_.get(), GST_STATE_PLAYING);
    // A stopped element forgets all events, also the ends of the streams.
    if (stop) start_both();
  }

  void step() {
    const int action = input_.byte();
    const std::size_t side = action / 64 % 2;
    switch (action % 32) {
      case 16:
        return send_caps(side, input_.one_of(kCaps));
      case 17:
        return send_segment(side, time_of(input_), input_.flag() ? 1 : input_.flag() ? -1 : 0.5);
      case 18:
        return send(side,
                    gst_event_new_gap(time_of(input_) % GST_CLOCK_TIME_NONE, time_of(input_)));
      case 19:
        return flush(input_.byte() % 4 == 0, side);
      case 20:
        return send(side, gst_event_new_eos());
      case 21:
        return send_other_event(side);
      case 22:
        return send_upstream();
      case 23:
        return query();
      case 24:
      case 25:
        return set_property();
      case 26:
        return change_state();
      case 27:
        clock_ += input_.byte() * GST_MSECOND;
        gst_harness_set_time(harness_[0], clock_);
        return;
      case 28:
        return start_both();
      default:
        return push_frame(side);
    }
  }

  void take_output() {
    while (const BufferPointer buffer{gst_harness_try_pull(harness_[0])}) {
      require(left_times_.contains(GST_BUFFER_PTS(buffer.get())),
              "a map has the time of a left frame");
      require(gst_buffer_get_size(buffer.get()) > 0, "a map has pixels");
    }
    while (const EventPointer event{gst_harness_try_pull_event(harness_[0])}) {
      if (GST_EVENT_TYPE(event.get()) == GST_EVENT_EOS) ended_ = true;
      if (GST_EVENT_TYPE(event.get()) == GST_EVENT_FLUSH_STOP) ended_ = false;
      if (GST_EVENT_TYPE(event.get()) == GST_EVENT_STREAM_START) ended_ = false;
    }
  }

  /// Ends both streams and waits for the end of the output, or an error.
  void finish() {
    for (std::size_t side = 0; side < 2; ++side) send(side, gst_event_new_eos());
    const gint64 end = g_get_monotonic_time() + 20 * G_TIME_SPAN_SECOND;
    while (!ended_ && !element_.has_failed()) {
      take_output();
      require(g_get_monotonic_time() < end, "the output ends after both inputs");
      g_usleep(50);
    }
  }

  FuzzInput& input_;
  TestedElement element_;
  std::array<GstHarness*, 2> harness_{};
  std::array<GstVideoInfo, 2> info_{};
  std::array<bool, 2> has_segment_{};
  std::array<std::optional<StreamWorker>, 2> worker_;
  std::set<GstClockTime> left_times_;
  GstClockTime clock_ = 0;
  bool ended_ = false;
};

}  // namespace
}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mtstereo::fuzz;
  FuzzInput input(data, size);
  Session session(input);
  session.run();
  return 0;
}
