// SPDX-License-Identifier: LGPL-2.1-or-later
// Feature: seeks
// Seeks and state changes in files, whose key frames and lengths differ.
#include <array>

#include "soak.hpp"

namespace mtstereo::soak {
namespace {

constexpr const char* kSeeks = "seeks in files";
constexpr int kLeftFrames = 120;
constexpr int kRightFrames = 114;
constexpr GstClockTime kEnd = kLeftFrames * test::kFrame;

std::string& files_folder() {
  static std::string folder;
  return folder;
}

/// Numbered views as H.264, a key frame every `key_interval` frames.
void encode(test::Pipeline& pipeline, Side side, int frames) {
  GstElement* source = pipeline.named("in");
  pipeline.set_state(GST_STATE_PLAYING);
  for (int i = 0; i < frames; ++i) {
    GstBuffer* buffer =
        test::numbered_frame(side, i, static_cast<GstClockTime>(i) * test::kFrame, test::kFrame);
    GstFlowReturn flow = GST_FLOW_OK;
    g_signal_emit_by_name(source, "push-buffer", buffer, &flow);
    gst_buffer_unref(buffer);
  }
  GstFlowReturn flow = GST_FLOW_OK;
  g_signal_emit_by_name(source, "end-of-stream", &flow);
}

std::string file_of(Side side) {
  return files_folder() + (side == Side::kLeft ? "/left.mkv" : "/right.mkv");
}

std::string launch_text(const char* tail) {
  const auto source = [](Side side, const char* pad) {
    return " filesrc location=" + file_of(side) +
           " ! matroskademux ! h264parse ! avdec_h264 max-threads=1 ! identity name=" + pad +
           "-loss ! queue ! m." + pad;
  };
  return std::string("mtstereo name=m max-disparity=64 threads=1 ! ") + tail +
         source(Side::kLeft, "sink_left") + source(Side::kRight, "sink_right");
}

GstSeekFlags random_flags(Random& random, bool flush) {
  constexpr std::array kChoices = {
      GST_SEEK_FLAG_ACCURATE,
      GST_SEEK_FLAG_KEY_UNIT,
      GST_SEEK_FLAG_NONE,
      static_cast<GstSeekFlags>(GST_SEEK_FLAG_KEY_UNIT | GST_SEEK_FLAG_SNAP_BEFORE),
      static_cast<GstSeekFlags>(GST_SEEK_FLAG_KEY_UNIT | GST_SEEK_FLAG_SNAP_AFTER),
      static_cast<GstSeekFlags>(GST_SEEK_FLAG_KEY_UNIT | GST_SEEK_FLAG_SNAP_NEAREST)};
  int flags = random.one_of(kChoices);
  if (flush) flags |= GST_SEEK_FLAG_FLUSH;
  if (random.chance(0.15)) flags |= GST_SEEK_FLAG_SEGMENT;
  constexpr std::array kTrickModes = {GST_SEEK_FLAG_TRICKMODE, GST_SEEK_FLAG_TRICKMODE_KEY_UNITS,
                                      GST_SEEK_FLAG_TRICKMODE_NO_AUDIO};
  if (random.chance(0.4)) flags |= random.one_of(kTrickModes);
  return static_cast<GstSeekFlags>(flags);
}

/// Plays the second half after all other seeks: nothing of them may remain.
void play_second_half(Soak& soak, CheckedPipeline& pipeline) {
  constexpr std::uint64_t kLeast = kRightFrames - kLeftFrames / 2 - 3;
  pipeline.set_state(GST_STATE_PAUSED);
  pipeline.forget_end();
  pipeline.seek(1, static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH | GST_SEEK_FLAG_ACCURATE),
                kEnd / 2, GST_CLOCK_TIME_NONE);
  const std::uint64_t before = pipeline.maps();
  if (!pipeline.settle("preroll after the last seek")) return;
  pipeline.set_state(GST_STATE_PLAYING);
  pipeline.wait_for_end("the end of the stream after the last seek");
  const std::uint64_t maps = pipeline.maps() - before;
  if (!pipeline.failed() && maps < kLeast) {
    soak.fail(kSeeks, std::to_string(maps) + " maps after the last seek instead of at least " +
                          std::to_string(kLeast));
  }
}

/// One seek, without a flush only if `flows`: such a seek waits until the sink takes frames, and
/// keeps a pipeline that is not yet playing from it. True if a frame or the end of the stream
/// follows in any case: after the end of a segment nothing does.
bool seek_somewhere(Soak& soak, CheckedPipeline& pipeline, bool flows) {
  Random& random = soak.random;
  constexpr std::array kRates = {1.0, 1.0, 2.0, 0.5, 4.0, 8.0, 16.0, -0.5, -1.0, -2.0, -4.0, -8.0};
  const double rate = random.one_of(kRates);
  const bool flush = !flows || random.chance(0.5);
  auto from = static_cast<GstClockTime>(random.between(0, static_cast<std::int64_t>(kEnd)));
  GstClockTime to = GST_CLOCK_TIME_NONE;
  if (random.chance(0.3) || rate < 0) {
    to = from + static_cast<GstClockTime>(random.between(1, 2 * GST_SECOND));
    if (rate < 0 && random.chance(0.3)) from = 0;
  }
  if (rate < 0 && random.chance(0.3)) to = kEnd;
  const GstSeekFlags flags = random_flags(random, flush);
  pipeline.seek(rate, flags, from, to);
  soak.count(kSeeks, [](Counts& counts) { ++counts.operations; });
  return flush && (flags & GST_SEEK_FLAG_SEGMENT) == 0;
}

}  // namespace

void make_files(const std::string& folder) {
  files_folder() = folder;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const bool left = side == Side::kLeft;
    test::Pipeline pipeline(
        "appsrc name=in format=time caps=" +
        test::raw_caps("GRAY8", test::kNumberedWidth, test::kNumberedHeight) +
        " ! videoconvert ! video/x-raw,format=I420 ! x264enc bitrate=4000 bframes=0 threads=1 "
        "key-int-max=" +
        (left ? "12" : "25") + " ! h264parse ! matroskamux ! filesink location=" + file_of(side));
    encode(pipeline, side, left ? kLeftFrames : kRightFrames);
    const std::string error = pipeline.wait_for_end();
    if (!error.empty()) g_error("the files of the seeks cannot be made: %s", error.c_str());
  }
}

void seek_in_files(Soak& soak) {
  const std::string kind = kSeeks;
  Random& random = soak.random;
  CheckedPipeline pipeline(soak, kind,
                           launch_text(random.chance(0.8) ? "fakesink name=out sync=false"
                                                          : "queue ! fakesink name=out sync=true"),
                           true);
  soak.count(kind, [](Counts& counts) { ++counts.cases; });
  // The frames of one side are lost at random.
  const double loss = random.chance(0.4) ? 0.3 : 0;
  const char* lossy = random.chance(0.5) ? "sink_left-loss" : "sink_right-loss";
  g_object_set(pipeline.named(lossy), "drop-probability", loss, nullptr);
  bool playing = random.chance(0.5);
  pipeline.set_state(playing ? GST_STATE_PLAYING : GST_STATE_PAUSED);
  if (!pipeline.settle("preroll")) return;
  bool settled = true;
  for (int i = 0; i < 8 && !pipeline.failed(); ++i) {
    const bool prerolls = seek_somewhere(soak, pipeline, playing && settled);
    settled = prerolls && random.chance(0.5);
    if (settled && !pipeline.settle("preroll after a seek")) return;
    if (random.chance(0.5)) g_usleep(static_cast<gulong>(random.between(0, 60'000)));
    if (random.chance(0.3)) {
      playing = !playing;
      settled = false;
      pipeline.set_state(playing ? GST_STATE_PLAYING : GST_STATE_PAUSED);
      soak.count(kind, [](Counts& counts) { ++counts.operations; });
    }
  }
  g_object_set(pipeline.named(lossy), "drop-probability", 0.0, nullptr);
  if (!pipeline.failed()) play_second_half(soak, pipeline);
  if (pipeline.failed()) soak.fail(kind, pipeline.error());
}

void change_states(Soak& soak) {
  const std::string kind = "state changes";
  Random& random = soak.random;
  const bool live = random.chance(0.4);
  const bool files = random.chance(0.5);
  CheckedPipeline pipeline(
      soak, kind,
      files ? launch_text("fakesink sync=false")
            : std::string("mtstereo name=m max-disparity=16 threads=1 ! mtcolor ! fakesink sync=") +
                  (live ? "true" : "false") +
                  " videotestsrc name=a ! video/x-raw,format=GRAY8,width=64,height=48 ! queue ! "
                  "m.sink_left videotestsrc name=b ! video/x-raw,format=GRAY8,width=64,height=48 ! "
                  "queue ! m.sink_right",
      false);
  for (const char* name : {"a", "b"}) {
    GstElement* source = gst_bin_get_by_name(GST_BIN(pipeline.element()), name);
    if (source == nullptr) continue;
    g_object_set(source, "is-live", live ? TRUE : FALSE, nullptr);
    gst_object_unref(source);
  }
  constexpr std::array kStates = {GST_STATE_NULL, GST_STATE_READY, GST_STATE_PAUSED,
                                  GST_STATE_PLAYING};
  for (int i = 0; i < 12 && !pipeline.failed(); ++i) {
    // gst_parse_launch() links the pads of a demuxer once only; below PAUSED they are removed.
    pipeline.set_state(files ? kStates[random.between(2, 3)] : random.one_of(kStates));
    if (random.chance(0.3) && !pipeline.settle("a state change")) break;
    if (random.chance(0.5)) g_usleep(static_cast<gulong>(random.between(0, 30'000)));
    soak.count(kind, [](Counts& counts) { ++counts.operations; });
  }
  soak.count(kind, [](Counts& counts) { ++counts.cases; });
  if (pipeline.failed()) soak.fail(kind, pipeline.error());
}

}  // namespace mtstereo::soak
