// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "matcher/base/messages.hpp"
#include "matcher/pairing/pairer.hpp"
#include "matcher/pairing/unpaired.hpp"

namespace mtstereo::plugin {

/// A frame that was dropped at its deadline.
struct LateFrame {
  Side side = Side::kLeft;
  Nanoseconds lateness = 0;    ///< how long after the deadline that follows from its time stamp
  bool partner_linked = true;  ///< the pad of the other side
};

/// The messages about frames and pairs. Used by the task of the source pad, without locks, and by
/// start and flush while the task does not run.
class PairingReports {
 public:
  PairingReports(Messages& messages, const Pairer& pairer) : messages_(messages), pairer_(pairer) {}

  /// Two frames were paired. Logs the difference of the streams' times if it has changed.
  void paired();
  /// A pair is matched. Running times of its map and of the clock.
  void matches(Nanoseconds time, Nanoseconds now);
  /// A pair of live streams is matched, this long after its deadline. `matching`: mean time.
  void late_pair(Nanoseconds lateness, Nanoseconds matching);
  /// A frame is matched that a decoder may have marked as damaged.
  void frame(Side side, bool damaged);
  /// A frame had no partner, because the next one of the other side is too far away.
  void unpaired(Nanoseconds difference, Nanoseconds tolerance);
  /// A frame had no partner, because none arrived on the other side in time.
  void late(const LateFrame& frame);
  /// A frame was dropped, because its time stamp jumps or repeats.
  void wrong_time(Side side);
  /// A frame of this side is left out.
  void dropped(Side side) { ++seen_.dropped[index_of(side)]; }
  /// The streams have ended.
  void ended();
  /// The pairs may be wrong although their times fit.
  void doubt(PairDoubt doubt);

  /// Errors: time stamps on one side only; no reference time stamp on a side.
  void refuse_mixed_stamping(bool left_has_time);
  void refuse_missing_reference(Side side);
  /// A change to sync-mode=reference-timestamp was taken back.
  void warn_of_missing_reference(Side side);

  void start() { seen_ = {}; }

 private:
  static constexpr Nanoseconds kFarAhead = 3'600'000'000'000;  ///< no source is that early

  /// Since the start of the element.
  struct Seen {
    UnpairedWarning unpaired;
    DoubtWarning doubts;
    bool any_pair = false;
    Nanoseconds last_time = 0;                 // of the last pair that was matched
    int same_times = -1;                       // pairs with the time of the one before; -1: no pair
    bool standing = false;                     // times, and warned of
    std::array<std::int64_t, 2> dropped = {};  // frames of a side
    std::array<int, 2> wrong = {};             // of these, with a wrong time stamp
    std::array<Nanoseconds, 2> lateness = {};  // of a side since the last pair
    int late_pairs = 0;                        // successive ones
    Nanoseconds least_lateness = 0;            // of these
    bool slow = false;                         // matching, and warned of
    bool end = false;                          // without any pair, and warned of
    std::array<bool, 2> damage = {};           // of a side, and warned of
    std::optional<Nanoseconds> offset;         // of the streams, logged
    int restarts = 0;                          // Pairer::restarts() then
  };

  void log_offset();
  std::string cause_of(const LateFrame& frame) const;

  Messages& messages_;
  const Pairer& pairer_;
  Seen seen_;
};

}  // namespace mtstereo::plugin
