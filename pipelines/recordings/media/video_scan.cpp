// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/video_scan.hpp"

#include <gst/pbutils/pbutils.h>
#include <gst/video/video.h>

#include <atomic>
#include <cstring>
#include <utility>

#include "lib/files/unread_kinds.hpp"
#include "lib/media/decoding_problem.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/media/container.hpp"
#include "recordings/media/decoder_kind.hpp"
#include "recordings/media/decoder_reports.hpp"
#include "recordings/media/gst_objects.hpp"
#include "recordings/media/jpeg_check.hpp"
#include "recordings/media/leading_frames.hpp"
#include "recordings/media/segments.hpp"
#include "shared/decoder_crashes.hpp"
#include "shared/orientation.hpp"

namespace mtstereo::run {

namespace {

using plugin::TextPointer;

constexpr GstClockTime kSlice = 100 * GST_MSECOND;
constexpr GstClockTime kLongestSilence = 120 * GST_SECOND;  // a slow network file system
constexpr GstClockTime kAfterError = 2 * GST_SECOND;   // for the frames that are already decoded
constexpr GstClockTime kForVideo = 5 * GST_SECOND;     // after streams of other kinds
constexpr GstClockTime kForTasks = 300 * GST_MSECOND;  // to start
constexpr guint kMostWaiting = 8;                      // frames

GstElement* element(const char* factory) {
  GstElement* made = gst_element_factory_make(factory, nullptr);
  if (made == nullptr) {
    throw UserError(std::string("GStreamer has no element ") + factory +
                    ": install its plugins (pipelines/install-packages.sh)");
  }
  return made;
}

bool is_video(const GstCaps* caps) {
  const std::string name = gst_structure_get_name(gst_caps_get_structure(caps, 0));
  return name.starts_with("video/") || name.starts_with("image/");
}

std::vector<std::uint8_t> gray_pixels(GstBuffer* buffer, const GstVideoInfo& info) {
  GstVideoFrame frame;
  if (gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ) == FALSE) return {};
  const auto width = static_cast<std::size_t>(info.width);
  const auto height = static_cast<std::size_t>(info.height);
  std::vector<std::uint8_t> pixels(width * height);
  const auto* rows = static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0));
  const auto stride = static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0));
  for (std::size_t y = 0; y < height; ++y) {
    std::memcpy(pixels.data() + y * width, rows + y * stride, width);
  }
  gst_video_frame_unmap(&frame);
  return pixels;
}

}  // namespace

struct VideoScan::State {
  State(std::filesystem::path path, Reading how)
      : file(std::move(path)), reading(how), stamps(is_matroska(file)) {
    start_gstreamer();
    pipeline = GST_ELEMENT(gst_object_ref_sink(gst_pipeline_new(nullptr)));
  }
  ~State() {
    gst_element_set_state(pipeline, GST_STATE_NULL);
    gst_object_unref(pipeline);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void build();
  GstElement* add(const char* factory) const {
    GstElement* made = element(factory);
    gst_bin_add(GST_BIN(pipeline), made);
    return made;
  }
  void read_messages();
  void take_message(GstMessage* message);
  std::string reason_of_silence(GstClockTime waited) const;
  SamplePointer pull();
  std::optional<VideoFrame> frame_of(GstSample* next);
  void read_format(GstCaps* caps);

  std::optional<Nanoseconds> time_of(const GstSegment* segment, GstClockTime stamp) const;

  std::optional<Nanoseconds> time_on(GstPad* pad, const GstBuffer* buffer) const;

  static GstPadProbeReturn on_first_buffer(GstPad* pad, GstPadProbeInfo* info, gpointer data);
  static GstPadProbeReturn on_coded(GstPad* pad, GstPadProbeInfo* info, gpointer data);
  static GstPadProbeReturn before_decoder(GstPad* pad, GstPadProbeInfo* info, gpointer data);
  static void on_element(GstBin* bin, GstBin* inner, GstElement* added, gpointer data);
  static void on_pad(GstElement* source, GstPad* pad, gpointer data);
  static void on_no_more_pads(GstElement* source, gpointer data);

  std::filesystem::path file;
  Reading reading;
  bool stamps;  // time stamps count
  LeadingFrames leading{stamps};
  GstElement* pipeline = nullptr;  // owns the elements
  GstElement* entry = nullptr;     // of the branch of the sink
  GstAppSink* sink = nullptr;
  SamplePointer sample;                    // of the last frame
  CapsPointer caps;                        // of the last frame
  std::optional<GstSegment> last_segment;  // of the last frame
  VideoFormat format;
  std::string missing;  // decoders
  std::shared_ptr<DecoderReports> reports = std::make_shared<DecoderReports>();
  std::string error;
  // Set by threads of the pipeline.
  std::atomic<bool> linked{false}, others{false}, complete{false}, keyframe_first{false};
  std::atomic<int> video_streams{0};
  std::atomic<bool> waits_for_key{false};  // frames that refer to others are not decoded
  std::atomic<bool> decodes{false};        // a decoder has got a frame
};

void VideoScan::State::build() {
  GstElement* source = add("filesrc");
  g_object_set(source, "location", file.c_str(), nullptr);
  GstElement* parser = add(reading == Reading::kCoded ? "parsebin" : "decodebin");
  if (reading != Reading::kCoded) {
    // Sound is not decoded.
    const CapsPointer wanted(gst_caps_from_string("video/x-raw(ANY)"));
    g_object_set(parser, "caps", wanted.get(), "expose-all-streams", FALSE, "force-sw-decoders",
                 TRUE, nullptr);
  }
  sink = GST_APP_SINK(add("appsink"));
  g_object_set(sink, "sync", FALSE, "max-buffers", kMostWaiting, "enable-last-sample", FALSE,
               nullptr);
  entry = GST_ELEMENT(sink);
  if (reading == Reading::kGray) {
    entry = add("videoconvert");
    const CapsPointer gray(gst_caps_from_string("video/x-raw,format=GRAY8"));
    gst_app_sink_set_caps(sink, gray.get());
    gst_element_link(entry, GST_ELEMENT(sink));
  }
  gst_element_link(source, parser);
  GstPad* pad = gst_element_get_static_pad(entry, "sink");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_first_buffer, this, nullptr);
  if (reading == Reading::kCoded) {
    gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_coded, this, nullptr);
  }
  gst_object_unref(pad);
  g_signal_connect(pipeline, "deep-element-added", G_CALLBACK(on_element), this);
  g_signal_connect(parser, "pad-added", G_CALLBACK(on_pad), this);
  g_signal_connect(parser, "no-more-pads", G_CALLBACK(on_no_more_pads), this);
  gst_element_set_state(pipeline, GST_STATE_PLAYING);
}

// The sink discards frames outside of the segment, so that the first one may not arrive.
GstPadProbeReturn VideoScan::State::on_first_buffer(GstPad*, GstPadProbeInfo* info, gpointer data) {
  const GstBuffer* buffer = GST_PAD_PROBE_INFO_BUFFER(info);
  const bool keyframe = !GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT);
  static_cast<State*>(data)->keyframe_first = keyframe;
  return GST_PAD_PROBE_REMOVE;
}

GstPadProbeReturn VideoScan::State::on_coded(GstPad* pad, GstPadProbeInfo* info, gpointer data) {
  State* self = static_cast<State*>(data);
  const bool leads = self->leading.has(pad, GST_PAD_PROBE_INFO_BUFFER(info));
  return leads ? GST_PAD_PROBE_DROP : GST_PAD_PROBE_OK;
}

// After a seek, a demultiplexer may continue at a frame that refers to others.
GstPadProbeReturn VideoScan::State::before_decoder(GstPad* pad, GstPadProbeInfo* info,
                                                   gpointer data) {
  State* self = static_cast<State*>(data);
  if ((GST_PAD_PROBE_INFO_TYPE(info) & GST_PAD_PROBE_TYPE_EVENT_FLUSH) != 0) {
    self->waits_for_key = true;
    self->leading.flush();
    self->reports->flush();
    return GST_PAD_PROBE_OK;
  }
  GstBuffer* buffer = GST_PAD_PROBE_INFO_BUFFER(info);
  const bool keyframe = !GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT);
  if (keyframe) self->waits_for_key = false;
  if (self->waits_for_key || self->leading.has(pad, buffer)) return GST_PAD_PROBE_DROP;
  self->decodes = true;
  self->reports->begin(self->time_on(pad, buffer), keyframe);
  if (is_jpeg_decoder(GST_PAD_PARENT(pad))) {
    const std::string damage = damage_of_jpeg(buffer);
    if (!damage.empty()) self->reports->add(damage);
  }
  return GST_PAD_PROBE_OK;
}

void VideoScan::State::on_element(GstBin*, GstBin*, GstElement* added, gpointer data) {
  if (!is_video_decoder(added)) return;
  plugin::keep_from_crashing(added);
  static_cast<State*>(data)->reports->listen_to(added);
  GstPad* pad = gst_element_get_static_pad(added, "sink");
  if (pad == nullptr) return;
  constexpr auto kData =
      static_cast<GstPadProbeType>(GST_PAD_PROBE_TYPE_BUFFER | GST_PAD_PROBE_TYPE_EVENT_FLUSH);
  gst_pad_add_probe(pad, kData, before_decoder, data, nullptr);
  gst_object_unref(pad);
}

// The first stream with video. The others end in sinks of their own: without one, a demultiplexer
// stops.
void VideoScan::State::on_pad(GstElement*, GstPad* pad, gpointer data) {
  State* self = static_cast<State*>(data);
  CapsPointer caps(gst_pad_get_current_caps(pad));
  if (!caps) caps.reset(gst_pad_query_caps(pad, nullptr));
  const bool known = caps && gst_caps_get_size(caps.get()) > 0 && !gst_caps_is_any(caps.get());
  GstElement* end = self->entry;
  const bool video = known && is_video(caps.get());
  if (video) ++self->video_streams;
  const bool wanted = video && !self->linked;
  if (!wanted) {
    end = gst_element_factory_make("fakesink", nullptr);
    if (end == nullptr) return;
    g_object_set(end, "sync", FALSE, "async", FALSE, "enable-last-sample", FALSE, nullptr);
    gst_bin_add(GST_BIN(self->pipeline), end);
    gst_element_sync_state_with_parent(end);
  }
  GstPad* target = gst_element_get_static_pad(end, "sink");
  const bool is_linked = gst_pad_link(pad, target) == GST_PAD_LINK_OK;
  gst_object_unref(target);
  (is_linked && wanted ? self->linked : self->others) = true;
}

void VideoScan::State::on_no_more_pads(GstElement*, gpointer data) {
  static_cast<State*>(data)->complete = true;
}

void VideoScan::State::take_message(GstMessage* message) {
  if (gst_is_missing_plugin_message(message) != FALSE) {
    const TextPointer text(gst_missing_plugin_message_get_description(message));
    missing = text.get();
  } else if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR && error.empty()) {
    error = missing.empty() ? media::decoding_problem(message) : media::without_plugin(missing);
  }
}

void VideoScan::State::read_messages() {
  g_autoptr(GstBus) bus = gst_element_get_bus(pipeline);
  while (GstMessage* message = gst_bus_pop_filtered(
             bus, static_cast<GstMessageType>(GST_MESSAGE_ERROR | GST_MESSAGE_ELEMENT))) {
    take_message(message);
    gst_message_unref(message);
  }
}

// Why no frame is to be expected while no stream is linked; empty if one may come.
std::string VideoScan::State::reason_of_silence(GstClockTime waited) const {
  const bool all_known = complete || (others && waited >= kForVideo);
  if (all_known || (waited >= kForTasks && !is_running(pipeline))) {
    return missing.empty() ? media::without_frames(decodes) : media::without_plugin(missing);
  }
  return "";
}

// The next sample, or null at the end.
SamplePointer VideoScan::State::pull() {
  for (GstClockTime waited = 0;; waited += kSlice) {
    SamplePointer next(gst_app_sink_try_pull_sample(sink, kSlice));
    if (next) return next;
    read_messages();
    if (gst_app_sink_is_eos(sink) != FALSE) return nullptr;
    if (error.empty() && !linked) error = reason_of_silence(waited);
    if (!error.empty() && (!linked || waited >= kAfterError)) return nullptr;
    if (waited < kLongestSilence) continue;
    error = "no data came for " + std::to_string(kLongestSilence / GST_SECOND) + " s";
    return nullptr;
  }
}

void VideoScan::State::read_format(GstCaps* new_caps) {
  if (caps && gst_caps_is_equal(caps.get(), new_caps) != FALSE) return;
  caps.reset(gst_caps_ref(new_caps));
  const GstStructure* structure = gst_caps_get_structure(new_caps, 0);
  format = {};
  format.media = gst_structure_get_name(structure);
  gst_structure_get_int(structure, "width", &format.width);
  gst_structure_get_int(structure, "height", &format.height);
  gint numerator = 0, denominator = 1;
  if (gst_structure_get_fraction(structure, "framerate", &numerator, &denominator) != FALSE &&
      denominator > 0) {
    format.frame_rate = static_cast<double>(numerator) / denominator;
  }
  const TextPointer codec(gst_pb_utils_get_codec_description(new_caps));
  format.codec = codec ? codec.get() : format.media;
}

std::optional<Nanoseconds> VideoScan::State::time_of(const GstSegment* segment,
                                                     GstClockTime stamp) const {
  if (!GST_CLOCK_TIME_IS_VALID(stamp)) return std::nullopt;
  if (stamps) return static_cast<Nanoseconds>(stamp);
  if (segment->format != GST_FORMAT_TIME) return std::nullopt;
  const guint64 time = gst_segment_to_stream_time(segment, GST_FORMAT_TIME, stamp);
  if (!GST_CLOCK_TIME_IS_VALID(time)) return std::nullopt;
  return static_cast<Nanoseconds>(time);
}

// The time of a frame on its way; kNotShown if it is outside of the segment.
std::optional<Nanoseconds> VideoScan::State::time_on(GstPad* pad, const GstBuffer* buffer) const {
  const std::optional<GstSegment> segment = segment_on(pad);
  if (!segment || !GST_BUFFER_PTS_IS_VALID(buffer)) return std::nullopt;
  return time_of(&*segment, GST_BUFFER_PTS(buffer)).value_or(DecoderReports::kNotShown);
}

// std::nullopt for a frame that is not shown.
std::optional<VideoFrame> VideoScan::State::frame_of(GstSample* next) {
  GstBuffer* buffer = gst_sample_get_buffer(next);
  const GstSegment* segment = gst_sample_get_segment(next);
  VideoFrame frame;
  if (GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_DECODE_ONLY)) return std::nullopt;
  GstClockTime time = GST_BUFFER_PTS(buffer);
  if (reading == Reading::kCoded && GST_CLOCK_TIME_IS_VALID(time) && !stamps &&
      !clip(*segment, GST_BUFFER_DURATION(buffer), time)) {
    return std::nullopt;
  }
  frame.time = time_of(segment, time);
  if (reading == Reading::kCoded && GST_BUFFER_DTS_IS_VALID(buffer)) {
    frame.decoding_time = static_cast<Nanoseconds>(GST_BUFFER_DTS(buffer));
  }
  frame.keyframe = !GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT);
  // The first frame of a segment has the flag though nothing is missing.
  const bool same_segment = last_segment && gst_segment_is_equal(&*last_segment, segment) != FALSE;
  last_segment = *segment;
  frame.discontinuous = GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_DISCONT) && same_segment;
  if (GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_CORRUPTED)) {
    reports->add(frame.time, "the decoder marks it as corrupted");
  }
  if (reading == Reading::kGray) {
    GstVideoInfo info;
    if (gst_video_info_from_caps(&info, caps.get()) != FALSE) {
      frame.pixels = gray_pixels(buffer, info);
    }
  }
  return frame;
}

VideoScan::VideoScan(std::filesystem::path file, Reading reading)
    : state_(std::make_unique<State>(std::move(file), reading)) {
  files::refuse_unread(state_->file);
  state_->build();
}

VideoScan::~VideoScan() = default;

std::optional<VideoFrame> VideoScan::next() {
  for (;;) {
    state_->sample.reset();  // the sink uses it again: it must have the only reference
    state_->sample = state_->pull();
    if (!state_->sample) return std::nullopt;
    state_->read_format(gst_sample_get_caps(state_->sample.get()));
    std::optional<VideoFrame> frame = state_->frame_of(state_->sample.get());
    if (frame) return frame;
  }
}

GstSample* VideoScan::sample() const { return state_->sample.get(); }

std::vector<DamagedFrame> VideoScan::take_damaged_until(Nanoseconds time) {
  return state_->reports->take_until(time);
}

bool VideoScan::seek(Nanoseconds time, Nanoseconds wanted) {
  // A pipeline can seek when its first frame has arrived.
  if (!state_->caps && !next()) return false;
  constexpr auto kFlags = static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH | GST_SEEK_FLAG_KEY_UNIT |
                                                    GST_SEEK_FLAG_SNAP_BEFORE);
  state_->last_segment.reset();
  state_->sample.reset();
  state_->reports->set_first(wanted);
  return gst_element_get_state(state_->pipeline, nullptr, nullptr, kAfterError) !=
             GST_STATE_CHANGE_FAILURE &&
         gst_element_seek_simple(state_->pipeline, GST_FORMAT_TIME, kFlags, time) != FALSE;
}

const VideoFormat& VideoScan::format() const { return state_->format; }

bool VideoScan::starts_with_keyframe() const { return state_->keyframe_first; }

std::string VideoScan::turning() const {
  g_autoptr(GstPad) pad = gst_element_get_static_pad(GST_ELEMENT(state_->sink), "sink");
  return plugin::turning_on(pad);
}

int VideoScan::video_streams() const { return state_->video_streams; }

const std::string& VideoScan::error() const { return state_->error; }

std::optional<Nanoseconds> VideoScan::duration() const {
  gint64 length = 0;
  if (gst_element_query_duration(state_->pipeline, GST_FORMAT_TIME, &length) == FALSE) {
    return std::nullopt;
  }
  return length > 0 ? std::optional<Nanoseconds>(length) : std::nullopt;
}

}  // namespace mtstereo::run
