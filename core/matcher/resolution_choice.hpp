// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "parameters/choices.hpp"

namespace mtstereo {

/// The resolution of a stream's next frame, from the detail in its frames so far
/// (FineDetail::share()): full, until several frames in succession are soft, then half-refined,
/// until as many are sharp. A frame in between interrupts them; frames without a share do not
/// count. The choice depends on the shares and their order only.
class ResolutionChoice {
 public:
  /// Up to this share a frame is soft. Views enlarged twice have 0.03 to 0.08, those blurred by a
  /// sigma of 1 px 0.04 to 0.07, and sharp ones 0.10 to 0.44.
  static constexpr double kSoft = 0.08;
  /// From this share on a frame is sharp.
  static constexpr double kSharp = 0.095;
  /// Frames in succession that change the resolution.
  static constexpr int kFrames = 5;

  /// Takes the share of a frame that was matched at resolution().
  void take(std::optional<double> share);

  /// That of the next frame.
  Resolution resolution() const { return half_ ? Resolution::kHalfRefined : Resolution::kFull; }

  /// Begins anew, as for another stream.
  void restart() { *this = {}; }

 private:
  bool half_ = false;
  int contrary_ = 0;  // frames in succession that ask for the other resolution
};

}  // namespace mtstereo
