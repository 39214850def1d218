// SPDX-License-Identifier: LGPL-2.1-or-later
// From rendered raw cameras to meters: mtrectify with the exact calibration, mtstereo, mtdepth.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "support/pipeline.hpp"
#include "support/sanitizers.hpp"
#include "support/temporary_folder.hpp"
#include "support/wall_scene.hpp"
#include "tools/eval/metrics.hpp"
#include "tools/render/raw.hpp"

namespace mtstereo::chain_test {
namespace {

using render::RawRig;
using render::Settings;
using test::TemporaryFolder;

constexpr int kWidth = 480, kHeight = 270;

Settings camera() {
  Settings s;
  s.width = kWidth, s.height = kHeight, s.focal = 0.85 * kWidth, s.baseline = 0.1;
  s.samples = 1;  // textures are as soft as a pixel is wide, with one ray too
  return s;
}

// Raw cameras with the rectification of rectify().
RawRig rig_of(const std::string& lens, const Settings& settings) {
  StereoCalibration calibration = render::built_in_rig(lens, settings);
  const Result<Rectification> rectification = rectify(calibration);
  EXPECT_TRUE(rectification) << rectification.error().message;
  calibration.rectification = *rectification;
  return RawRig(calibration);
}

// What the elements made of the frames.
struct Results {
  std::vector<cv::Mat> left, right;  // rectified views, CV_8UC1
  std::vector<cv::Mat> disparity;    // CV_32FC1 [px], NaN = none
  std::vector<cv::Mat> depth;        // CV_32FC1 [m], 0 = none
};

cv::Mat image_of(const test::Sample& sample, int bytes) {
  const cv::Size size(kWidth, kHeight);
  const std::size_t stride = sample.bytes.size() / kHeight;
  EXPECT_EQ(stride * kHeight, sample.bytes.size());
  cv::Mat image(size, bytes == 1 ? CV_8UC1 : CV_16UC1);
  for (int y = 0; y < kHeight; ++y) {
    std::memcpy(image.ptr(y), sample.bytes.data() + static_cast<std::size_t>(y) * stride,
                static_cast<std::size_t>(kWidth) * static_cast<std::size_t>(bytes));
  }
  return image;
}

cv::Mat disparity_of(const test::Sample& sample) {
  const char* field = std::strstr(sample.caps.c_str(), "disparity-scale=(int)");
  EXPECT_NE(field, nullptr) << sample.caps;
  const double scale = field == nullptr ? 1 : std::atof(std::strchr(field, ')') + 1);
  cv::Mat values;
  image_of(sample, 2).convertTo(values, CV_32FC1, 1 / scale);
  values.setTo(std::numeric_limits<float>::quiet_NaN(), values == 0);
  return values;
}

cv::Mat depth_of(const test::Sample& sample) {
  cv::Mat values;
  image_of(sample, 2).convertTo(values, CV_32FC1, 0.001);
  return values;
}

// Writes the frames of one side as raw video.
void write_views(const std::filesystem::path& file, const std::vector<cv::Mat>& views) {
  std::ofstream out(file, std::ios::binary);
  for (const cv::Mat& view : views) {
    ASSERT_TRUE(view.isContinuous() && view.size() == cv::Size(kWidth, kHeight));
    out.write(reinterpret_cast<const char*>(view.data), static_cast<std::streamsize>(view.total()));
  }
}

// One side of the pipeline, up to the matcher.
std::string side(const TemporaryFolder& folder, const std::string& name, bool raw) {
  const std::string rectifier =
      raw ? " ! mtrectify camera=" + name + " calibration=" + (folder / "calibration.yml").string()
          : "";
  return "filesrc location=" + (folder / name).string() +
         " ! rawvideoparse format=gray8 width=" + std::to_string(kWidth) +
         " height=" + std::to_string(kHeight) + " framerate=10/1" + rectifier +
         " ! tee name=" + name + "_views ! queue ! m.sink_" + name + " " + name +
         "_views. ! queue ! appsink wait-on-eos=false sync=false name=" + name + " ";
}

// Sends frames through the elements. `rig`: the cameras of raw views; null = the views are
// rectified already, and have no depth.
Results run(const std::vector<render::StereoFrame>& frames, const RawRig* rig) {
  const TemporaryFolder folder;
  std::vector<cv::Mat> left, right;
  for (const render::StereoFrame& frame : frames) {
    left.push_back(frame.left);
    right.push_back(frame.right);
  }
  write_views(folder / "left", left);
  write_views(folder / "right", right);
  std::string launch =
      "mtstereo name=m max-disparity=64 ! tee name=maps ! queue ! "
      "appsink wait-on-eos=false sync=false name=disparity ";
  if (rig != nullptr) {
    const Status written =
        write_calibration(rig->calibration, (folder / "calibration.yml").string());
    EXPECT_TRUE(written) << written.error().message;
    launch += "maps. ! queue ! mtdepth ! appsink wait-on-eos=false sync=false name=depth ";
  }
  launch += side(folder, "left", rig != nullptr) + side(folder, "right", rig != nullptr);
  test::Pipeline pipeline(launch);
  EXPECT_EQ(pipeline.run(), "");
  Results results;
  for (const auto& sample : pipeline.samples("left")) results.left.push_back(image_of(sample, 1));
  for (const auto& sample : pipeline.samples("right")) results.right.push_back(image_of(sample, 1));
  for (const auto& sample : pipeline.samples("disparity")) {
    results.disparity.push_back(disparity_of(sample));
  }
  if (rig != nullptr) {
    for (const auto& sample : pipeline.samples("depth")) results.depth.push_back(depth_of(sample));
  }
  return results;
}

render::StereoFrame raw_frame(const render::Scene& scene, const Settings& s, const RawRig& rig) {
  const render::RawFrame raw = render::render_raw(scene, 0, s, rig);
  return {raw.left, raw.right, {}, {}};
}

// The value below which this part of the values is.
double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

class Chain : public testing::TestWithParam<std::string> {};

TEST_P(Chain, DepthsOfWallsAreWithinOnePercent) {
  const Settings s = camera();
  const RawRig rig = rig_of(GetParam(), s);
  const Rectification& rectification = *rig.calibration.rectification;
  // At the far limit, the disparity is 1 px.
  const double far = rectification.focal_length * rectification.baseline;
  std::vector<render::Scene> scenes;
  for (const double part : {4, 6, 10, 20}) {
    scenes.push_back(test::wall_scene(far / part));
  }
  scenes.push_back(test::wall_scene(far / 10, 30));
  std::vector<render::StereoFrame> frames;
  for (const render::Scene& scene : scenes) frames.push_back(raw_frame(scene, s, rig));
  const Results results = run(frames, &rig);
  ASSERT_EQ(results.depth.size(), frames.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const cv::Mat truth = render::render_truth(scenes[i], 0, s, rectification).depth;
    std::vector<double> errors, sizes;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double depth = results.depth[i].at<float>(y, x);
        if (depth == 0) continue;
        errors.push_back(depth / truth.at<float>(y, x) - 1);
        sizes.push_back(std::abs(errors.back()));
      }
    }
    const double bias = quantile(errors, 0.5), usual = quantile(sizes, 0.5);
    std::printf(
        "%s, far limit %.2f m, wall %zu at %.2f m: median error %+.2f %%, median of |error| "
        "%.2f %%, 95 %% below %.2f %%, density %.1f %%\n",
        GetParam().c_str(), far, i, truth.at<float>(kHeight / 2, kWidth / 2), 100 * bias,
        100 * usual, 100 * quantile(sizes, 0.95),
        100.0 * static_cast<double>(sizes.size()) / (kWidth * kHeight));
    EXPECT_LT(std::abs(bias), 0.01);
    EXPECT_LT(usual, 0.01);
    EXPECT_GT(static_cast<double>(sizes.size()), 0.9 * kWidth * kHeight);
  }
}

// The vertical displacement of a patch of an image against the ideal one, by Lucas and Kanade's
// method [px]; infinity where there is too little texture.
double row_error(const cv::Mat& image, const cv::Mat& ideal, int x0, int y0) {
  constexpr int kHalf = 7;
  double dx = 0, dy = 0;
  for (int iteration = 0; iteration < 6; ++iteration) {
    double xx = 0, xy = 0, yy = 0, xe = 0, ye = 0;
    for (int y = y0 - kHalf; y <= y0 + kHalf; ++y) {
      for (int x = x0 - kHalf; x <= x0 + kHalf; ++x) {
        const double u = x + dx, v = y + dy;
        const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
        const double a = u - i, b = v - j;
        const double value =
            (1 - b) * ((1 - a) * image.at<float>(j, i) + a * image.at<float>(j, i + 1)) +
            b * ((1 - a) * image.at<float>(j + 1, i) + a * image.at<float>(j + 1, i + 1));
        const double gx = (ideal.at<float>(y, x + 1) - ideal.at<float>(y, x - 1)) / 2;
        const double gy = (ideal.at<float>(y + 1, x) - ideal.at<float>(y - 1, x)) / 2;
        const double error = value - ideal.at<float>(y, x);
        xx += gx * gx, xy += gx * gy, yy += gy * gy, xe += gx * error, ye += gy * error;
      }
    }
    const double determinant = xx * yy - xy * xy;
    if (yy < 15.0 * (2 * kHalf + 1) * (2 * kHalf + 1) || determinant < 0.1 * xx * yy) break;
    dx -= (yy * xe - xy * ye) / determinant;
    dy -= (xx * ye - xy * xe) / determinant;
    if (std::abs(dx) > 2 || std::abs(dy) > 2) break;
    if (iteration == 5) return dy;
  }
  return std::numeric_limits<double>::infinity();
}

// The errors of the rows of all patches with texture [px].
std::vector<double> row_errors(const cv::Mat& image, const cv::Mat& ideal) {
  cv::Mat a, b;
  image.convertTo(a, CV_32F);
  ideal.convertTo(b, CV_32F);
  std::vector<double> errors;
  for (int y = 12; y < kHeight - 12; y += 6) {
    for (int x = 12; x < kWidth - 12; x += 6) {
      const double error = row_error(a, b, x, y);
      if (std::isfinite(error)) errors.push_back(std::abs(error));
    }
  }
  return errors;
}

TEST_P(Chain, RectifiedRowsAreThoseOfTheTruth) {
  const Settings s = camera();
  const RawRig rig = rig_of(GetParam(), s);
  const render::Scene scene = test::wall_scene(3);
  const Results results = run({raw_frame(scene, s, rig)}, &rig);
  ASSERT_EQ(results.left.size(), 1U);
  ASSERT_EQ(results.right.size(), 1U);
  const render::StereoFrame ideal =
      render::render_rectified(scene, 0, s, *rig.calibration.rectification);
  for (const auto& [view, expected] :
       {std::pair(results.left[0], ideal.left), std::pair(results.right[0], ideal.right)}) {
    const std::vector<double> errors = row_errors(view, expected);
    std::printf("%s: rows of %zu patches, median error %.3f px, 95 %% below %.3f px\n",
                GetParam().c_str(), errors.size(), quantile(errors, 0.5), quantile(errors, 0.95));
    EXPECT_GT(errors.size(), 800U);
    EXPECT_LT(quantile(errors, 0.95), 0.15);
  }
  // A third of a pixel is found.
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, 0, 0, 1, 1.0 / 3);
  cv::Mat lower;
  cv::warpAffine(ideal.left, lower, shift, ideal.left.size());
  EXPECT_NEAR(quantile(row_errors(lower, ideal.left), 0.5), 1.0 / 3, 0.05);
}

TEST_P(Chain, MappingOfTheRectifierIsExact) {
  const Settings s = camera();
  const RawRig rig = rig_of(GetParam(), s);
  const Rectification& r = *rig.calibration.rectification;
  const auto left = Rectifier::create(rig.calibration, r, Rectifier::Side::kLeft);
  const auto right = Rectifier::create(rig.calibration, r, Rectifier::Side::kRight);
  ASSERT_TRUE(left && right);
  const render::Camera ideal_left = render::rectified_left_camera(r);
  const render::Camera ideal_right = render::rectified_right_camera(r);
  for (int y = 0; y < kHeight; y += 10) {
    for (int x = 0; x < kWidth; x += 10) {
      const Eigen::Vector3d a = ideal_left.pose * Eigen::Vector3d(2 * ideal_left.direction(x, y));
      const Eigen::Vector3d b = ideal_right.pose * Eigen::Vector3d(2 * ideal_right.direction(x, y));
      const cv::Point2d raw_left = rig.left.pixel_of(a), raw_right = rig.right.pixel_of(b);
      ASSERT_NEAR(left->source_of(x, y)[0], raw_left.x, 1e-6) << x << ", " << y;
      ASSERT_NEAR(left->source_of(x, y)[1], raw_left.y, 1e-6) << x << ", " << y;
      ASSERT_NEAR(right->source_of(x, y)[0], raw_right.x, 1e-6) << x << ", " << y;
      ASSERT_NEAR(right->source_of(x, y)[1], raw_right.y, 1e-6) << x << ", " << y;
    }
  }
}

// The mean over the pairs of D-all [%] and density [%].
std::array<double, 2> accuracy(const std::vector<cv::Mat>& disparities,
                               const std::vector<cv::Mat>& truths) {
  std::array<double, 2> sum{};
  for (std::size_t i = 0; i < disparities.size(); ++i) {
    const eval::Evaluation e = eval::evaluate(disparities[i], eval::GroundTruth{truths[i], {}});
    sum[0] += e.all.d_all / static_cast<double>(disparities.size());
    sum[1] += e.density / static_cast<double>(disparities.size());
  }
  return sum;
}

TEST_P(Chain, RawPairIsMatchedAsWellAsAnIdealOne) {
  if (test::kSanitized) GTEST_SKIP() << "18 pairs take too long with a sanitizer";
  const Settings s = camera();
  const RawRig rig = rig_of(GetParam(), s);
  std::vector<render::StereoFrame> raw, ideal;
  std::vector<cv::Mat> truths;
  // A single pair has too few errors for a comparison.
  for (const std::uint32_t seed : {1, 2, 3}) {
    for (const std::string& name : render::scene_names()) {
      const render::Scene scene = render::make_scene(name, seed);
      raw.push_back(raw_frame(scene, s, rig));
      ideal.push_back(render::render_rectified(scene, 0, s, *rig.calibration.rectification));
      truths.push_back(ideal.back().truth.clone());
      for (float& disparity : cv::Mat_<float>(truths.back())) {
        if (!std::isfinite(disparity)) disparity = std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
  const Results of_raw = run(raw, &rig), of_ideal = run(ideal, nullptr);
  ASSERT_EQ(of_raw.disparity.size(), raw.size());
  ASSERT_EQ(of_ideal.disparity.size(), raw.size());
  const auto [raw_error, raw_density] = accuracy(of_raw.disparity, truths);
  const auto [ideal_error, ideal_density] = accuracy(of_ideal.disparity, truths);
  std::printf("%s: D-all %.2f %% and density %.1f %%; without distortion %.2f %% and %.1f %%\n",
              GetParam().c_str(), raw_error, raw_density, ideal_error, ideal_density);
  // Few pixels are wrong, so that the errors of a few decide.
  EXPECT_LT(raw_error, 1.1 * ideal_error + 0.15);
  EXPECT_GT(raw_density, ideal_density - 2.5);
}

INSTANTIATE_TEST_SUITE_P(Lenses, Chain, testing::ValuesIn(render::rig_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace mtstereo::chain_test
