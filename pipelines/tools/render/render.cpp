// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/render.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tools/render/optics.hpp"
#include "tools/render/processing.hpp"
#include "tools/render/raw.hpp"
#include "tools/render/sensor.hpp"
#include "tools/render/view.hpp"

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

// The light of a pixel: the mean of its rays.
Eigen::Vector3f light_at(const View& view, int samples, int x, int y) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      const double sx = x + (i + 0.5) / samples - 0.5, sy = y + (j + 0.5) / samples - 0.5;
      const auto seen = view.look(sx, sy);
      sum += seen ? Eigen::Vector3f(seen->gray * seen->object->texture.color)
                  : Eigen::Vector3f(view.sky(sx, sy) * Eigen::Vector3f(1.0f, 0.97f, 0.93f));
    }
  }
  return sum / static_cast<float>(samples * samples);
}

// The light that reaches the sensor, in one channel (gray) or three.
cv::Mat light_of(const View& view, const Settings& settings) {
  const bool color = settings.color || settings.mosaic;
  cv::Mat light(settings.height, settings.width, CV_32FC(color ? 3 : 1));
  for_rows(settings.height, settings.threads, [&](int y) {
    auto* out = light.ptr<float>(y);
    for (int x = 0; x < settings.width; ++x) {
      const Eigen::Vector3f seen = light_at(view, settings.samples, x, y);
      if (color) {
        for (int c = 0; c < 3; ++c) *out++ = seen[c];
      } else {
        // ITU-R BT.601 luma
        *out++ = 0.114f * seen[0] + 0.587f * seen[1] + 0.299f * seen[2];
      }
    }
  });
  return after_lens(light, settings.blur, settings.rim_blur);
}

cv::Mat signal_of(const cv::Mat& light, const Settings& settings, const Sensor& sensor) {
  const int channels = light.channels();
  cv::Mat signal(light.size(), light.type());
  for_rows(settings.height, settings.threads, [&](int y) {
    const auto* in = light.ptr<float>(y);
    auto* out = signal.ptr<float>(y);
    for (int x = 0; x < settings.width; ++x) {
      for (int c = 0; c < channels; ++c) *out++ = sensor.signal(*in++, x, y, c);
    }
  });
  return signal;
}

cv::Mat image_of(const cv::Mat& light, const Settings& settings, const Sensor& sensor) {
  cv::Mat signal = signal_of(light, settings, sensor), image;
  if (settings.mosaic) {
    signal = through_mosaic(signal, sensor.medium_noise());
    if (!settings.color) cv::cvtColor(signal, signal, cv::COLOR_BGR2GRAY);
  }
  signal.convertTo(image, CV_8U);
  return settings.jpeg > 0 ? after_jpeg(image, settings.jpeg) : image;
}

enum class Side { kLeft, kRight };

// What a camera of this side sees; the size of the settings is that of its image.
cv::Mat paint(const Scene& scene, double time, const Settings& settings, const Camera& camera,
              Side side) {
  const bool is_right = side == Side::kRight;
  const View view(scene, time, settings, camera);
  const auto moment = std::bit_cast<std::uint64_t>(time);
  const std::uint32_t number = hash(settings.seed, static_cast<std::uint32_t>(moment),
                                    static_cast<std::uint32_t>(moment >> 32));
  const Sensor sensor(settings, hash(number, is_right ? 1 : 0, 0),
                      is_right ? settings.light * settings.exposure : settings.light);
  return image_of(light_of(view, settings), settings, sensor);
}

// Whether the right camera does not see the point of column x_right of its row y with this depth.
bool hidden(const View& right, double x_right, double y, double depth, int width) {
  if (x_right < -0.5 || x_right >= width - 0.5) return true;
  const auto other = right.depth(x_right, y);
  // The ray hits the point's own surface at a depth that differs by rounding errors.
  return other && *other < depth * (1 - 1e-6);
}

void truth_row(int y, const View& left, const View& right, const Rectification& rectification,
               Truth& truth) {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  auto* disparities = truth.disparity.ptr<float>(y);
  auto* depths = truth.depth.ptr<float>(y);
  auto* occluded = truth.occluded.ptr<std::uint8_t>(y);
  for (int x = 0; x < rectification.width; ++x) {
    const auto depth = left.depth(x, y);
    if (!depth) {
      disparities[x] = depths[x] = kNothing;
      occluded[x] = 0;
      continue;
    }
    const double disparity = rectification.focal_length * rectification.baseline / *depth -
                             rectification.principal_offset();
    disparities[x] = static_cast<float>(disparity);
    depths[x] = static_cast<float>(*depth);
    occluded[x] = hidden(right, x - disparity, y, *depth, rectification.width) ? 255 : 0;
  }
}

void require_valid(const Settings& settings) {
  if (const std::string wrong = check(settings); !wrong.empty()) throw std::invalid_argument(wrong);
}

// The settings for a camera with this image.
Settings sized(Settings settings, int width, int height, double focal) {
  settings.width = width, settings.height = height, settings.focal = focal;
  return settings;
}

Settings sized(const Settings& settings, const Rectification& r) {
  return sized(settings, r.width, r.height, r.focal_length);
}

Settings sized(const Settings& settings, const CameraCalibration& c) {
  return sized(settings, c.width, c.height, c.focal_x);
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
      {"vignette", s.vignette, 0, 1, ""},
      {"blur", s.blur, 0, 10, " px"},
      {"rim-blur", s.rim_blur, 0, 10, " px"},
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
  require_valid(given);
  const Settings settings = complete(scene, given);
  const Truth truth = render_truth(scene, time, settings, rectification_of(settings));
  return {paint(scene, time, settings, left_camera(settings), Side::kLeft),
          paint(scene, time, settings, right_camera(settings), Side::kRight), truth.disparity,
          truth.occluded};
}

cv::Mat render_view(const Scene& scene, double time, const Settings& given, bool right) {
  require_valid(given);
  const Settings settings = complete(scene, given);
  return right ? paint(scene, time, settings, right_camera(settings), Side::kRight)
               : paint(scene, time, settings, left_camera(settings), Side::kLeft);
}

RawFrame render_raw(const Scene& scene, double time, const Settings& settings, const RawRig& rig) {
  require_valid(settings);
  const Settings left = sized(settings, rig.calibration.left);
  const Settings right = sized(settings, rig.calibration.right);
  return {paint(scene, time, left, rig.left, Side::kLeft),
          paint(scene, time, right, rig.right, Side::kRight)};
}

Truth render_truth(const Scene& scene, double time, const Settings& given,
                   const Rectification& rectification) {
  require_valid(given);
  const Settings settings = sized(given, rectification);
  const cv::Size size(settings.width, settings.height);
  Truth truth{cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC1), cv::Mat(size, CV_8UC1)};
  const View left(scene, time, settings, rectified_left_camera(rectification));
  const View right(scene, time, settings, rectified_right_camera(rectification));
  for_rows(settings.height, settings.threads,
           [&](int y) { truth_row(y, left, right, rectification, truth); });
  return truth;
}

StereoFrame render_rectified(const Scene& scene, double time, const Settings& given,
                             const Rectification& rectification) {
  const Truth truth = render_truth(scene, time, given, rectification);
  const Settings settings = sized(given, rectification);
  return {paint(scene, time, settings, rectified_left_camera(rectification), Side::kLeft),
          paint(scene, time, settings, rectified_right_camera(rectification), Side::kRight),
          truth.disparity, truth.occluded};
}

std::string calibration_text(const Rectification& r, int disparities) {
  std::ostringstream text;
  text.precision(10);
  const char* name = "cam0";
  for (const double center_x : {r.left_center_x, r.right_center_x}) {
    text << name << "=[" << r.focal_length << " 0 " << center_x << "; 0 " << r.focal_length << ' '
         << r.center_y << "; 0 0 1]\n";
    name = "cam1";
  }
  // Middlebury states the baseline in millimeters.
  text << "doffs=" << r.principal_offset() << "\nbaseline=" << 1000 * r.baseline
       << "\nwidth=" << r.width << "\nheight=" << r.height << "\nndisp=" << disparities << "\n";
  return text.str();
}

}  // namespace mtstereo::render
