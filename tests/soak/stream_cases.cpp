// SPDX-License-Identifier: LGPL-2.1-or-later
// Streams that end, lose frames, arrive late, and pads that are linked again.
#include <algorithm>
#include <array>
#include <thread>

#include "soak.hpp"

namespace mtstereo::soak {
namespace {

/// Two sequences, and what is expected of them.
struct Streams {
  std::vector<test::NumberedFrame> left;
  std::vector<test::NumberedFrame> right;
  test::FeedOptions options;
};

/// Numbers of frames that both streams have.
std::size_t common_frames(const Streams& streams) {
  return static_cast<std::size_t>(std::count_if(
      streams.left.begin(), streams.left.end(), [&](const test::NumberedFrame& frame) {
        return std::any_of(
            streams.right.begin(), streams.right.end(),
            [&](const test::NumberedFrame& other) { return other.number == frame.number; });
      }));
}

void lose_some(Random& random, double share, std::vector<test::NumberedFrame>& frames) {
  std::erase_if(frames, [&](const test::NumberedFrame&) { return random.chance(share); });
}

/// Moves each time stamp by up to `most`, in order.
void add_jitter(Random& random, GstClockTime most, std::vector<test::NumberedFrame>& frames) {
  for (test::NumberedFrame& frame : frames) {
    frame.pts += static_cast<GstClockTime>(random.between(0, static_cast<std::int64_t>(most)));
  }
}

/// Plays the streams and counts what came out. A wrong pair is excused by a warning.
test::FeedResult play(Soak& soak, const std::string& kind, const Streams& streams) {
  test::FeedResult result;
  result = test::feed(streams.left, streams.right, streams.options);
  soak.count(kind, [&](Counts& counts) {
    ++counts.cases;
    counts.operations += streams.left.size() + streams.right.size();
    counts.maps += static_cast<std::uint64_t>(result.count.maps);
    counts.unreadable += static_cast<std::uint64_t>(result.count.unknown);
    (result.warnings.empty() ? counts.wrong : counts.warned) +=
        static_cast<std::uint64_t>(result.count.wrong);
  });
  if (!result.error.empty()) soak.fail(kind, result.error);
  return result;
}

Streams lossy_streams(Random& random, int frames, double loss, GstClockTime jitter) {
  Streams streams;
  streams.left = test::numbered_sequence(frames);
  streams.right = test::numbered_sequence(frames);
  lose_some(random, loss, streams.left);
  lose_some(random, loss, streams.right);
  add_jitter(random, jitter, streams.left);
  add_jitter(random, jitter, streams.right);
  streams.options.properties = "max-disparity=64 threads=1";
  streams.options.timeout = 120;
  return streams;
}

/// The right camera sends nothing for a while.
void stop_camera(Random& random, std::vector<test::NumberedFrame>& frames) {
  if (frames.size() < 10) return;
  const auto first = random.between(2, static_cast<std::int64_t>(frames.size()) - 6);
  const auto last = random.between(first, static_cast<std::int64_t>(frames.size()) - 2);
  frames.erase(frames.begin() + first, frames.begin() + last);
}

}  // namespace

void end_streams(Soak& soak) {
  Random& random = soak.random;
  Streams streams = lossy_streams(random, static_cast<int>(random.between(1, 40)), 0, 0);
  auto& shorter = random.chance(0.5) ? streams.left : streams.right;
  shorter.resize(
      static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(shorter.size()))));
  soak.within(180, "ends of streams", "play to the end", [&] {
    const test::FeedResult result = play(soak, "ends of streams", streams);
    if (result.maps.size() != common_frames(streams)) {
      soak.fail("ends of streams", std::to_string(result.maps.size()) + " maps of " +
                                       std::to_string(common_frames(streams)) + " pairs");
    }
  });
}

void lose_frames(Soak& soak) {
  // Four elements at a time, each with its own choices.
  soak.within(300, "loss and jitter", "play to the end", [&] {
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&soak, seed = soak.random.seed()] {
        Random random(seed);
        const double loss = static_cast<double>(random.between(0, 20)) / 100;
        const auto jitter = static_cast<GstClockTime>(random.between(0, 8'000'000));
        const Streams streams = lossy_streams(random, 120, loss, jitter);
        const test::FeedResult result = play(soak, "loss and jitter", streams);
        if (result.maps.size() * 10 < common_frames(streams) * 9) {
          soak.fail("loss and jitter", std::to_string(result.maps.size()) + " maps of " +
                                           std::to_string(common_frames(streams)) + " pairs");
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  });
}

void play_live(Soak& soak) {
  soak.within(120, "live streams", "play to the end", [&] {
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; ++i) {
      threads.emplace_back([&soak, seed = soak.random.seed()] {
        Random random(seed);
        Streams streams = lossy_streams(random, 60, random.chance(0.5) ? 0.1 : 0,
                                        static_cast<GstClockTime>(random.between(0, 6'000'000)));
        if (random.chance(0.3)) {
          stop_camera(random, random.chance(0.5) ? streams.left : streams.right);
        }
        for (test::NumberedFrame& frame : streams.right) {
          frame.arrival = frame.pts + static_cast<GstClockTime>(random.between(0, 15'000'000));
        }
        streams.options.live = true;
        constexpr std::array kTails = {"fakesink sync=false", "fakesink sync=true",
                                       "queue ! fakesink sync=true qos=true",
                                       "queue ! mtcolor ! fakesink sync=true qos=true"};
        streams.options.tail = random.one_of(kTails);
        play(soak, "live streams", streams);
      });
    }
    for (std::thread& thread : threads) thread.join();
  });
}

namespace {

/// Pushes numbered frames until it is stopped, and then the end of the stream.
class EndlessSource {
 public:
  EndlessSource(GstElement* source, Side side)
      : source_(source), thread_([this, side] { push(side); }) {}
  ~EndlessSource() {
    stop();
    thread_.join();
  }
  EndlessSource(const EndlessSource&) = delete;
  EndlessSource& operator=(const EndlessSource&) = delete;
  void stop() { stop_ = true; }

 private:
  void push(Side side) {
    GstFlowReturn flow = GST_FLOW_OK;
    for (int i = 0; !stop_ && flow == GST_FLOW_OK; ++i) {
      GstBuffer* buffer =
          test::numbered_frame(side, i, static_cast<GstClockTime>(i) * test::kFrame);
      g_signal_emit_by_name(source_, "push-buffer", buffer, &flow);
      gst_buffer_unref(buffer);
    }
    g_signal_emit_by_name(source_, "end-of-stream", &flow);
  }

  GstElement* source_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

GstPadProbeReturn relink(GstPad* pad, GstPadProbeInfo*, gpointer done) {
  GstPad* peer = gst_pad_get_peer(pad);
  if (peer != nullptr) {
    gst_pad_unlink(pad, peer);
    g_usleep(2000);
    gst_pad_link(pad, peer);
    gst_object_unref(peer);
  }
  *static_cast<std::atomic<bool>*>(done) = true;
  return GST_PAD_PROBE_REMOVE;
}

}  // namespace

void relink_pads(Soak& soak) {
  const std::string kind = "pads linked again";
  Random& random = soak.random;
  const std::string caps = test::raw_caps("GRAY8", test::kNumberedWidth, test::kNumberedHeight);
  const std::string source = " format=time block=true max-buffers=4 max-bytes=0 caps=" + caps;
  CheckedPipeline pipeline(soak, kind,
                           "mtstereo name=m max-disparity=64 threads=1 ! fakesink name=out "
                           "sync=false appsrc name=left" +
                               source + " ! queue name=ql ! m.sink_left appsrc name=right" +
                               source + " ! queue name=qr ! m.sink_right",
                           true);
  soak.count(kind, [](Counts& counts) { ++counts.cases; });
  pipeline.set_state(GST_STATE_PLAYING);
  EndlessSource left(pipeline.named("left"), Side::kLeft);
  EndlessSource right(pipeline.named("right"), Side::kRight);
  for (int i = 0; i < 10 && !pipeline.failed(); ++i) {
    g_usleep(static_cast<gulong>(random.between(0, 20'000)));
    GstElement* queue = pipeline.named(random.chance(0.5) ? "ql" : "qr");
    GstPad* pad = gst_element_get_static_pad(queue, "src");
    std::atomic<bool> done{false};
    gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_IDLE, relink, &done, nullptr);
    soak.within(60, kind, "link a pad again", [&] {
      while (!done && !pipeline.failed()) g_usleep(1000);
    });
    gst_object_unref(pad);
    soak.count(kind, [](Counts& counts) { ++counts.operations; });
  }
  const std::uint64_t before = pipeline.maps();
  soak.within(60, kind, "maps after a pad was linked again", [&] {
    while (pipeline.maps() < before + 5 && !pipeline.failed()) g_usleep(1000);
  });
  left.stop();
  right.stop();
  pipeline.wait_for_end("the end of the stream");
  if (pipeline.failed()) soak.fail(kind, pipeline.error());
  pipeline.set_state(GST_STATE_NULL);  // releases a push that waits
}

}  // namespace mtstereo::soak
