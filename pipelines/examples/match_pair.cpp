// SPDX-License-Identifier: LGPL-2.1-or-later
// match-pair: a complete program with the library. It matches two rectified images as the element
// mtstereo does, and writes the disparities and their confidence as images.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <mtstereo/mtstereo.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace {

constexpr int kScale = 256;  // px = value / 256 in the disparity image, as in KITTI

void require(const mtstereo::Status& status) {
  if (!status) throw std::runtime_error(status.error().message);
}

template <typename T>
T value_of(mtstereo::Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result.value());
}

cv::Mat read_gray(const std::string& file) {
  cv::Mat gray = cv::imread(file, cv::IMREAD_GRAYSCALE);
  if (gray.empty()) throw std::runtime_error(file + " is missing or not an image");
  return gray;
}

void write(const std::string& file, const cv::Mat& image) {
  if (!cv::imwrite(file, image)) throw std::runtime_error(file + " cannot be written");
}

// The pixels stay those of the image, which must live longer than the view.
mtstereo::GrayView view_of(const cv::Mat& gray) {
  return {gray.data, gray.cols, gray.rows, static_cast<std::ptrdiff_t>(gray.step)};
}

void report(const mtstereo::AlignmentTracker& tracker, double density, int width, int height) {
  const mtstereo::ViewCorrection& correction = tracker.correction();
  std::printf("density %.1f %%, rows corrected by up to %.2f px, blur %.2f and %.2f px\n",
              100 * density, correction.rows.largest(width, height),
              static_cast<double>(correction.left_blur),
              static_cast<double>(correction.right_blur));
  for (int i = 0; i < mtstereo::kPairProblems; ++i) {
    const auto problem = static_cast<mtstereo::PairProblem>(i);
    if (tracker.has(problem)) std::printf("%s\n", mtstereo::problem_text(problem));
  }
}

void match(const std::string& left_file, const std::string& right_file,
           const std::string& max_disparity, const std::string& disparity_file,
           const std::string& confidence_file) {
  const cv::Mat left_image = read_gray(left_file), right_image = read_gray(right_file);
  const mtstereo::GrayView left = view_of(left_image), right = view_of(right_image);

  mtstereo::Parameters parameters;
  require(parameters.set(mtstereo::Parameter::kMaxDisparity, max_disparity));
  auto matcher = value_of(mtstereo::Matcher::create(parameters));
  auto tracker = value_of(mtstereo::AlignmentTracker::create());

  // For a video: watch() every pair, inspect() the first one and then every 30th, and keep both
  // objects.
  require(tracker.watch(left, right));
  require(tracker.inspect(left, right, parameters.integer(mtstereo::Parameter::kMaxDisparity)));
  require(matcher.set_correction(tracker.correction()));
  const mtstereo::FrameResult result = value_of(matcher.compute(left, right));
  const mtstereo::DisparityView& map = result.disparity;

  cv::Mat disparity(left_image.size(), CV_16U);
  require(mtstereo::write_disparity16(map, kScale,
                                      {disparity.ptr<std::uint16_t>(), map.width, map.height,
                                       static_cast<std::ptrdiff_t>(disparity.step)}));
  write(disparity_file, disparity);

  // The matcher owns the confidence, as it owns the map, until the next pair.
  const mtstereo::GrayView& confidence = result.confidence;
  const cv::Mat shown(confidence.height, confidence.width, CV_8U,
                      const_cast<std::uint8_t*>(confidence.data),
                      static_cast<std::size_t>(confidence.stride));
  write(confidence_file, shown);
  report(tracker, result.statistics.density, left.width, left.height);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fputs("usage: match-pair LEFT RIGHT MAX_DISPARITY DISPARITY.png CONFIDENCE.png\n", stderr);
    return 2;
  }
  try {
    match(argv[1], argv[2], argv[3], argv[4], argv[5]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "match-pair: %s\n", error.what());
    return 1;
  }
}
