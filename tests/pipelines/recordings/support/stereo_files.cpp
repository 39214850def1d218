// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stereo_files.hpp"

#include <gst/app/gstappsrc.h>
#include <gst/video/video.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "recordings/media/gst_objects.hpp"
#include "video_files.hpp"

namespace mtstereo::run::testing {

namespace fs = std::filesystem;

namespace {

// Smooth noise: the mean of random values at the corners of cells.
int texture(int x, int y) {
  constexpr int kCell = 5;
  const auto value = [](int column, int row) {
    auto hash = static_cast<std::uint32_t>(column) * 2654435761u ^
                static_cast<std::uint32_t>(row) * 2246822519u;
    hash ^= hash >> 15;
    hash *= 2654435761u;
    return static_cast<int>(hash >> 24);
  };
  const int column = x / kCell, row = y / kCell, dx = x % kCell, dy = y % kCell;
  const int above = value(column, row) * (kCell - dx) + value(column + 1, row) * dx;
  const int below = value(column, row + 1) * (kCell - dx) + value(column + 1, row + 1) * dx;
  return (above * (kCell - dy) + below * dy) / (kCell * kCell);
}

std::uint8_t pixel(int number, int x, int y, bool right, int row_offset) {
  const int row = right ? y - row_offset + 16 : y + 16;
  const int disparity = row < 16 + kStereoHeight / 2 ? 6 : 11;
  const int column = x + (right ? disparity : 0) + 3 * number;
  return static_cast<std::uint8_t>(40 + texture(column, row) * 160 / 256 + number % 7);
}

void wait_for_end(const Pipeline& pipeline) {
  g_autoptr(GstBus) bus = gst_element_get_bus(pipeline.get());
  g_autoptr(GstMessage) message = gst_bus_timed_pop_filtered(
      bus, 60 * GST_SECOND, static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR));
  if (message == nullptr || GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
    throw std::runtime_error("the pipeline fails");
  }
}

}  // namespace

std::string rows_of(GstBuffer* buffer, const GstCaps* caps) {
  GstVideoInfo info;
  GstVideoFrame frame;
  if (gst_video_info_from_caps(&info, caps) == FALSE ||
      gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ) == FALSE) {
    throw std::runtime_error("a frame cannot be mapped");
  }
  std::string rows;
  const auto width =
      static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.finfo->pixel_stride[0]);
  for (int y = 0; y < info.height; ++y) {
    const auto* data = static_cast<const char*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0));
    rows.append(data + y * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0), width);
  }
  gst_video_frame_unmap(&frame);
  return rows;
}

// Many tests have the same frames, and tests are compiled without optimization: each is drawn once.
const std::vector<std::uint8_t>& stereo_frame(int number, View view, int row_offset) {
  static std::map<std::tuple<int, View, int>, std::vector<std::uint8_t>> drawn;
  std::vector<std::uint8_t>& pixels = drawn[{number, view, row_offset}];
  if (!pixels.empty()) return pixels;
  const int width = view == View::kBoth ? 2 * kStereoWidth : kStereoWidth;
  for (int y = 0; y < kStereoHeight; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool right = view == View::kRight || x >= kStereoWidth;
      pixels.push_back(pixel(number, x % kStereoWidth, y, right, row_offset));
    }
  }
  return pixels;
}

void write_view(const fs::path& file, View view, const std::string& coding,
                const std::vector<Nanoseconds>& times, int row_offset) {
  const int width = view == View::kBoth ? 2 * kStereoWidth : kStereoWidth;
  const Pipeline pipeline = parse_pipeline(
      "appsrc name=in format=time caps=video/x-raw,format=GRAY8,width=" + std::to_string(width) +
      ",height=" + std::to_string(kStereoHeight) +
      ",framerate=" + (times == constant_times(static_cast<int>(times.size())) ? "30/1" : "0/1") +
      " ! videoconvert ! " + coding + " ! filesink name=out");
  g_object_set(element_of(pipeline, "out").get(), "location", file.c_str(), nullptr);
  const ElementPointer in = element_of(pipeline, "in");
  gst_element_set_state(pipeline.get(), GST_STATE_PLAYING);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::vector<std::uint8_t>& pixels = stereo_frame(static_cast<int>(i), view, row_offset);
    GstBuffer* const buffer = gst_buffer_new_memdup(pixels.data(), pixels.size());
    const Nanoseconds next = i + 1 < times.size() ? times[i + 1] : times[i] + 33'333'333;
    GST_BUFFER_PTS(buffer) = static_cast<GstClockTime>(times[i]);
    GST_BUFFER_DURATION(buffer) = static_cast<GstClockTime>(next - times[i]);
    gst_app_src_push_buffer(GST_APP_SRC(in.get()), buffer);
  }
  gst_app_src_end_of_stream(GST_APP_SRC(in.get()));
  wait_for_end(pipeline);
}

fs::path write_stereo_calibration(const fs::path& folder) {
  fs::path file = folder / "calib.txt";
  write_text(file,
             "cam0=[100 0 79.5; 0 100 47.5; 0 0 1]\ncam1=[100 0 79.5; 0 100 47.5; 0 0 1]\n"
             "doffs=0\nbaseline=100\nwidth=160\nheight=96\nndisp=24\n");
  return file;
}

Work work_of(const fs::path& left, const fs::path& right, const WorkOptions& options) {
  Work work;
  work.recording.name = "test";
  work.recording.kind = "two video files";
  work.recording.left.video = left;
  work.recording.right.video = right;
  work.options = options;
  work.options.parameters.emplace_back("max-disparity", "24");
  work.left = index_frames(work.recording.left, 0);
  work.right = index_frames(work.recording.right, 0);
  const std::size_t frames = std::min(work.left.times.size(), work.right.times.size());
  for (std::size_t i = 0; i < frames; ++i) {
    work.pairs.pairs.push_back({static_cast<std::int64_t>(i), static_cast<std::int64_t>(i)});
  }
  work.period = 33'333'333;
  work.correction = {{"alignment", "hold"}};
  return work;
}

Range whole(const Work& work) { return {0, static_cast<std::int64_t>(work.pairs.pairs.size())}; }

std::vector<std::string> frames_of(const std::string& line) {
  const Pipeline pipeline = parse_pipeline(line);
  const ElementPointer sink = element_of(pipeline, "out");
  gst_element_set_state(pipeline.get(), GST_STATE_PLAYING);
  std::vector<std::string> frames;
  while (GstSample* sample =
             gst_app_sink_try_pull_sample(GST_APP_SINK(sink.get()), 20 * GST_SECOND)) {
    frames.push_back(rows_of(gst_sample_get_buffer(sample), gst_sample_get_caps(sample)));
    gst_sample_unref(sample);
  }
  return frames;
}

std::string matcher_line(const fs::path& left, const fs::path& right,
                         const std::string& properties) {
  const auto source = [](const fs::path& file, const char* pad) {
    return " filesrc location=" + file.string() + " ! decodebin ! queue ! m." + pad;
  };
  return source(left, "sink_left") + source(right, "sink_right") +
         " mtstereo name=m max-disparity=24 alignment=off " + properties;
}

std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path name = entry.path().lexically_relative(folder);
    if (!entry.is_regular_file() || name.extension() == ".json") continue;
    contents[name.string()] = bytes_of(entry.path());
  }
  return contents;
}

std::string bytes_of(const fs::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace mtstereo::run::testing
