// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "mtstereo/export.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"
#include "mtstereo/result.hpp"

namespace mtstereo {

/// Which view a stage's result belongs to.
enum class Side { kLeft, kRight };

/// A step whose disparity map can be asked for, in the order of the method (paper, fig. 2 b-f; what
/// kFinal has seen besides is beyond the paper). With Parameter::kResolution half these are steps
/// on the halved views: their maps have half the size, and their disparities are half as large.
enum class Stage {
  kNodeMatching,   ///< the matched leaves, linear from end to end
  kNodesFiltered,  ///< after the outlier removal of the nodes, where there is one
  kExtrapolated,   ///< after reliable node extrapolation
  kPixelMatching,  ///< after guided pixel matching with its checks of each pixel
  kFinal,          ///< after all removals and the filling of gaps: the result, at the resolution
                   ///< that is matched
};

/// What one frame took and gave.
struct FrameStatistics {
  double milliseconds = 0;  ///< wall time of compute() [ms]
  double density = 0;       ///< share of pixels with a disparity, 0 .. 1
};

/// MTStereo 2.0 and what goes beyond it: finds the disparity of the left image of a rectified pair
/// (Parameter::kPreset tells which).
///
/// A matcher is made once and used for frame after frame. The first frame of a size, and the first
/// after a change that a parameter marks as reallocating, sizes the buffers; the frames after it
/// allocate nothing. Matchers share nothing: several may work at once, each on its own thread. One
/// matcher is used by one thread at a time; inside, it uses Parameter::kThreads threads of its own.
/// The result does not depend on their number.
class MTSTEREO_API Matcher {
 public:
  /// A matcher with these parameters; it sizes its buffers when the first frame comes. Fails with
  /// kOutOfMemory.
  static Result<Matcher> create(const Parameters& parameters);

  /// One that was moved from can only be assigned to and destroyed.
  Matcher(Matcher&&) noexcept;
  Matcher& operator=(Matcher&&) noexcept;
  ~Matcher();

  /// Takes other parameters from the next frame on. Fails with kOutOfMemory.
  Status set_parameters(const Parameters& parameters);
  const Parameters& parameters() const;

  /// Keeps every stage's disparity map for stage(), at the cost of a copy each and of drawing what
  /// only stage() shows. Off at first.
  void keep_stages(bool keep);

  /// Matches one pair. Both images have the same size and are only read; they may be freed when
  /// the call returns. The result belongs to the matcher and holds until its next compute().
  /// Fails with kInvalidImage, kSizeMismatch, kFrameDoesNotFit, kInvalidCombination, kOutOfMemory
  /// or kSystem; the matcher can be used again afterwards.
  Result<DisparityView> compute(GrayView left, GrayView right);

  /// The confidence of each disparity of the last frame: 1 .. 255, higher = more trustworthy, and 0
  /// where there is no disparity. An empty view before the first frame. It tells how many pixels
  /// around have a disparity that fits, and how clearly these were told from their runners-up.
  /// Belongs to the matcher and holds until its next compute().
  GrayView confidence() const;

  /// A stage's disparity map of the last frame; an empty view before the first frame, and where
  /// it failed with kOutOfMemory or kSystem or keep_stages() was off in it. Holds until the next
  /// compute().
  DisparityView stage(Stage stage) const;
  /// The pre-processed image of the last frame that the Max-trees are made of (paper, fig. 2 a):
  /// values 0 .. gray-levels - 1, high = little contrast. As large as what is matched, which may be
  /// half of the view (Parameter::kResolution). Holds until the next compute().
  GrayView preprocessed(Side side) const;
  /// The cost of the left pixel (x, y) at the whole disparity d, 0 <= d < max-disparity, d <= x, in
  /// gray values (paper, "Cost volume"). All three count pixels of the resolution that is matched
  /// (Parameter::kResolution). 0 outside of the image and of these limits, before the first frame,
  /// after a change of a parameter that reallocates until the next one, and where neither
  /// Parameter::kNodeCost nor Parameter::kPixelCost is "gradient": then there is no cost volume.
  double cost(int x, int y, int d) const;

  /// Of the last frame.
  FrameStatistics statistics() const;

 private:
  struct State;
  explicit Matcher(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Writes a disparity map as 16-bit fixed point, px = value / scale, 0 = none; a disparity that
/// would round to 0 becomes 1, and one over 65535 (see Parameters::check_scale16) becomes 65535.
/// `scale` is 1 .. 65535; with 256 and big-endian storage this is KITTI's convention. Fails with
/// kSizeMismatch or kInvalidImage.
MTSTEREO_API Status write_disparity16(DisparityView disparity, int scale,
                                      ImageView<std::uint16_t> out);

/// The version of the library, as in "0.1.0".
MTSTEREO_API const char* version();

}  // namespace mtstereo
