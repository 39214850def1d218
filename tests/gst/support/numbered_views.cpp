// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/numbered_views.hpp"

#include <gst/app/gstappsrc.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "support/pipeline.hpp"

namespace mtstereo::test {
namespace {

// --- the texture: noise on a lattice, interpolated ---

constexpr int kCell = 4;  // of the lattice [px]

/// A well-mixed number from 0 to 255 for a lattice point.
int lattice(std::int64_t x, std::int64_t y) {
  auto mixed = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^
               static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu;
  mixed = (mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9u;
  mixed = (mixed ^ (mixed >> 32)) * 0x94d049bb133111ebu;
  return static_cast<int>((mixed >> 40) & 255);
}

std::int64_t cell_of(std::int64_t position) {
  return position >= 0 ? position / kCell : -((kCell - 1 - position) / kCell);
}

std::uint8_t texture(std::int64_t x, std::int64_t y) {
  const std::int64_t column = cell_of(x), row = cell_of(y);
  const auto right = static_cast<int>(x - column * kCell);
  const auto down = static_cast<int>(y - row * kCell);
  const auto blend = [&](std::int64_t at) {
    return lattice(column, at) * (kCell - right) + lattice(column + 1, at) * right;
  };
  const int value = (blend(row) * (kCell - down) + blend(row + 1) * down) / (kCell * kCell);
  return static_cast<std::uint8_t>(16 + value * 219 / 255);  // the range of video
}

// --- feeding ---

/// Waits for a running time. False if there is nothing more to push.
bool wait_for(GstElement* pipeline, GstClockTime running_time, const std::atomic<bool>& stop) {
  GstClock* clock = gst_element_get_clock(pipeline);
  const auto target =
      static_cast<GstClockTimeDiff>(gst_element_get_base_time(pipeline) + running_time);
  while (!stop) {
    const GstClockTimeDiff left = target - static_cast<GstClockTimeDiff>(gst_clock_get_time(clock));
    if (left <= 0) break;
    g_usleep(static_cast<gulong>(std::min<GstClockTimeDiff>(left / 1000 + 1, 20'000)));
  }
  gst_object_unref(clock);
  return !stop;
}

void add_reference(GstBuffer* buffer, GstClockTime time) {
  if (!GST_CLOCK_TIME_IS_VALID(time)) return;
  const CapsPointer clock(gst_caps_new_empty_simple("timestamp/x-ntp"));
  gst_buffer_add_reference_timestamp_meta(buffer, clock.get(), time, GST_CLOCK_TIME_NONE);
}

void push_all(const Pipeline& pipeline, Side side, const std::vector<NumberedFrame>& frames,
              const FeedOptions& options, const std::atomic<bool>& stop) {
  auto* source = GST_APP_SRC(pipeline.named(side == Side::kLeft ? "left" : "right"));
  for (const NumberedFrame& frame : frames) {
    GstBuffer* buffer = numbered_frame(side, frame.number, frame.pts, options.duration);
    add_reference(buffer, frame.earlier_reference);
    add_reference(buffer, frame.reference);
    const GstClockTime arrival = GST_CLOCK_TIME_IS_VALID(frame.arrival) ? frame.arrival : frame.pts;
    if (options.live && GST_CLOCK_TIME_IS_VALID(arrival) &&
        !wait_for(pipeline.element(), arrival, stop)) {
      gst_buffer_unref(buffer);
      return;
    }
    if (gst_app_src_push_buffer(source, buffer) != GST_FLOW_OK) return;
  }
  gst_app_src_end_of_stream(source);
}

std::string launch_text(const FeedOptions& options) {
  const auto source = [&](const char* name, const char* framerate) {
    return std::string(" appsrc name=") + name +
           " format=time caps=" + raw_caps("GRAY8", kNumberedWidth, kNumberedHeight, framerate) +
           // A live source does not wait for the element.
           (options.live ? " is-live=true max-bytes=0" : " block=true max-bytes=0 max-buffers=4") +
           (options.upstream.empty() ? " ! " : " ! " + options.upstream + " ! ") + "m.sink_" + name;
  };
  const char* right = options.right_framerate;
  return "mtstereo name=m " + options.properties + " ! " + options.tail +
         source("left", options.framerate) +
         source("right", right != nullptr ? right : options.framerate);
}

std::string text_of(GstMessage* message) {
  GError* error = nullptr;
  if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
    gst_message_parse_error(message, &error, nullptr);
  } else {
    gst_message_parse_warning(message, &error, nullptr);
  }
  std::string text = error->message;
  g_error_free(error);
  return text;
}

/// Notes the maps and the warnings in the order in which the element sends them.
class Recorder {
 public:
  Recorder(const Pipeline& pipeline, const FeedOptions& options)
      : element_(pipeline.named("m")), delay_(options.delay) {
    GstPad* output = gst_element_get_static_pad(element_, "src");
    gst_pad_add_probe(output, GST_PAD_PROBE_TYPE_BUFFER, on_map, this, nullptr);
    gst_object_unref(output);
    GstBus* bus = gst_element_get_bus(pipeline.element());
    gst_bus_set_sync_handler(bus, on_message, this, nullptr);
    gst_object_unref(bus);
  }
  /// After the pipeline has stopped.
  void move_to(FeedResult& result) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const NumberedMap& map : maps_) result.count.add(map.difference);
    result.maps = std::move(maps_);
    result.warnings = std::move(warnings_);
    result.maps_before_warning = std::move(maps_before_warning_);
  }

 private:
  static GstPadProbeReturn on_map(GstPad*, GstPadProbeInfo* info, gpointer recorder) {
    static_cast<Recorder*>(recorder)->add_map(GST_PAD_PROBE_INFO_BUFFER(info));
    return GST_PAD_PROBE_OK;
  }
  static GstBusSyncReply on_message(GstBus*, GstMessage* message, gpointer recorder) {
    if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_WARNING) {
      static_cast<Recorder*>(recorder)->add_warning(message);
    }
    return GST_BUS_PASS;
  }
  void add_map(GstBuffer* buffer) {
    g_usleep(static_cast<gulong>(delay_ / 1000));
    const NumberedMap map{GST_BUFFER_PTS(buffer), frame_difference(buffer),
                          gst_element_get_current_running_time(element_)};
    const std::lock_guard<std::mutex> lock(mutex_);
    maps_.push_back(map);
  }
  void add_warning(GstMessage* message) {
    if (GST_MESSAGE_SRC(message) != GST_OBJECT(element_)) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    warnings_.push_back(text_of(message));
    maps_before_warning_.push_back(maps_.size());
  }

  GstElement* element_;
  GstClockTime delay_;
  std::mutex mutex_;
  std::vector<NumberedMap> maps_;
  std::vector<std::string> warnings_;
  std::vector<std::size_t> maps_before_warning_;
};

/// Collects the messages up to the end of the stream or an error.
void collect_messages(GstElement* pipeline, double seconds, FeedResult& result) {
  GstBus* bus = gst_element_get_bus(pipeline);
  const gint64 end = g_get_monotonic_time() + static_cast<gint64>(seconds * G_USEC_PER_SEC);
  constexpr auto kTypes =
      static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR | GST_MESSAGE_LATENCY);
  result.error = "timeout: neither end of stream nor error";
  for (gint64 now = 0; (now = g_get_monotonic_time()) < end;) {
    const MessagePointer message(
        gst_bus_timed_pop_filtered(bus, static_cast<GstClockTime>(end - now) * 1000, kTypes));
    if (!message) break;
    if (GST_MESSAGE_TYPE(message.get()) == GST_MESSAGE_LATENCY) {
      gst_bin_recalculate_latency(GST_BIN(pipeline));
      continue;
    }
    const bool failed = GST_MESSAGE_TYPE(message.get()) == GST_MESSAGE_ERROR;
    result.error = failed ? text_of(message.get()) : std::string();
    break;
  }
  gst_object_unref(bus);
}

}  // namespace

const GrayImage& numbered_image(Side side, std::int64_t number) {
  static std::mutex mutex;
  static std::map<std::int64_t, GrayImage> drawn;
  // x in the left view is x - disparity in the right one.
  const std::int64_t shift = number * kNumberedStep + (side == Side::kRight ? kNumberedBase : 0);
  const std::lock_guard<std::mutex> lock(mutex);
  GrayImage& image = drawn[shift];
  if (!image.pixels.empty()) return image;
  image = {kNumberedWidth, kNumberedHeight, {}};
  image.pixels.reserve(static_cast<std::size_t>(kNumberedWidth) * kNumberedHeight);
  for (int y = 0; y < kNumberedHeight; ++y) {
    for (int x = 0; x < kNumberedWidth; ++x) image.pixels.push_back(texture(x + shift, y));
  }
  return image;
}

GstBuffer* numbered_frame(Side side, std::int64_t number, GstClockTime pts, GstClockTime duration) {
  return frame_buffer(numbered_image(side, number), pts, duration);
}

std::optional<int> frame_difference(const std::vector<std::uint16_t>& map, int scale) {
  std::vector<std::uint16_t> answered;
  std::copy_if(map.begin(), map.end(), std::back_inserter(answered),
               [](std::uint16_t value) { return value != 0; });
  if (answered.size() * 5 < map.size()) return std::nullopt;
  const auto middle = answered.begin() + static_cast<std::ptrdiff_t>(answered.size() / 2);
  std::nth_element(answered.begin(), middle, answered.end());
  const double median = static_cast<double>(*middle) / scale;
  const auto agreeing = std::count_if(answered.begin(), answered.end(), [&](std::uint16_t value) {
    return std::abs(static_cast<double>(value) / scale - median) < 1;
  });
  if (agreeing * 4 < static_cast<std::ptrdiff_t>(answered.size()) * 3) return std::nullopt;
  const double difference = (median - kNumberedBase) / kNumberedStep;
  const double nearest = std::round(difference);
  if (std::abs(difference - nearest) * kNumberedStep > 1) return std::nullopt;
  return static_cast<int>(nearest);
}

std::optional<int> frame_difference(GstBuffer* map, int scale) {
  return frame_difference(map_of(map, kNumberedWidth, kNumberedHeight), scale);
}

void DifferenceCounter::add(std::optional<int> difference) {
  ++maps;
  if (!difference) {
    ++unknown;
  } else if (*difference != 0) {
    ++wrong;
  }
}

std::vector<NumberedFrame> numbered_sequence(int count, GstClockTime interval, GstClockTime offset,
                                             std::int64_t first) {
  std::vector<NumberedFrame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back({first + i, offset + static_cast<GstClockTime>(i) * interval});
  }
  return frames;
}

FeedResult feed(const std::vector<NumberedFrame>& left, const std::vector<NumberedFrame>& right,
                const FeedOptions& options) {
  FeedResult result;
  Pipeline pipeline(launch_text(options));
  Recorder recorder(pipeline, options);
  pipeline.set_state(GST_STATE_PLAYING);
  // Without a preroll, set_state() has set clock and base time of a live pipeline when it returns.
  std::atomic<bool> stop{false};
  std::thread left_thread([&] { push_all(pipeline, Side::kLeft, left, options, stop); });
  std::thread right_thread([&] { push_all(pipeline, Side::kRight, right, options, stop); });
  collect_messages(pipeline.element(), options.timeout, result);
  stop = true;
  result.stats = stats_of(pipeline.named("m"));
  pipeline.set_state(GST_STATE_NULL);  // releases a push that blocks
  left_thread.join();
  right_thread.join();
  recorder.move_to(result);
  return result;
}

}  // namespace mtstereo::test
