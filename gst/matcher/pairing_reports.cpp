// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing_reports.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

std::string milliseconds(Nanoseconds time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f ms", static_cast<double>(time) / 1e6);
  return text;
}

constexpr Nanoseconds kSecond = 1'000'000'000;

Nanoseconds wall_clock() { return g_get_monotonic_time() * 1000; }

constexpr const char* kIfTriggered =
    "If both cameras are triggered together, correct it by the property offset of a pad "
    "(sink_right::offset), or pair by sync-mode=first-pts or sync-mode=arrival.";

/// What to do if the frames of two streams are never within the tolerance.
std::string remedy_of_distance(Nanoseconds distance) {
  if (distance <= kSecond) {
    return "If the cameras are not triggered together, increase sync-tolerance; if the skew "
           "between the streams is constant, set the property offset of a pad "
           "(sink_right::offset).";
  }
  return "The frames of the two streams are " + std::to_string(distance / kSecond) +
         " s apart, as if the streams counted from different starts: pair by sync-mode=first-pts "
         "or sync-mode=arrival.";
}

std::string missing_reference(Side side) {
  return std::string("A frame of ") + pad_name(side) +
         " has no reference time stamp of the same clock as the other stream, which "
         "sync-mode=reference-timestamp needs. Enable it in the source (rtspsrc "
         "add-reference-timestamp-meta=true)";
}

}  // namespace

void PairingReports::unpaired(Nanoseconds difference, Nanoseconds tolerance) {
  if (!seen_.unpaired.dropped(wall_clock())) return;
  messages_.warning("The last " + std::to_string(seen_.unpaired.run()) +
                        " frames had no partner within the tolerance of " +
                        milliseconds(tolerance) + ". " + remedy_of_distance(std::llabs(difference)),
                    "the right frame is " + milliseconds(difference) +
                        " after the left frame (negative: before), tolerance " +
                        milliseconds(tolerance));
}

void PairingReports::late(const LateFrame& frame) {
  constexpr int kStanding = 10;
  if (seen_.same_times >= kStanding && !std::exchange(seen_.standing, true)) {
    messages_.warning(
        "The time stamps stand still: the last " + std::to_string(seen_.same_times + 1) +
        " pairs have the same one, so frames are late and dropped. Give each frame its own time "
        "(appsrc do-timestamp=true).");
  }
  seen_.lateness[index_of(frame.side)] = frame.lateness;
  if (!seen_.unpaired.dropped(wall_clock())) return;
  messages_.warning("The last " + std::to_string(seen_.unpaired.run()) +
                    " frames had no partner, because " + cause_of(frame));
}

std::string PairingReports::cause_of(const LateFrame& frame) const {
  const Side silent = other_side(frame.side);
  if (!frame.partner_linked) {
    return std::string(pad_name(silent)) + " is not linked. " + how_to_link(silent);
  }
  const auto [left, right] = seen_.lateness;
  const Side later = left > right ? Side::kLeft : Side::kRight;
  if (const Nanoseconds lateness = std::max(left, right); lateness > kSecond / 2) {
    return std::string("the time stamps of ") + pad_name(later) + " are " + milliseconds(lateness) +
           " behind the clock of the pipeline, so that its frames are late. Time stamps count "
           "nanoseconds from the start of the pipeline (appsrc do-timestamp=true). If the stream "
           "is only delayed, increase the property latency.";
  }
  return std::string("no frame arrived in time on ") + pad_name(silent) +
         ". If that stream is only delayed, increase the property latency.";
}

void PairingReports::wrong_time(Side side) {
  constexpr int kMany = 30;
  if (++seen_.wrong[index_of(side)] != kMany) return;
  messages_.warning(std::to_string(kMany) + " frames of " + pad_name(side) +
                    " were dropped, because their time stamps jump or repeat. Give each frame its "
                    "own time (appsrc do-timestamp=true), send a new segment where times start "
                    "over, or pair by sync-mode=arrival.");
}

void PairingReports::doubt(PairDoubt doubt) {
  if (doubt == PairDoubt::kNone || !seen_.doubts.due(doubt, wall_clock())) return;
  const StreamOffset& offset = pairer_.finder().offset();
  const std::string distance = milliseconds(offset.value());
  const std::string frame = milliseconds(pairer_.finder().period());
  if (doubt == PairDoubt::kSlip) {
    messages_.warning(
        "The streams have drifted apart by half a frame: from now on each left frame is "
        "paired with the next or the previous right frame, which is nearer in time. If "
        "both cameras are triggered together, their clocks differ: pair by "
        "sync-mode=arrival or sync-mode=reference-timestamp.",
        "the right frames are now " + distance + " after the left ones, a frame takes " + frame);
    return;
  }
  const DifferenceStatistics statistics = offset.line().statistics();
  const auto spread = static_cast<Nanoseconds>(statistics.spread);
  if (spread > std::llabs(offset.value())) {
    messages_.warning("The time difference of the views varies by " + milliseconds(spread) +
                          " (standard deviation), of a frame of " + frame +
                          ": their time stamps cannot prove that they belong together. Use time "
                          "stamps of the cameras instead of the times of arrival. If both cameras "
                          "are triggered together and lose no frames, pair by sync-mode=arrival.",
                      "the right frames are " + distance + " after the left ones");
    return;
  }
  messages_.warning("The right frames are " + distance +
                        " after the left ones (negative: before), of a frame of " + frame +
                        ": their time stamps cannot prove that they belong together. " +
                        kIfTriggered,
                    "standard deviation " + milliseconds(spread));
}

void PairingReports::matches(Nanoseconds time, Nanoseconds now) {
  const bool first = seen_.same_times < 0;
  seen_.same_times = !first && time == seen_.last_time ? seen_.same_times + 1 : 0;
  seen_.last_time = time;
  if (!first || time - now < kFarAhead) return;
  messages_.warning(
      "The time stamps are " + std::to_string((time - now) / kSecond) +
      " s ahead of the clock of the pipeline: a sink that synchronizes shows nothing until then. "
      "Time stamps count from the start of the pipeline (appsrc do-timestamp=true), not from 1970; "
      "or set sync=false on the sink.");
}

void PairingReports::late_pair(Nanoseconds lateness, Nanoseconds matching) {
  constexpr int kMany = 10;
  if (lateness < kSecond) {
    seen_.late_pairs = 0;
    return;
  }
  if (++seen_.late_pairs == 1) seen_.least_lateness = lateness;
  seen_.least_lateness = std::min(seen_.least_lateness, lateness);
  // A constant lateness is that of the time stamps.
  const bool grows = lateness - seen_.least_lateness >= kSecond;
  if (seen_.late_pairs < kMany || !grows || std::exchange(seen_.slow, true)) return;
  messages_.warning(
      "Matching is slower than the streams, and its maps get ever older: this pair is " +
      milliseconds(lateness) + " late, and one takes " + milliseconds(matching) +
      ". To skip older pairs, set newest-pair=true, or sync=true and qos=true on the sink; to "
      "match faster, preset=fast or a smaller max-disparity.");
}

void PairingReports::frame(Side side, bool damaged) {
  if (!damaged || std::exchange(seen_.damage[index_of(side)], true)) return;
  messages_.warning(std::string("The decoder marks a frame of ") + pad_name(side) +
                    " as damaged, because data was lost: its map shows what the decoder concealed. "
                    "To leave such frames out, set discard-corrupted-frames=true on the decoder.");
}

void PairingReports::log_offset() {
  if (seen_.restarts != pairer_.restarts()) seen_.offset.reset();
  seen_.restarts = pairer_.restarts();
  const DifferenceStatistics statistics = pairer_.finder().offset().line().statistics();
  if (statistics.pairs == 0) return;
  const auto mean = static_cast<Nanoseconds>(statistics.mean);
  const Nanoseconds period = pairer_.finder().period();
  if (seen_.offset && std::llabs(mean - *seen_.offset) <= period / 10) return;
  seen_.offset = mean;
  GST_DEBUG_OBJECT(messages_.element(),
                   "the right frames are %.2f ms after the left ones, of a frame of %.2f ms",
                   static_cast<double>(mean) / 1e6, static_cast<double>(period) / 1e6);
}

void PairingReports::ended() {
  const auto [left, right] = seen_.dropped;
  if (seen_.any_pair || seen_.unpaired.warned() || left + right == 0) return;
  if (std::exchange(seen_.end, true)) return;
  if (left > 0 && right > 0) {
    messages_.warning(
        "The streams have ended, and no two of their frames were a pair. If their times have "
        "nothing in common, pair by sync-mode=first-pts or sync-mode=arrival.");
    return;
  }
  const Side empty = left > 0 ? Side::kRight : Side::kLeft;
  messages_.warning(std::string("The streams have ended, and no frame has arrived on ") +
                    pad_name(empty) + ": check what is upstream of it.");
}

void PairingReports::paired() {
  seen_.any_pair = true;
  seen_.unpaired.paired();
  seen_.lateness = {};
  log_offset();
}

void PairingReports::refuse_mixed_stamping(bool left_has_time) {
  messages_.error(
      GST_STREAM_ERROR, GST_STREAM_ERROR_FAILED,
      std::string("The frames of ") + (left_has_time ? "sink_left" : "sink_right") +
          " have time stamps, the frames of " + (left_has_time ? "sink_right" : "sink_left") +
          " do not, so they cannot be paired. Provide time stamps on both streams (for example "
          "by appsrc do-timestamp=true) or on neither.");
}

void PairingReports::refuse_missing_reference(Side side) {
  messages_.error(GST_STREAM_ERROR, GST_STREAM_ERROR_FAILED,
                  missing_reference(side) + ", or choose another sync-mode.");
}

void PairingReports::warn_of_missing_reference(Side side) {
  messages_.settings_warning(missing_reference(side) + ". The previous sync-mode was restored.");
}

}  // namespace mtstereo::plugin
