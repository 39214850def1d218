// SPDX-License-Identifier: LGPL-2.1-or-later
#include "video_files.hpp"

#include <gst/app/gstappsink.h>
#include <gst/app/gstappsrc.h>
#include <gst/gst.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace mtstereo::run::testing {

namespace fs = std::filesystem;

namespace {

constexpr int kWidth = 64, kHeight = 48;

struct StopPipeline {
  void operator()(GstElement* pipeline) const {
    gst_element_set_state(pipeline, GST_STATE_NULL);
    gst_object_unref(pipeline);
  }
};
using Pipeline = std::unique_ptr<GstElement, StopPipeline>;

Pipeline launch(const std::string& line) {
  gst_init(nullptr, nullptr);
  g_autoptr(GError) error = nullptr;
  GstElement* pipeline =
      gst_parse_launch_full(line.c_str(), nullptr, GST_PARSE_FLAG_FATAL_ERRORS, &error);
  if (pipeline == nullptr) throw std::runtime_error(line + ": " + error->message);
  return Pipeline(GST_ELEMENT(gst_object_ref_sink(pipeline)));
}

void wait_for_end(GstElement* pipeline) {
  g_autoptr(GstBus) bus = gst_element_get_bus(pipeline);
  g_autoptr(GstMessage) message = gst_bus_timed_pop_filtered(
      bus, 60 * GST_SECOND, static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR));
  if (message == nullptr) throw std::runtime_error("the pipeline does not end");
  if (GST_MESSAGE_TYPE(message) != GST_MESSAGE_ERROR) return;
  g_autoptr(GError) error = nullptr;
  gst_message_parse_error(message, &error, nullptr);
  throw std::runtime_error(error->message);
}

// A bright square on a gradient.
GstBuffer* frame(int number, Nanoseconds time, Nanoseconds duration) {
  constexpr std::size_t kSize = std::size_t{kWidth} * kHeight;
  GstBuffer* buffer = gst_buffer_new_allocate(nullptr, kSize, nullptr);
  std::array<std::uint8_t, kSize> pixels{};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int across = (x - number % kWidth + kWidth) % kWidth;
      const bool inside = across < 12 && y > 10 && y < 30;
      pixels[static_cast<std::size_t>(y * kWidth + x)] =
          static_cast<std::uint8_t>(inside ? 230 : 60 + x + y);
    }
  }
  gst_buffer_fill(buffer, 0, pixels.data(), kSize);
  GST_BUFFER_PTS(buffer) = static_cast<GstClockTime>(time);
  GST_BUFFER_DURATION(buffer) = static_cast<GstClockTime>(duration);
  return buffer;
}

std::string output_of(const std::string& command) {
  std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string output;
  std::array<char, 4096> part{};
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe.get())) {
    output.append(part.data(), count);
  }
  return output;
}

}  // namespace

const char* const kBFrames =
    "x264enc bframes=2 b-adapt=false key-int-max=30 speed-preset=veryfast bitrate=300 ! h264parse";

fs::path TemporaryFolder::operator/(const std::string& name) const {
  const fs::path file = path() / name;
  fs::create_directories(file.parent_path());
  return file;
}

void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

void write_beginning(const fs::path& from, const fs::path& to, double fraction) {
  fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  fs::resize_file(to,
                  static_cast<std::uintmax_t>(fraction * static_cast<double>(fs::file_size(from))));
}

bool have_ffmpeg() {
  static const bool found =
      std::system("ffmpeg -version > /dev/null 2>&1 && ffprobe -version > /dev/null 2>&1") == 0;
  return found;
}

void run_pipeline(const std::string& line) {
  const Pipeline pipeline = launch(line);
  gst_element_set_state(pipeline.get(), GST_STATE_PLAYING);
  wait_for_end(pipeline.get());
}

void run_command(const std::string& command) {
  ASSERT_EQ(std::system((command + " < /dev/null").c_str()), 0) << command;
}

std::vector<Nanoseconds> constant_times(int count) {
  std::vector<Nanoseconds> times;
  for (int i = 0; i < count; ++i) times.push_back(i * Nanoseconds{1'000'000'000} / 30);
  return times;
}

std::vector<Nanoseconds> variable_times(int count) {
  constexpr std::array<Nanoseconds, 5> kSteps{33, 17, 100, 40, 50};  // [ms]
  std::vector<Nanoseconds> times;
  Nanoseconds time = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    times.push_back(time);
    time += kSteps[i % kSteps.size()] * 1'000'000;
  }
  return times;
}

void write_video(const fs::path& file, const std::string& coding,
                 const std::vector<Nanoseconds>& times) {
  const bool constant = times == constant_times(static_cast<int>(times.size()));
  const Pipeline pipeline = launch(
      "appsrc name=in format=time caps=video/x-raw,format=GRAY8,width=64,height=48,framerate=" +
      std::string(constant ? "30/1" : "0/1") + " ! videoconvert ! " + coding +
      " ! filesink name=out");
  g_autoptr(GstElement) in = gst_bin_get_by_name(GST_BIN(pipeline.get()), "in");
  g_autoptr(GstElement) out = gst_bin_get_by_name(GST_BIN(pipeline.get()), "out");
  g_object_set(out, "location", file.c_str(), nullptr);
  gst_element_set_state(pipeline.get(), GST_STATE_PLAYING);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Nanoseconds next = i + 1 < times.size() ? times[i + 1] : times[i] + 33'333'333;
    gst_app_src_push_buffer(GST_APP_SRC(in), frame(static_cast<int>(i), times[i], next - times[i]));
  }
  gst_app_src_end_of_stream(GST_APP_SRC(in));
  wait_for_end(pipeline.get());
}

std::vector<Nanoseconds> decoded_times(const fs::path& file) {
  const Pipeline pipeline =
      launch("filesrc name=in ! decodebin ! video/x-raw ! appsink name=out sync=false");
  g_autoptr(GstElement) in = gst_bin_get_by_name(GST_BIN(pipeline.get()), "in");
  g_autoptr(GstElement) out = gst_bin_get_by_name(GST_BIN(pipeline.get()), "out");
  g_object_set(in, "location", file.c_str(), nullptr);
  gst_element_set_state(pipeline.get(), GST_STATE_PLAYING);
  std::vector<Nanoseconds> times;
  const bool matroska = file.extension() == ".mkv" || file.extension() == ".webm";
  while (GstSample* sample = gst_app_sink_try_pull_sample(GST_APP_SINK(out), 5 * GST_SECOND)) {
    const GstClockTime stamp = GST_BUFFER_PTS(gst_sample_get_buffer(sample));
    times.push_back(static_cast<Nanoseconds>(
        matroska
            ? stamp
            : gst_segment_to_stream_time(gst_sample_get_segment(sample), GST_FORMAT_TIME, stamp)));
    gst_sample_unref(sample);
  }
  return times;
}

std::vector<double> ffprobe_times(const fs::path& file) {
  std::istringstream lines(
      output_of("ffprobe -v error -select_streams v:0 -show_entries "
                "frame=best_effort_timestamp_time -of csv=p=0 '" +
                file.string() + "' 2> /dev/null"));
  std::vector<double> times;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) times.push_back(std::stod(line));
  }
  return times;
}

}  // namespace mtstereo::run::testing
