// SPDX-License-Identifier: LGPL-2.1-or-later
#include "render/render.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

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

// A normally distributed number with mean 0 and standard deviation 1 that depends only on the
// arguments.
float normal(std::uint32_t frame, std::uint32_t channel, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t place = hash(x, y, channel);
  const double a = 1 - hash_unit(frame, place, 1), b = hash_unit(frame, place, 2);
  return static_cast<float>(std::sqrt(-2 * std::log(a)) * std::cos(2 * std::numbers::pi * b));
}

class Painter {
 public:
  Painter(const View& view, const Settings& settings, std::uint32_t frame, float exposure)
      : view_(view), settings_(settings), frame_(frame), exposure_(exposure) {}

  void row(int y, cv::Mat& image) const {
    auto* out = image.ptr<std::uint8_t>(y);
    for (int x = 0; x < settings_.width; ++x) {
      const Eigen::Vector3f color = pixel(x, y);
      if (settings_.color) {
        for (int c = 0; c < 3; ++c) *out++ = sensor(color[c], x, y, c);
      } else {
        // ITU-R BT.601 luma
        *out++ = sensor(0.114f * color[0] + 0.587f * color[1] + 0.299f * color[2], x, y, 0);
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
        if (seen) {
          sum += seen->gray * seen->object->texture.color;
        } else {
          sum += view_.sky(sy) * Eigen::Vector3f(1.0f, 0.97f, 0.93f);
        }
      }
    }
    return sum / static_cast<float>(n * n);
  }

  std::uint8_t sensor(float value, int x, int y, int channel) const {
    float gray = 255 * exposure_ * value;
    if (settings_.noise > 0) {
      gray += static_cast<float>(settings_.noise) *
              normal(frame_, static_cast<std::uint32_t>(channel), static_cast<std::uint32_t>(x),
                     static_cast<std::uint32_t>(y));
    }
    return cv::saturate_cast<std::uint8_t>(gray);
  }

  const View& view_;
  const Settings& settings_;
  std::uint32_t frame_;
  float exposure_;
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

std::string out_of_range(const char* what, double value, const char* range) {
  std::ostringstream text;
  text << what << " is " << value << "; it must be " << range;
  return text.str();
}

}  // namespace

std::string check(const Settings& s) {
  if (s.width < 1 || s.width > 16384) return out_of_range("width", s.width, "1 to 16384 px");
  if (s.height < 1 || s.height > 16384) return out_of_range("height", s.height, "1 to 16384 px");
  // These comparisons are false for NaN too.
  if (!(s.focal >= 0 && s.focal <= 1e6)) return out_of_range("focal", s.focal, "0 to 1e6 px");
  if (!(s.baseline >= 0 && s.baseline <= 100)) {
    return out_of_range("baseline", s.baseline, "0 to 100 m");
  }
  if (!(s.noise >= 0 && s.noise <= 100)) return out_of_range("noise", s.noise, "0 to 100");
  if (!(s.exposure >= 0.1 && s.exposure <= 10)) {
    return out_of_range("exposure", s.exposure, "0.1 to 10");
  }
  if (s.samples < 1 || s.samples > 8) return out_of_range("samples", s.samples, "1 to 8");
  if (s.threads < 0 || s.threads > 1024) return out_of_range("threads", s.threads, "0 to 1024");
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

  const View left(scene, time, settings, 0);
  const View right(scene, time, settings, settings.baseline);
  const auto moment = std::bit_cast<std::uint64_t>(time);
  const std::uint32_t number = hash(settings.seed, static_cast<std::uint32_t>(moment),
                                    static_cast<std::uint32_t>(moment >> 32));
  const Painter paint_left(left, settings, hash(number, 0, 0), 1);
  const Painter paint_right(right, settings, hash(number, 1, 0),
                            static_cast<float>(settings.exposure));
  for_rows(settings.height, settings.threads, [&](int y) {
    paint_left.row(y, frame.left);
    paint_right.row(y, frame.right);
    truth_row(y, left, right, settings, frame);
  });
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
