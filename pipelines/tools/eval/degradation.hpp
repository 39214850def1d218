// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mtstereo::eval {

/// How a pair is degraded before matching. degrade() describes what happens to its truth.
enum class DegradationKind {
  kNoise,       ///< Gaussian noise in both views; amount: standard deviation [gray values]
  kJpeg,        ///< JPEG compression of both views; amount: quality, a whole number
  kH264,        ///< H.264 compression, each view in its own stream; amount: quantizer, whole
  kDark,        ///< both views times the amount, then noise of standard deviation 2
  kBright,      ///< both views times the amount; values above 255 saturate
  kBlur,        ///< both views out of focus; amount: sigma of the Gaussian [px]
  kRim,         ///< both views blurred more and more toward the corners
  kSoft2x,      ///< both views enlarged 2x
  kSoft1_5x,    ///< both views enlarged 1.5x
  kCam,         ///< a soft camera: blur of 1.2 px, noise of 2, JPEG of quality 70
  kCam2x,       ///< enlarged 2x, then as kCam
  kCam1_5x,     ///< enlarged 1.5x, then as kCam
  kRimCam,      ///< kRim, then noise of 2 and JPEG of quality 70
  kCamH264,     ///< as kCam, but H.264 instead of JPEG; amount: quantizer, whole
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
  double amount = 0;  ///< 0 for a kind that has none
};

/// All kinds with the ranges of their amounts, for the help and the documentation.
std::string degradation_kinds();

/// Parses "KIND=AMOUNT", as in "noise=5", or "KIND" for a kind without an amount, as in "cam".
/// Throws UserError, naming the kinds or the range of the amount.
Degradation parse_degradation(std::string_view text);

/// The text that parse_degradation() reads.
std::string degradation_text(const Degradation& degradation);

/// The reason why a degradation cannot be applied on this machine, and what to install; none if it
/// can.
std::optional<std::string> degradation_obstacle(const Degradation& degradation);

}  // namespace mtstereo::eval
