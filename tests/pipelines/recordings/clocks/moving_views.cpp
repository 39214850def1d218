// SPDX-License-Identifier: LGPL-2.1-or-later
#include "moving_views.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include "recordings/media/gst_objects.hpp"
#include "tools/render/render.hpp"

namespace mtstereo::run {
namespace {

std::string image_name(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "%06zu.pgm", number);
  return name;
}

}  // namespace

Shot shoot(const Shooting& shooting) {
  render::Settings settings;
  settings.width = shooting.size.width;
  settings.height = shooting.size.height;
  settings.samples = 1;
  settings.blur = 0.5;
  Shot shot;
  shot.rate = std::round(shooting.rate);
  for (int i = 0; i < shooting.frames; ++i) {
    // Noise differs between frames of the same scene.
    settings.seed = static_cast<std::uint32_t>(i + 1);
    const double time = shooting.start + i / shooting.rate;
    shot.frames.push_back(render::render_view(shooting.scene, time, settings, shooting.right));
  }
  return shot;
}

Shot changed(const Shot& shot, const std::function<cv::Mat(int, const cv::Mat&)>& change) {
  Shot result{{}, shot.rate};
  int number = 0;
  for (const cv::Mat& frame : shot.frames) result.frames.push_back(change(number++, frame));
  return result;
}

Shot degraded(const Shot& shot, double factor, double noise) {
  cv::RNG random(7);
  return changed(shot, [&](int /*number*/, const cv::Mat& frame) {
    cv::Mat values(frame.size(), CV_32F), result;
    random.fill(values, cv::RNG::NORMAL, 0, noise);
    cv::Mat bright;
    frame.convertTo(bright, CV_32F, factor);
    values += bright;
    values.convertTo(result, CV_8U);
    return result;
  });
}

Source write_images(const Shot& shot, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  Source source;
  for (const cv::Mat& frame : shot.frames) {
    const std::size_t number = source.images.size();
    source.images.push_back(folder / image_name(number));
    cv::imwrite(source.images.back().string(), frame);
    source.times.push_back(std::llround(1e9 * static_cast<double>(number) / shot.rate));
  }
  return source;
}

Source write_video(const Shot& shot, const std::filesystem::path& file, int bitrate) {
  const std::filesystem::path raw = file.string() + ".gray";
  std::ofstream pixels(raw, std::ios::binary);
  for (const cv::Mat& frame : shot.frames) {
    const cv::Mat whole = frame.clone();  // rows without gaps
    pixels.write(whole.ptr<char>(), static_cast<std::streamsize>(whole.total()));
  }
  pixels.close();
  const cv::Size size = shot.frames.front().size();
  start_gstreamer();
  const Pipeline pipeline = parse_pipeline(
      "filesrc location=\"" + raw.string() + "\" ! rawvideoparse format=gray8 width=" +
      std::to_string(size.width) + " height=" + std::to_string(size.height) +
      " framerate=" + std::to_string(std::lround(shot.rate)) +
      "/1 ! videoconvert ! video/x-raw,format=I420 ! x264enc bitrate=" + std::to_string(bitrate) +
      " ! mp4mux ! filesink location=\"" + file.string() + "\"");
  gst_element_set_state(pipeline.get(), GST_STATE_PLAYING);
  g_autoptr(GstBus) bus = gst_element_get_bus(pipeline.get());
  g_autoptr(GstMessage) message = gst_bus_timed_pop_filtered(
      bus, 60 * GST_SECOND, static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR));
  if (message == nullptr || GST_MESSAGE_TYPE(message) != GST_MESSAGE_EOS) {
    throw std::runtime_error("cannot write " + file.string());
  }
  Source source;
  source.video = file;
  return source;
}

}  // namespace mtstereo::run
