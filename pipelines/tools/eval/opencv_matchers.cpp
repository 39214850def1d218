// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/opencv_matchers.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/calib3d.hpp>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::eval {
namespace {

constexpr std::array<std::string_view, 4> kMethodNames{"sgbm", "sgbm-3way", "sgbm-hh", "bm"};

// The settings of OpenCV's own samples and of most users.
constexpr int kSgbmBlock = 5;
constexpr int kP1 = 8 * kSgbmBlock * kSgbmBlock;
constexpr int kP2 = 32 * kSgbmBlock * kSgbmBlock;
constexpr int kDisp12MaxDiff = 1;
constexpr int kSpeckleWindowSize = 100;
constexpr int kSpeckleRange = 2;
constexpr int kPreFilterCap = 63;
constexpr int kBmBlock = 15;

int sgbm_mode(OpenCvMethod method) {
  if (method == OpenCvMethod::kSgbm3Way) return cv::StereoSGBM::MODE_SGBM_3WAY;
  if (method == OpenCvMethod::kSgbmHh) return cv::StereoSGBM::MODE_HH;
  return cv::StereoSGBM::MODE_SGBM;
}

cv::Ptr<cv::StereoMatcher> make_matcher(OpenCvMethod method, int disparities,
                                        int uniqueness_ratio) {
  if (method != OpenCvMethod::kBm) {
    return cv::StereoSGBM::create(0, disparities, kSgbmBlock, kP1, kP2, kDisp12MaxDiff,
                                  kPreFilterCap, uniqueness_ratio, kSpeckleWindowSize,
                                  kSpeckleRange, sgbm_mode(method));
  }
  cv::Ptr<cv::StereoBM> bm = cv::StereoBM::create(disparities, kBmBlock);
  bm->setDisp12MaxDiff(kDisp12MaxDiff);
  bm->setUniquenessRatio(uniqueness_ratio);
  bm->setSpeckleWindowSize(kSpeckleWindowSize);
  bm->setSpeckleRange(kSpeckleRange);
  bm->setPreFilterCap(kPreFilterCap);
  return bm;
}

}  // namespace

struct OpenCvMatcher::State {
  cv::Ptr<cv::StereoMatcher> matcher;
  cv::Mat fixed_point;  // CV_16SC1, px * 16, negative = none
};

std::string_view opencv_name(OpenCvMethod method) {
  return kMethodNames[static_cast<std::size_t>(method)];
}

std::optional<OpenCvMethod> find_opencv(std::string_view name) {
  const auto* const found = std::find(kMethodNames.begin(), kMethodNames.end(), name);
  if (found == kMethodNames.end()) return std::nullopt;
  return static_cast<OpenCvMethod>(found - kMethodNames.begin());
}

std::vector<std::string> opencv_names() { return {kMethodNames.begin(), kMethodNames.end()}; }

int opencv_disparities(int max_disparity) { return (max_disparity + 15) / 16 * 16; }

std::string opencv_settings(OpenCvMethod method, const std::string& uniqueness_ratio) {
  const std::string common =
      "disp12MaxDiff " + std::to_string(kDisp12MaxDiff) + ", uniquenessRatio " + uniqueness_ratio +
      ", speckleWindowSize " + std::to_string(kSpeckleWindowSize) + ", speckleRange " +
      std::to_string(kSpeckleRange) + ", preFilterCap " + std::to_string(kPreFilterCap);
  if (method == OpenCvMethod::kBm) return "block " + std::to_string(kBmBlock) + ", " + common;
  return "block " + std::to_string(kSgbmBlock) + ", P1 " + std::to_string(kP1) + ", P2 " +
         std::to_string(kP2) + ", " + common;
}

OpenCvMatcher::OpenCvMatcher(OpenCvMethod method, int max_disparity, int uniqueness_ratio)
    : state_(std::make_unique<State>()) {
  state_->matcher = make_matcher(method, opencv_disparities(max_disparity), uniqueness_ratio);
}

OpenCvMatcher::~OpenCvMatcher() = default;

void OpenCvMatcher::compute(const cv::Mat& left, const cv::Mat& right) {
  try {
    state_->matcher->compute(left, right, state_->fixed_point);
  } catch (const cv::Exception& error) {
    throw UserError("OpenCV rejects the pair: " + error.err);
  }
}

cv::Mat OpenCvMatcher::disparity() const {
  constexpr int kOnePixel = cv::StereoMatcher::DISP_SCALE;
  cv::Mat result;
  state_->fixed_point.convertTo(result, CV_32F, 1.0 / kOnePixel);
  result.setTo(std::numeric_limits<float>::quiet_NaN(), state_->fixed_point < 0);
  return result;
}

}  // namespace mtstereo::eval
