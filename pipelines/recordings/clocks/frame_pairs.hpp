// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "recordings/inputs/recording.hpp"
#include "recordings/media/frame_index.hpp"

namespace mtstereo::run {

/// How the clocks of two recorders differ: an event at the time t of the left recording is at
/// t * (1 + drift) + offset in the right one.
struct ClockRelation {
  double offset = 0;  ///< [s]
  double drift = 0;   ///< relative: 3e-4 = 300 ppm
};

/// The relation of the clocks, and its certainty.
struct ClockEstimate {
  ClockRelation relation;
  bool given = false;      ///< by the user: nothing was measured
  double time = 0;         ///< of the left recording, for which `uncertainty` holds [s]
  double uncertainty = 0;  ///< standard deviation of the offset at that time [s]
  /// Standard deviation of the drift, also of one that is not significant; none: the rows of
  /// matches did not decide.
  std::optional<double> drift_uncertainty;
  bool confirmed = false;   ///< points in motion match clearly better than half a frame beside it
  std::string explanation;  ///< a sentence for the user
};

/// The offset of the right recording to about a frame [s], from the first two minutes; none if the
/// images do not decide.
std::optional<double> find_offset(const Recording& recording, const FrameIndex& left,
                                  const FrameIndex& right);

/// Finds offset and drift from the images, as docs/appendix/clocks.md describes. A recording
/// whose frames are together already gets exactly the relation 0, 0. Throws UserError if the
/// images do not decide; the message states why and how to give the offset by hand.
ClockEstimate estimate_clocks(const Recording& recording, const FrameIndex& left,
                              const FrameIndex& right);

/// Frames that belong together, by their numbers in both indexes.
struct FramePair {
  std::int64_t left = 0, right = 0;
  friend bool operator==(const FramePair&, const FramePair&) = default;
};

/// The pairs of a whole recording. They are decided once, so that every piece of the recording has
/// the same ones.
struct PairList {
  std::vector<FramePair> pairs;    ///< both numbers increase
  std::int64_t dropped_left = 0;   ///< frames without a partner
  std::int64_t dropped_right = 0;  ///< frames without a partner
};

/// Pairs frames by their times, at most `tolerance` apart after the relation is applied;
/// std::nullopt: half a frame of the slower source and a sixteenth of a frame more, since
/// containers round times. A frame keeps the side of its partner unless the other one is clearly
/// nearer.
PairList pair_frames(const FrameIndex& left, const FrameIndex& right, const ClockRelation& relation,
                     std::optional<Nanoseconds> tolerance);

/// One source with both views: every frame is a pair.
PairList all_frames(const FrameIndex& both);

}  // namespace mtstereo::run
