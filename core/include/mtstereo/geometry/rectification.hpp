// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mtstereo/export.hpp"
#include "mtstereo/geometry/calibration.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/result.hpp"

// From calibrated cameras to rectified views.

namespace mtstereo {

/// How rectify() chooses the rectified cameras.
struct RectificationOptions {
  /// 0: only pixels that both cameras see are kept, the image is cropped; 1: all pixels of both
  /// cameras are kept, with empty borders; values between are between. kKeepScale: the focal length
  /// of the cameras is kept.
  double alpha = 0;
  int width = 0;   ///< of the rectified images [px]; 0 = as the cameras
  int height = 0;  ///< of the rectified images [px]; 0 = as the cameras
  /// The principal points of both views get the same column, so that points at infinity have the
  /// disparity 0. Otherwise the views are moved to share as much of the scene as possible.
  bool zero_disparity = true;
  /// Take the rectification of the file, if it states one and no other option differs from its
  /// default.
  bool from_file = true;

  /// True if all are equal.
  friend bool operator==(const RectificationOptions&, const RectificationOptions&) = default;
};

/// The value of RectificationOptions::alpha that keeps the focal length of the cameras.
inline constexpr double kKeepScale = -1;

/// The rectification of a calibration. Two polynomial lenses (kNone, kPlumbBob) get the result of
/// OpenCV's stereoRectify() if OpenCV can invert them everywhere in the image. For all others, what
/// the lens model does not cover is left out (a polynomial turns back far from its axis), and so is
/// what is 85 degrees or more away from the axis of the rectified views; with alpha = 0 their sides
/// are at most 70 degrees away. rectification_remarks() states that. Fails with kInvalidCalibration
/// if the cameras cannot be rectified (a baseline along the optical axis, a vertical or reversed
/// one, views that have nothing in common), and with kInvalidParameter if an option is out of
/// range.
MTSTEREO_API Result<Rectification> rectify(const StereoCalibration& calibration,
                                           const RectificationOptions& options = {}) noexcept;

/// The columns of one row whose pixels are inside of the camera's image: begin .. end - 1. Empty
/// rows have begin = end.
struct ValidColumns {
  int begin = 0;  ///< [px]
  int end = 0;    ///< [px]
  /// True if both are equal.
  friend bool operator==(const ValidColumns&, const ValidColumns&) = default;
};

/// A rectangle of pixels.
struct PixelRectangle {
  int x = 0;       ///< first column [px]
  int y = 0;       ///< first row [px]
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  /// True if all are equal.
  friend bool operator==(const PixelRectangle&, const PixelRectangle&) = default;
};

/// Resamples the views of one camera to the rectified image. Made once for a size; apply() may be
/// called by one thread at a time.
class MTSTEREO_API Rectifier {
 public:
  /// The side of a view.
  enum class Side { kLeft, kRight };

  /// Computes the maps of one camera.
  static Result<Rectifier> create(const StereoCalibration& calibration,
                                  const Rectification& rectification, Side side) noexcept;
  /// Releases the maps.
  ~Rectifier();
  /// Moves; the other one can only be assigned to or destroyed then.
  Rectifier(Rectifier&& other) noexcept;
  /// Moves; the other one can only be assigned to or destroyed then.
  Rectifier& operator=(Rectifier&& other) noexcept;

  /// Resamples one plane with `channels` interleaved 8-bit values per pixel (1, 3 or 4; widths and
  /// strides of the views count pixels and bytes). Bilinear, in fixed point. Pixels that the
  /// camera does not see get `border` in every channel. Allocates nothing. Fails with kSizeMismatch
  /// unless `in` has the size of the camera and `out` the size of the rectification.
  Status apply(ImageView<const std::uint8_t> in, ImageView<std::uint8_t> out, int channels = 1,
               std::uint8_t border = 0) noexcept;

  /// The position in the camera's image of the rectified pixel (x, y) [px], not rounded; NaN for a
  /// direction that the lens model does not cover.
  std::array<double, 2> source_of(double x, double y) const noexcept;

  /// For each row of the rectified image, the longest range of columns that the camera sees.
  const std::vector<ValidColumns>& valid_columns() const noexcept;
  /// The largest upright rectangle of the rectified image that the camera sees.
  PixelRectangle valid_rectangle() const noexcept;

 private:
  class State;
  explicit Rectifier(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

/// What the user should know about a rectification.
struct RectificationRemark {
  Rectifier::Side side = Rectifier::Side::kLeft;  ///< of the view that it is about
  std::string text;                               ///< one sentence or two
  bool warning = false;                           ///< the rectified views are hardly of use
  bool lens_limit =
      false;  ///< it is about the part of the image that the lens model does not cover
};

/// What is unusual about the rectified views: parts of the images that the lens model does not
/// cover (most of an image: a warning), fields of view that are too wide for a plane, and, as a
/// warning, a view that the camera fills by less than a quarter. Both must belong to the same size
/// of images.
MTSTEREO_API Result<std::vector<RectificationRemark>> rectification_remarks(
    const StereoCalibration& calibration, const Rectification& rectification) noexcept;

}  // namespace mtstereo
