// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mtstereo::eval {

/// The matchers of OpenCV that the option --compare runs on the same pairs.
enum class OpenCvMethod {
  kSgbm,      ///< StereoSGBM, 5 directions
  kSgbm3Way,  ///< StereoSGBM, 3 directions, in parallel
  kSgbmHh,    ///< StereoSGBM, 8 directions, two passes
  kBm,        ///< StereoBM
};

std::string_view opencv_name(OpenCvMethod method);
std::optional<OpenCvMethod> find_opencv(std::string_view name);
std::vector<std::string> opencv_names();

/// The number of disparities that OpenCV searches for a search range: rounded up to a multiple
/// of 16.
int opencv_disparities(int max_disparity);

/// The value of uniquenessRatio in the comparison [%].
inline constexpr int kUniquenessRatio = 10;

/// The settings in one line, for the report, with this text as uniquenessRatio.
std::string opencv_settings(OpenCvMethod method,
                            const std::string& uniqueness_ratio = std::to_string(kUniquenessRatio));

/// Runs a matcher on two 8-bit gray images. The result is CV_32FC1 [px], NaN = none.
class OpenCvMatcher {
 public:
  OpenCvMatcher(OpenCvMethod method, int max_disparity, int uniqueness_ratio = kUniquenessRatio);
  ~OpenCvMatcher();
  OpenCvMatcher(const OpenCvMatcher&) = delete;
  OpenCvMatcher& operator=(const OpenCvMatcher&) = delete;

  /// The timed part. Throws UserError if OpenCV rejects the images.
  void compute(const cv::Mat& left, const cv::Mat& right);
  /// The last result.
  cv::Mat disparity() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mtstereo::eval
