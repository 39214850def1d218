// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mtstereo::eval {

/// How a pair is degraded before matching. The disparities of the ground truth remain valid.
enum class DegradationKind {
  kNoise,       ///< Gaussian noise in both views; amount: standard deviation [gray values]
  kJpeg,        ///< JPEG compression of both views; amount: quality, a whole number
  kH264,        ///< H.264 compression, each view in its own stream; amount: quantizer, whole
  kDark,        ///< both views times the amount, then noise of standard deviation 2
  kBright,      ///< both views times the amount; values above 255 saturate
  kBlurRight,   ///< the right view out of focus; amount: sigma of the Gaussian [px]
  kLowerRight,  ///< the content of the right view moved down; amount [px]
  kRollRight,   ///< the right view rotated about its center; amount: clockwise [degrees]
  kGainRight,   ///< the right view times the amount; values above 255 saturate
  kGammaRight,  ///< the right view with another response; amount: exponent of value / 255
};

/// The name of images that are not degraded, beside degradation_text().
inline constexpr const char* kCleanKind = "clean";

/// One degradation with its amount.
struct Degradation {
  DegradationKind kind = DegradationKind::kNoise;
  double amount = 0;
};

/// All kinds with the ranges of their amounts, for the help and the documentation.
std::string degradation_kinds();

/// Parses "KIND=AMOUNT", as in "noise=5". Throws InputError, naming the kinds or the range of the
/// amount.
Degradation parse_degradation(std::string_view text);

/// The reason why a degradation cannot be applied on this machine, and what to install; none if it
/// can.
std::optional<std::string> degradation_obstacle(const Degradation& degradation);

/// The text that parse_degradation() reads.
std::string degradation_text(const Degradation& degradation);

/// Adds Gaussian noise to an 8-bit image. The seed determines the noise.
void add_noise(double sigma, std::uint64_t seed, cv::Mat& image);

/// Degrades both views, CV_8UC1 of the same size, in place. The result depends on the arguments
/// only: seeds are fixed, and the noise of the two views differs. Throws InputError if a part that
/// the kind needs is missing, see degradation_obstacle().
void degrade(const Degradation& degradation, cv::Mat& left, cv::Mat& right);

}  // namespace mtstereo::eval
