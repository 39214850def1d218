// SPDX-License-Identifier: LGPL-2.1-or-later

// What decides the results of a recording.

#include <gst/video/video.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lib/median.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/piece.hpp"
#include "recordings/matching/prepare_pairs.hpp"
#include "recordings/matching/range_search.hpp"
#include "recordings/matching/view_correction.hpp"
#include "recordings/matching/view_geometry.hpp"
#include "recordings/matching/work_options.hpp"
#include "recordings/media/decoder_reports.hpp"

namespace mtstereo::run {
namespace {

constexpr Nanoseconds kUsualPeriod = 33'333'333;  // of a recording with one pair [ns]
constexpr double kNearly = 0.05;     // of a period: the mean of a constant rate and its median
constexpr double kRounding = 0.005;  // of a period: a usual frame rate

void note_source(Work& work, const FrameIndex& index, const std::string& title) {
  for (const std::string& remark : index.remarks) work.remarks.push_back(title + ": " + remark);
  if (!index.damage.empty()) work.remarks.push_back(title + ": " + index.damage);
}

// A view that ends before the other one may be truncated, though its format does not state it.
void note_early_end(Work& work) {
  constexpr Nanoseconds kLeast = 500'000'000;  // recorders do not stop at the same time
  const FramePair last = work.pairs.pairs.back();
  const auto rest_of = [](const FrameIndex& index, std::int64_t frame) {
    return index.times.back() - index.times[static_cast<std::size_t>(frame)];
  };
  const Nanoseconds left = rest_of(work.left, last.left), right = rest_of(work.right, last.right);
  if (std::max(left, right) < kLeast) return;
  const FrameIndex& shorter = left < right ? work.left : work.right;
  work.remarks.push_back(outputs::format(
      "The %s view ends at %.3f s, %.3f s before the other one.", left < right ? "left" : "right",
      seconds(shorter.times.back()), seconds(std::abs(left - right))));
}

// One of the usual frame rates, if it is near.
Nanoseconds usual_period(double period) {
  gint numerator = 0, denominator = 1;
  if (gst_video_guess_framerate(static_cast<GstClockTime>(std::llround(period)), &numerator,
                                &denominator) == FALSE ||
      numerator == 0) {
    return std::llround(period);
  }
  const double usual = 1e9 * denominator / numerator;
  const bool near = std::abs(usual - period) <= kRounding * period;
  return near ? static_cast<Nanoseconds>(
                    gst_util_uint64_scale_int(GST_SECOND, denominator, numerator))
              : std::llround(period);
}

// The period of the pairs: the mean of a constant rate, and the median of a variable one.
Nanoseconds period_of(const Work& work) {
  const std::vector<FramePair>& pairs = work.pairs.pairs;
  if (pairs.size() < 2) return work.left.period > 0 ? work.left.period : kUsualPeriod;
  const auto time = [&](const FramePair& pair) {
    return work.left.times[static_cast<std::size_t>(pair.left)];
  };
  std::vector<Nanoseconds> steps;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    steps.push_back(time(pairs[i]) - time(pairs[i - 1]));
  const auto usual = static_cast<double>(median(std::move(steps)));
  const double mean = static_cast<double>(time(pairs.back()) - time(pairs.front())) /
                      static_cast<double>(pairs.size() - 1);
  return std::max<Nanoseconds>(
      usual_period(std::abs(mean - usual) <= kNearly * usual ? mean : usual), 1);
}

ClockRelation find_relation(Work& work, const std::optional<ClockRelation>& relation,
                            bool estimate) {
  if (relation) {
    work.clocks.emplace();
    work.clocks->relation = *relation;
    work.clocks->given = true;
    work.clocks->explanation = outputs::format(
        "An event is %.4f s later in the right recording, and its clock is %.1f ppm faster: as "
        "given.",
        relation->offset, 1e6 * relation->drift);
  } else if (estimate) {
    work.clocks = estimate_clocks(work.recording, work.left, work.right);
  }
  if (!work.clocks) return {};
  work.remarks.push_back(work.clocks->explanation);
  return work.clocks->relation;
}

[[noreturn]] void refuse_times(const Work& work) {
  const Nanoseconds left = work.left.times.front(), right = work.right.times.front();
  throw UserError(work.recording.name +
                  ": no frames of the two views belong together by their times: the left view "
                  "begins at " +
                  seconds_text(left) + ", the right one at " + seconds_text(right) +
                  ". If these are the same moment, give the difference (--sync " +
                  outputs::decimal(seconds(right - left), 3) +
                  "); --sync auto finds it by the images of longer recordings");
}

void find_pairs(Work& work, const std::optional<ClockRelation>& relation, bool estimate) {
  const Recording& recording = work.recording;
  if (recording.arrangement != Arrangement::kTwoSources) {
    work.pairs = all_frames(work.left);
    note_source(work, work.left, "recording");
    return;
  }
  work.right = index_frames(recording.right, recording.frame_rate);
  note_source(work, work.left, "left view");
  note_source(work, work.right, "right view");
  if (recording.rectified &&
      (work.left.width != work.right.width || work.left.height != work.right.height)) {
    throw UserError(recording.name + ": the views have different sizes: left " +
                    std::to_string(work.left.width) + "x" + std::to_string(work.left.height) +
                    ", right " + std::to_string(work.right.width) + "x" +
                    std::to_string(work.right.height) + " px");
  }
  work.pairs =
      pair_frames(work.left, work.right, find_relation(work, relation, estimate), std::nullopt);
  if (work.pairs.pairs.empty()) refuse_times(work);
  note_early_end(work);
}

}  // namespace

Work prepare_pairs(const Recording& recording, const WorkOptions& options,
                   const std::optional<ClockRelation>& relation, bool estimate) {
  Work work;
  work.recording = recording;
  work.options = options;
  work.remarks = recording.remarks;
  matcher_parameters(options);
  check_products(recording, options);
  work.left = index_frames(recording.left, recording.frame_rate);
  find_geometry(work);
  if (!finds_range(options)) complete_options(work);
  find_pairs(work, relation, estimate);
  work.period = period_of(work);
  return work;
}

Work prepare(const Recording& recording, const WorkOptions& options,
             const std::optional<ClockRelation>& relation, bool estimate) {
  Work work = prepare_pairs(recording, options, relation, estimate);
  if (finds_range(options)) {
    find_range(work);
    complete_options(work);
  }
  const std::string measures = measures_text(work);
  if (!measures.empty()) work.remarks.push_back("The rectified cameras: " + measures + ".");
  measure_correction(work);
  return work;
}

}  // namespace mtstereo::run
