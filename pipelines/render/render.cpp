// SPDX-License-Identifier: LGPL-2.1-or-later
#include "render/render.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "render/sensor.hpp"
#include "render/view.hpp"

namespace mtstereo::render {
namespace {

// Runs work(row) for every row on several threads, each of which takes the next row when it is
// idle.
void for_rows(int height, int threads, const std::function<void(int)>& work) {
  int count = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
  count = std::clamp(count, 1, height);
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int row = next++; row < height; row = next++) work(row);
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < count; ++i) helpers.emplace_back(run);
  run();
}

class Painter {
 public:
  Painter(const View& view, const Settings& settings, const Sensor& sensor, bool is_right)
      : view_(view), settings_(settings), sensor_(sensor), is_right_(is_right) {}

  void row(int y, cv::Mat& image) const {
    auto* out = image.ptr<std::uint8_t>(y);
    for (int x = 0; x < settings_.width; ++x) {
      const Eigen::Vector3f color = pixel(x, y);
      if (settings_.color) {
        for (int c = 0; c < 3; ++c) *out++ = sensor_.gray(color[c], x, y, c);
      } else {
        // ITU-R BT.601 luma
        const float luma = 0.114f * color[0] + 0.587f * color[1] + 0.299f * color[2];
        *out++ = sensor_.gray(luma, x, y, 0);
      }
    }
  }

 private:
  Eigen::Vector3f pixel(int x, int y) const {
    const int n = settings_.samples;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const double sx = x + (i + 0.5) / n - 0.5, sy = y + (j + 0.5) / n - 0.5;
        const auto seen = view_.look(sx, sy);
        sum += seen ? Eigen::Vector3f(seen->gray * seen->object->texture.color) : sky(sx, sy);
      }
    }
    return sum / static_cast<float>(n * n);
  }

  Eigen::Vector3f sky(double x, double y) const {
    const cv::Point2d at = is_right_ ? ideal_pixel(settings_, x, y) : cv::Point2d(x, y);
    return view_.sky(at.x, at.y) * Eigen::Vector3f(1.0f, 0.97f, 0.93f);
  }

  const View& view_;
  const Settings& settings_;
  const Sensor& sensor_;
  bool is_right_;
};

// Whether the right camera sees the point at (x, y) of the left image with this depth.
bool hidden(const View& right, double x, double y, double depth, const Settings& settings) {
  const double x_right = x - settings.focal * settings.baseline / depth;
  if (x_right < -0.5 || x_right >= settings.width - 0.5) return true;
  const auto other = right.depth(x_right, y);
  // The ray hits the point's own surface at a depth that differs by rounding errors.
  return other && *other < depth * (1 - 1e-6);
}

void truth_row(int y, const View& left, const View& right, const Settings& settings,
               StereoFrame& frame) {
  auto* truth = frame.truth.ptr<float>(y);
  auto* occluded = frame.occluded.ptr<std::uint8_t>(y);
  for (int x = 0; x < settings.width; ++x) {
    const auto depth = left.depth(x, y);
    truth[x] = depth ? static_cast<float>(settings.focal * settings.baseline / *depth)
                     : std::numeric_limits<float>::infinity();
    occluded[x] = depth && hidden(right, x, y, *depth, settings) ? 255 : 0;
  }
}

struct Limit {
  const char* name;
  double value, low, high;
  const char* unit;
};

std::string sentence(const Limit& limit) {
  std::ostringstream text;
  text << limit.name << " is " << limit.value << "; it must be " << limit.low << " to "
       << limit.high << limit.unit;
  return text.str();
}

}  // namespace

std::string check(const Settings& s) {
  const Limit limits[] = {
      {"width", static_cast<double>(s.width), 1, 16384, " px"},
      {"height", static_cast<double>(s.height), 1, 16384, " px"},
      {"focal", s.focal, 0, 1e6, " px"},
      {"baseline", s.baseline, 0, 100, " m"},
      {"noise", s.noise, 0, 100, ""},
      {"shot-noise", s.shot_noise, 0, 10, ""},
      {"light", s.light, 0.001, 1000, ""},
      {"gain", s.gain, 0.1, 100, ""},
      {"exposure", s.exposure, 0.1, 10, ""},
      {"sky", s.sky, 0, 100, ""},
      {"sky-gradient", s.sky_gradient, 0, 1, ""},
      {"vignette", s.vignette, 0, 1, ""},
      {"jpeg", static_cast<double>(s.jpeg), 0, 100, ""},
      {"roll", s.rig.roll, -10, 10, " degrees"},
      {"pitch", s.rig.pitch, -10, 10, " degrees"},
      {"yaw", s.rig.yaw, -10, 10, " degrees"},
      {"focal-ratio", s.rig.focal_ratio, 0.9, 1.1, ""},
      {"row-offset", s.rig.row_offset, -100, 100, " px"},
      {"samples", static_cast<double>(s.samples), 1, 8, ""},
      {"threads", static_cast<double>(s.threads), 0, 1024, ""},
  };
  for (const Limit& limit : limits) {
    // The comparisons are false for NaN too.
    if (!(limit.value >= limit.low && limit.value <= limit.high)) return sentence(limit);
  }
  return "";
}

Settings complete(const Scene& scene, Settings settings) {
  if (settings.focal == 0) settings.focal = scene.focal_per_width * settings.width;
  if (settings.baseline == 0) settings.baseline = scene.baseline;
  return settings;
}

StereoFrame render(const Scene& scene, double time, const Settings& given) {
  if (const std::string wrong = check(given); !wrong.empty()) throw std::invalid_argument(wrong);
  const Settings settings = complete(scene, given);
  const int type = settings.color ? CV_8UC3 : CV_8UC1;
  const cv::Size size(settings.width, settings.height);
  StereoFrame frame{cv::Mat(size, type), cv::Mat(size, type), cv::Mat(size, CV_32FC1),
                    cv::Mat(size, CV_8UC1)};

  const View left(scene, time, settings, left_camera(settings));
  const View ideal_right(scene, time, settings, ideal_right_camera(settings));
  const View right(scene, time, settings, right_camera(settings));
  const auto moment = std::bit_cast<std::uint64_t>(time);
  const std::uint32_t number = hash(settings.seed, static_cast<std::uint32_t>(moment),
                                    static_cast<std::uint32_t>(moment >> 32));
  const Sensor left_sensor(settings, hash(number, 0, 0), settings.light);
  const Sensor right_sensor(settings, hash(number, 1, 0), settings.light * settings.exposure);
  const Painter paint_left(left, settings, left_sensor, false);
  const Painter paint_right(right, settings, right_sensor, true);
  for_rows(settings.height, settings.threads, [&](int y) {
    paint_left.row(y, frame.left);
    paint_right.row(y, frame.right);
    truth_row(y, left, ideal_right, settings, frame);
  });
  if (settings.jpeg > 0) {
    frame.left = after_jpeg(frame.left, settings.jpeg);
    frame.right = after_jpeg(frame.right, settings.jpeg);
  }
  return frame;
}

std::string calibration_text(const Settings& s, int disparities) {
  std::ostringstream text;
  text.precision(10);
  for (const char* camera : {"cam0", "cam1"}) {
    text << camera << "=[" << s.focal << " 0 " << (s.width - 1) / 2.0 << "; 0 " << s.focal << ' '
         << (s.height - 1) / 2.0 << "; 0 0 1]\n";
  }
  // Middlebury states the baseline in millimeters.
  text << "doffs=0\nbaseline=" << 1000 * s.baseline << "\nwidth=" << s.width
       << "\nheight=" << s.height << "\nndisp=" << disparities << "\n";
  return text.str();
}

}  // namespace mtstereo::render
