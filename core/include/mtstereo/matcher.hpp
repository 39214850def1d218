// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "mtstereo/export.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"
#include "mtstereo/result.hpp"

namespace mtstereo {

/// One of the two views of a pair.
enum class Side { kLeft, kRight };

/// What one frame took and gave.
struct FrameStatistics {
  double milliseconds = 0;  ///< wall time of compute() [ms]
  double density = 0;       ///< share of pixels with a disparity, 0 .. 1
};

/// MTStereo 2.0 and what goes beyond it: finds the disparity of the left image of a rectified pair
/// (Parameter::kPreset tells which).
///
/// A matcher is made once and used for frame after frame. The first frame of a size, and the first
/// after set_parameters(), sizes the buffers, which only grow; all other frames allocate nothing.
/// Matchers share nothing: several may work at once, each on its own thread. One matcher is used by
/// one thread at a time; inside, it uses Parameter::kThreads threads of its own. The result does
/// not depend on their number.
class MTSTEREO_API Matcher {
 public:
  /// A matcher with these parameters; it sizes its buffers when the first frame comes. Fails with
  /// kOutOfMemory.
  static Result<Matcher> create(const Parameters& parameters) noexcept;

  /// One that was moved from can only be assigned to and destroyed.
  Matcher(Matcher&&) noexcept;
  Matcher& operator=(Matcher&&) noexcept;
  ~Matcher();

  /// Takes other parameters from the next frame on. Fails with kOutOfMemory.
  Status set_parameters(const Parameters& parameters) noexcept;
  const Parameters& parameters() const noexcept;

  /// Matches one pair. Both images have the same size and are only read; they may be freed when
  /// the call returns. The result belongs to the matcher and holds until its next compute().
  /// Fails with kInvalidImage, kSizeMismatch, kFrameDoesNotFit, kInvalidCombination, kOutOfMemory
  /// or kSystem; the matcher can be used again afterwards.
  Result<DisparityView> compute(GrayView left, GrayView right) noexcept;

  /// The confidence of each disparity of the last frame: 1 .. 255, higher = more trustworthy, and 0
  /// where there is no disparity. An empty view before the first frame. It tells how many pixels
  /// around have a disparity that fits, and how clearly these were told from their runners-up.
  /// Belongs to the matcher and holds until its next compute().
  GrayView confidence() const noexcept;

  /// Of the last frame.
  FrameStatistics statistics() const noexcept;

 private:
  struct State;
  explicit Matcher(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

/// Writes a disparity map as 16-bit fixed point, px = value / scale, 0 = none; a disparity that
/// would round to 0 becomes 1, and one over 65535 (see Parameters::check_scale16) becomes 65535.
/// `scale` is 1 .. 65535; with 256 and big-endian storage this is KITTI's convention. Fails with
/// kSizeMismatch or kInvalidImage.
MTSTEREO_API Status write_disparity16(DisparityView disparity, int scale,
                                      ImageView<std::uint16_t> out) noexcept;

/// The version of the library, as in "0.2.0".
MTSTEREO_API const char* version() noexcept;

}  // namespace mtstereo
