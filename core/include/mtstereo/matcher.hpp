// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "mtstereo/alignment.hpp"
#include "mtstereo/export.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"
#include "mtstereo/result.hpp"

namespace mtstereo {

/// One of the two views of a pair.
enum class Side { kLeft, kRight };

/// Figures of one frame.
struct FrameStatistics {
  double milliseconds = 0;       ///< wall-clock time of the matching in compute() [ms]
  double density = 0;            ///< fraction of pixels with a disparity, 0 .. 1
  bool half_resolution = false;  ///< the views were matched at half resolution
  /// With resolution=auto: energy of the finest octave of spatial frequencies that both views have
  /// in common, divided by the energy of the next octave; a soft camera has less than 0.08. 0 if it
  /// was not measured: with another resolution, or too few matched pixels or too little texture.
  double fine_detail = 0;
};

/// The result of one frame. The views have the size of the images and are of the matcher's memory:
/// they are valid until its next compute().
struct FrameResult {
  DisparityView disparity;  ///< the map of the left image
  /// The confidence of each disparity: 1 .. 255, higher is more reliable, and 0 for pixels without
  /// a disparity. It combines how many neighboring pixels have a consistent disparity with how much
  /// worse their second-best disparities were.
  GrayView confidence;
  FrameStatistics statistics;  ///< of this frame
};

/// Finds the disparity of the left image of a rectified pair, by MTStereo 2.0 as published
/// (Preset::kPaper) or with extensions (all other presets).
///
/// Create a matcher once and use it for all frames. The first frame, and the first one after a
/// change of the image size or of parameters, sizes the buffers, which only grow; other frames do
/// not allocate memory. One matcher may be used by one thread at a time; different matchers
/// share nothing and may be used at the same time. A matcher runs Parameter::kThreads threads of
/// its own. The result does not depend on their number. It depends on the frames before only with
/// Parameter::kResolution = "auto", and with Parameter::kTemporal other than "off".
class MTSTEREO_API Matcher {
 public:
  /// Creates a matcher with these parameters. Fails with kOutOfMemory.
  static Result<Matcher> create(const Parameters& parameters) noexcept;

  /// Moves a matcher. The source can only be assigned to or destroyed afterwards.
  Matcher(Matcher&&) noexcept;
  /// Moves a matcher. The source can only be assigned to or destroyed afterwards.
  Matcher& operator=(Matcher&&) noexcept;
  ~Matcher();

  /// Sets the parameters for the next frames. Fails with kOutOfMemory; the parameters are unchanged
  /// then. Other parameters than before forget() the pairs so far.
  Status set_parameters(const Parameters& parameters) noexcept;
  /// The parameters for the next frame. The reference is valid as long as the matcher.
  const Parameters& parameters() const noexcept;

  /// Sets what is done to the views of the next frames before they are matched; see
  /// AlignmentTracker::correction(). A correction that does nothing costs nothing. set_parameters()
  /// keeps it. Fails with kInvalidParameter if a term of the field exceeds kLargestFieldTerm or a
  /// blur is not in 0 .. kLargestBlur; the correction is unchanged then.
  Status set_correction(const ViewCorrection& correction) noexcept;
  /// The correction for the next frame. The reference is valid as long as the matcher.
  const ViewCorrection& correction() const noexcept;

  /// Begins anew what depends on the frames so far, as for another stream or after a seek: the
  /// choice of Parameter::kResolution = "auto", so that the next frame is matched at full
  /// resolution, and the pairs so far. Another image size does the same, and set_parameters() with
  /// another resolution.
  void restart() noexcept;
  /// Forgets only the pairs so far, with which Parameter::kTemporal compares the next one, as after
  /// a gap in the stream. The next map is that of "off" then.
  void forget() noexcept;

  /// Matches one pair of images of the same size. They are only read, and only during the call.
  /// Fails with kInvalidImage, kSizeMismatch, kFrameDoesNotFit, kInvalidCombination, kOutOfMemory
  /// or kSystem; the matcher can be used again afterwards.
  Result<FrameResult> compute(GrayView left, GrayView right) noexcept;

 private:
  struct State;
  explicit Matcher(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

/// Converts a disparity map to 16-bit fixed point: disparity [px] = value / scale, plus
/// Parameters::disparity_offset() of the map, 0 = no disparity. A disparity that would round to 0
/// becomes 1, and one above 65535 becomes 65535 (Parameters::check_scale16()). `scale` is 1 ..
/// 65535; 256 with big-endian storage is KITTI's format. `out` has the size of the map and is
/// written only during the call. Fails with kSizeMismatch, kInvalidParameter or kInvalidImage. Any
/// thread may call it.
MTSTEREO_API Status write_disparity16(DisparityView disparity, int scale,
                                      ImageView<std::uint16_t> out) noexcept;

/// The version of the library, as in "0.2.0". The string is static.
MTSTEREO_API const char* version() noexcept;

}  // namespace mtstereo
