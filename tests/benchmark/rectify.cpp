// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-benchmark-rectify: the time that a view of a raw camera takes to be rectified, and that
// of OpenCV's remap() with the same maps. Both use one thread.
#include <benchmark/benchmark.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "mtstereo/geometry/rectification.hpp"
#include "tools/render/raw.hpp"
#include "tools/render/render.hpp"

namespace {

using mtstereo::CameraCalibration;
using mtstereo::Rectification;
using mtstereo::Rectifier;
using mtstereo::StereoCalibration;

/// The left camera of the renderer's rig `wide`, and its rectified one.
struct LeftCamera {
  explicit LeftCamera(cv::Size size) {
    mtstereo::render::Settings settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.baseline = 0.3;
    calibration = mtstereo::render::built_in_rig("wide", settings);
    rectification = mtstereo::rectify(calibration).value();
  }

  StereoCalibration calibration;
  Rectification rectification;
};

cv::Mat noise(cv::Size size, int channels) {
  cv::Mat image(size, CV_8UC(channels));
  cv::RNG(1).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

void rectify(benchmark::State& state, cv::Size size, int channels) {
  const LeftCamera camera(size);
  Rectifier rectifier = std::move(
      Rectifier::create(camera.calibration, camera.rectification, Rectifier::Side::kLeft).value());
  const cv::Mat in = noise(size, channels);
  cv::Mat out(size, in.type());
  for ([[maybe_unused]] auto step : state) {
    const auto in_stride = static_cast<std::ptrdiff_t>(in.step);
    const auto out_stride = static_cast<std::ptrdiff_t>(out.step);
    const auto done = rectifier.apply({in.data, size.width, size.height, in_stride},
                                      {out.data, size.width, size.height, out_stride}, channels);
    if (!done) state.SkipWithError(done.error().message.c_str());
  }
}

void remap(benchmark::State& state, cv::Size size, int channels) {
  const LeftCamera camera(size);
  const CameraCalibration& left = camera.calibration.left;
  const Rectification& r = camera.rectification;
  const cv::Matx33d k(left.focal_x, 0, left.center_x, 0, left.focal_y, left.center_y, 0, 0, 1);
  const cv::Matx33d p(r.focal_length, 0, r.left_center_x, 0, r.focal_length, r.center_y, 0, 0, 1);
  cv::Mat positions, weights;
  cv::initUndistortRectifyMap(k, left.coefficients, cv::Matx33d(r.left_rotation.data()), p, size,
                              CV_16SC2, positions, weights);
  const cv::Mat in = noise(size, channels);
  cv::Mat out(size, in.type());
  for ([[maybe_unused]] auto step : state) {
    cv::remap(in, out, positions, weights, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  }
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(1280, 720), cv::Size(1920, 1080)}) {
    for (const int channels : {1, 3, 4}) {
      const std::string name = "/" + std::to_string(size.width) + "x" +
                               std::to_string(size.height) +
                               "/channels:" + std::to_string(channels);
      benchmark::RegisterBenchmark(("rectify" + name).c_str(), rectify, size, channels)
          ->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark(("remap" + name).c_str(), remap, size, channels)
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
