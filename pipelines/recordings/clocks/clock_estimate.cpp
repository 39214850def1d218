// SPDX-License-Identifier: LGPL-2.1-or-later

// estimate_clocks(): the lag from what changes in the images, the fraction of a frame and the
// drift from the rows of matches.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/clocks/frame_pairs.hpp"
#include "recordings/clocks/gray_frames.hpp"
#include "recordings/clocks/lag_search.hpp"
#include "recordings/clocks/motion_signature.hpp"
#include "recordings/clocks/row_clock.hpp"
#include "recordings/clocks/row_matches.hpp"
#include "recordings/clocks/undecided_clocks.hpp"

namespace mtstereo::run {
namespace {

constexpr int kSignatureWidth = 160;        // of the images [px]
constexpr int kMatchingWidth = 480;         // of the images [px]
constexpr double kSearched[] = {120, 900};  // from the start, the second if the first fails [s]
constexpr double kSearchedDrift = 3e-4;     // that the search for the lag allows for
constexpr int kCandidates = 5;
constexpr double kLeastScore = 0.2;    // of a lag
constexpr double kCandidate = 0.6;     // of the best score: a lag that is tried as well
constexpr double kAmbiguous = 0.85;    // of the best support: a lag that cannot be excluded
constexpr int kTrials = 8;             // pairs by which a lag is tried
constexpr double kLeastQuality = 0.1;  // inliers per corner of views that belong together
constexpr double kSureQuality = 0.3;   // the same, where the rows of matches do not decide
constexpr int kFewestInliers = 10;     // the same, of a pair on the average
constexpr int kGroups = 24, kGroupPairs = 5;
constexpr int kRounds = 4;
constexpr double kLooseDeviation = 0.5;  // of a frame: of a lag, and the most of a fit of the rows
constexpr double kMostCorrection = 1;    // of a frame: of a lag by a fit of the rows
constexpr double kNone = 0.1;            // of a frame: a smaller offset is treated as zero

const char* const kByHand =
    " Give the offset by --sync SECONDS, or take the times as they are by --sync none";

// What is compared.
struct Views {
  const Recording& recording;
  const FrameIndex& left;
  const FrameIndex& right;
  double period;  // of the slower source [s]
};

[[noreturn]] void refuse(const Views& views, const std::string& reason) {
  throw UndecidedClocks(views.recording.name +
                            ": the clocks of the recordings cannot be compared by the images: " +
                            reason + "." + kByHand,
                        reason);
}

MotionSignature signature_of(const Source& source, const FrameIndex& index, double length) {
  GrayFrames frames(source, index, kSignatureWidth);
  SignatureMaker maker;
  for (std::size_t i = 0; i < index.times.size(); ++i) {
    if (seconds(index.times[i] - index.times.front()) > length) break;
    const cv::Mat image = frames.at(static_cast<std::int64_t>(i));
    if (!image.empty()) maker.add(image, seconds(index.times[i]));
  }
  return maker.take();
}

// The left frames from `first` to `last` - 1 that have a partner, as times allow.
struct Overlap {
  std::int64_t first = 0, last = 0;
  std::int64_t count() const { return std::max<std::int64_t>(last - first, 0); }
};

// Without the first and the last frame, for the motion in the others; at most `length` from its
// start [s].
Overlap overlap_of(const Views& views, const ClockRelation& relation, double length) {
  const auto left_time = [&](Nanoseconds time) {
    return (seconds(time) - relation.offset) / (1 + relation.drift);
  };
  Overlap overlap;
  overlap.first =
      std::max<std::int64_t>(1, nearest_frame(views.left, left_time(views.right.times.front())));
  const double start = seconds(views.left.times[static_cast<std::size_t>(overlap.first)]);
  const double end = std::min(left_time(views.right.times.back()), start + length);
  overlap.last = std::min(static_cast<std::int64_t>(views.left.times.size()) - 1,
                          nearest_frame(views.left, end) + 1);
  return overlap;
}

// A lag, and how well the views match with it.
struct Candidate {
  Lag lag;
  double quality = 0;  // inliers per corner
  double inliers = 0;  // of a pair on the average

  ClockRelation relation() const { return {lag.seconds, 0}; }
  double support() const { return lag.score * quality; }
};

// Matches pairs from the whole overlap.
void try_candidate(const Views& views, RowMatcher& matcher, double length, Candidate& candidate) {
  const Overlap overlap = overlap_of(views, candidate.relation(), length);
  const auto trials = std::min<std::int64_t>(kTrials, overlap.count());
  int corners = 0, inliers = 0;
  for (std::int64_t i = 0; i < trials; ++i) {
    const std::int64_t number = overlap.first + (2 * i + 1) * overlap.count() / (2 * trials);
    const MatchedPair pair =
        matcher.match(number, candidate.relation(), RowMatcher::Partner::kNearest);
    corners += pair.corners;
    inliers += pair.inliers;
  }
  candidate.quality = corners > 0 ? static_cast<double>(inliers) / corners : 0;
  candidate.inliers = trials > 0 ? static_cast<double>(inliers) / static_cast<double>(trials) : 0;
}

void refuse_static(const Views& views, bool left, bool right) {
  if (left && right) refuse(views, "both recordings are static, nothing moves in them");
  if (left) refuse(views, "the left recording is static, nothing moves in it");
  if (right) refuse(views, "the right recording is static, nothing moves in it");
}

[[noreturn]] void refuse_unrelated(const Views& views) {
  refuse(views,
         "they are unrelated, or overlap by less than a few seconds: at no offset the same happens "
         "in both");
}

// The lag of the first part of the recordings; none if another part may decide.
std::optional<Candidate> find_lag(const Views& views, RowMatcher& matcher, double length,
                                  bool final) {
  const MotionSignature left = signature_of(views.recording.left, views.left, length);
  const MotionSignature right = signature_of(views.recording.right, views.right, length);
  if (left.is_static() || right.is_static()) {
    if (final) refuse_static(views, left.is_static(), right.is_static());
    return std::nullopt;
  }
  std::vector<Candidate> candidates;
  for (const Lag& lag : search_lags(left, right, views.period, kSearchedDrift, kCandidates)) {
    if (lag.score < kLeastScore) break;
    if (!candidates.empty() && lag.score < kCandidate * candidates.front().lag.score) break;
    candidates.push_back({lag});
    try_candidate(views, matcher, length, candidates.back());
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.support() > b.support(); });
  if (candidates.empty() || candidates.front().quality < kLeastQuality ||
      candidates.front().inliers < kFewestInliers) {
    if (final) refuse_unrelated(views);
    return std::nullopt;
  }
  if (candidates.size() > 1 && candidates[1].support() > kAmbiguous * candidates[0].support()) {
    if (final) {
      refuse(views, outputs::format(
                        "the motion is periodic: offsets of %.3f s and %.3f s explain it as well",
                        candidates[0].lag.seconds, candidates[1].lag.seconds));
    }
    return std::nullopt;
  }
  return candidates.front();
}

// Matches groups of successive pairs from the whole overlap.
std::vector<std::vector<MatchedPair>> match_groups(RowMatcher& matcher, const Overlap& overlap,
                                                   const ClockRelation& relation) {
  std::vector<std::vector<MatchedPair>> groups;
  const double step = std::max<double>(kGroupPairs, static_cast<double>(overlap.count()) / kGroups);
  for (double at = 0; at + kGroupPairs <= static_cast<double>(overlap.count()); at += step) {
    std::vector<MatchedPair>& group = groups.emplace_back();
    for (int i = 0; i < kGroupPairs; ++i) {
      group.push_back(matcher.match(
          overlap.first + static_cast<std::int64_t>(at) + i, relation,
          i % 2 == 0 ? RowMatcher::Partner::kNearest : RowMatcher::Partner::kOnOtherSide));
    }
  }
  return groups;
}

ClockRelation corrected(const ClockRelation& relation, const ClockCorrection& correction) {
  return {relation.offset + correction.late - correction.drift * correction.middle,
          relation.drift + correction.drift};
}

// Refines a relation by the rows of matches in the first part of the overlap. False if they do not
// decide.
bool refine(const Views& views, RowMatcher& matcher, double length, ClockRelation& relation,
            ClockCorrection& result) {
  for (int round = 0; round < kRounds; ++round) {
    const Overlap overlap = overlap_of(views, relation, length);
    const auto found =
        fit_rows(match_groups(matcher, overlap, relation), views.period, relation.drift);
    if (!found || std::abs(found->late) > kMostCorrection * views.period) return false;
    relation = corrected(relation, *found);
    result = *found;
    // Far from the assumed relation the points do not move uniformly.
    constexpr double kNear = 0.2;  // of a frame
    if (std::abs(found->late) < kNear * views.period) {
      return found->late_deviation < kLooseDeviation * views.period;
    }
  }
  return false;
}

double offset_at(const ClockRelation& relation, double time) {
  return relation.offset + relation.drift * time;
}

// Frames that are together need no offset.
bool is_none(const Views& views, const ClockEstimate& estimate) {
  const double limit =
      std::max(kNone * views.period, std::min(3 * estimate.uncertainty, 0.3 * views.period));
  const auto small = [&](Nanoseconds time) {
    return std::abs(offset_at(estimate.relation, seconds(time))) < limit;
  };
  return small(views.left.times.front()) && small(views.left.times.back());
}

// The drift and how sure it is, as a part of a sentence.
std::string describe_drift(const ClockEstimate& estimate) {
  constexpr double kParts = 1e6;
  if (!estimate.drift_uncertainty) return "a drift cannot be measured";
  const double drift = estimate.relation.drift, deviation = *estimate.drift_uncertainty;
  if (drift == 0) {
    return outputs::format("no drift is found (standard deviation %.0f ppm)", kParts * deviation);
  }
  return outputs::format("the clock of the right one is %.0f ppm %s (standard deviation %.0f ppm)",
                         kParts * std::abs(drift), drift < 0 ? "slower" : "faster",
                         kParts * deviation);
}

std::string describe(const Views& views, const ClockEstimate& estimate) {
  const char* const sure =
      estimate.confirmed ? "matching confirms it" : "matching cannot confirm it";
  const ClockRelation& relation = estimate.relation;
  if (relation.offset == 0 && relation.drift == 0) {
    return outputs::format(
        "The images of both recordings are in step (to %.1f ms): no offset is applied; %s.",
        1e3 * std::max(estimate.uncertainty, kNone * views.period), sure);
  }
  const double offset = offset_at(relation, estimate.time);
  return outputs::format(
      "The recorders were started apart: what the left recording shows at %.3f s is at "
      "%.4f s in the right one, %.4f s (%.2f frames, standard deviation %.2f) %s; %s; "
      "%s.",
      estimate.time, estimate.time + offset, std::abs(offset), std::abs(offset) / views.period,
      estimate.uncertainty / views.period, offset < 0 ? "earlier" : "later",
      describe_drift(estimate).c_str(), sure);
}

// Small images of both recordings, and their matcher.
struct Matching {
  explicit Matching(const Views& views)
      : left(views.recording.left, views.left, kMatchingWidth),
        right(views.recording.right, views.right, kMatchingWidth),
        matcher(left, right) {
    const auto calibration =
        rectifying_calibration(views.recording, views.left.width, views.left.height);
    if (!calibration) return;
    left.rectify_as(*calibration, Rectifier::Side::kLeft);
    right.rectify_as(*calibration, Rectifier::Side::kRight);
  }

  GrayFrames left, right;
  RowMatcher matcher;
};

Views views_of(const Recording& recording, const FrameIndex& left, const FrameIndex& right) {
  return {recording, left, right, seconds(std::max(left.period, right.period))};
}

bool has_few_frames(const Views& views) {
  return views.left.times.size() < 3 || views.right.times.size() < 3;
}

Candidate find_lag(const Views& views, RowMatcher& matcher) {
  const double length = std::max(seconds(views.left.times.back() - views.left.times.front()),
                                 seconds(views.right.times.back() - views.right.times.front()));
  for (const double searched : kSearched) {
    const bool final = searched == kSearched[std::size(kSearched) - 1] || searched >= length;
    if (const auto found = find_lag(views, matcher, searched, final)) return *found;
  }
  refuse(views, "they do not decide");
}

}  // namespace

std::optional<double> find_offset(const Recording& recording, const FrameIndex& left,
                                  const FrameIndex& right) {
  const Views views = views_of(recording, left, right);
  if (has_few_frames(views)) return std::nullopt;
  Matching matching(views);
  const auto found = find_lag(views, matching.matcher, kSearched[0], false);
  return found ? std::optional(found->lag.seconds) : std::nullopt;
}

ClockEstimate estimate_clocks(const Recording& recording, const FrameIndex& left,
                              const FrameIndex& right) {
  const Views views = views_of(recording, left, right);
  if (has_few_frames(views)) refuse(views, "they have too few frames");
  Matching matching(views);
  RowMatcher& matcher = matching.matcher;
  const Candidate candidate = find_lag(views, matcher);
  ClockEstimate estimate;
  estimate.relation = candidate.relation();
  estimate.uncertainty = kLooseDeviation * views.period;
  estimate.time = seconds(left.times[left.times.size() / 2]);
  const double whole = seconds(left.times.back() - left.times.front());
  // A drift that was measured on a part predicts the offset in a longer one to a frame.
  for (double length = kSearched[0];; length *= 4) {
    ClockRelation relation = estimate.relation;
    ClockCorrection correction;
    if (!refine(views, matcher, length, relation, correction)) {
      if (length == kSearched[0] && candidate.quality < kSureQuality) refuse_unrelated(views);
      break;
    }
    estimate.relation = relation;
    estimate.uncertainty = correction.late_deviation;
    estimate.confirmed =
        correction.matches - correction.matches_beside > 4 * std::sqrt(correction.matches);
    estimate.time = correction.middle;
    estimate.drift_uncertainty = correction.drift_deviation;
    if (length >= whole) break;
  }
  if (is_none(views, estimate)) estimate.relation = {};
  estimate.explanation = describe(views, estimate);
  return estimate;
}

}  // namespace mtstereo::run
