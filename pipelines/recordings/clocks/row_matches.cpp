// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/clocks/row_matches.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "alignment/pair_inspection.hpp"
#include "alignment/patch_tracking.hpp"
#include "alignment/sharpness.hpp"
#include "recordings/clocks/gray_frames.hpp"
#include "recordings/media/sample_frames.hpp"

namespace mtstereo::run {
namespace {

constexpr int kDisparityShare = 3;  // the range of disparities is the width divided by it
constexpr float kReach = 8;         // of the motion from frame to frame [px]

double time_of(const FrameIndex& index, std::int64_t number) {
  return seconds(index.times[static_cast<std::size_t>(number)]);
}

// Three successive frames and the times between them.
struct Motion {
  cv::Mat before, now, after;
  double duration = 0;  // from the first to the last one [s]

  bool complete() const { return !before.empty() && !now.empty() && !after.empty(); }
};

// Noise hides more than a blur does: the image with as much blur as its noise demands.
cv::Mat without_noise(const cv::Mat& image, SharpnessScratch& scratch) {
  constexpr double kHarmless = 2.7;                    // standard deviation [gray values]
  constexpr double kRise = 0.3;                        // [px per gray value]
  constexpr double kLeastSigma = 0.2, kMostSigma = 1;  // [px]
  if (image.empty()) return image;
  const double sigma =
      std::min(kRise * (noise_of(view_of(image), scratch) - kHarmless), kMostSigma);
  if (sigma < kLeastSigma) return image;
  cv::Mat result;
  cv::GaussianBlur(image, result, cv::Size(), sigma);
  return result;
}

Motion motion_at(GrayFrames& frames, std::int64_t number) {
  Motion motion;
  const auto count = static_cast<std::int64_t>(frames.index().times.size());
  if (number < 1 || number + 1 >= count) return motion;
  SharpnessScratch scratch;
  motion.before = without_noise(frames.at(number - 1), scratch);
  motion.now = without_noise(frames.at(number), scratch);
  motion.after = without_noise(frames.at(number + 1), scratch);
  motion.duration = time_of(frames.index(), number + 1) - time_of(frames.index(), number - 1);
  return motion;
}

// The speed of a point of the middle frame [px/s].
std::optional<double> speed_of(const Motion& motion, float at_x, float at_y) {
  const int x = static_cast<int>(std::lround(at_x)), y = static_cast<int>(std::lround(at_y));
  const auto earlier = track_patch(view_of(motion.now), view_of(motion.before), x, y,
                                   static_cast<float>(x), static_cast<float>(y), kReach);
  if (!earlier) return std::nullopt;
  // A motion that is nearly uniform continues on the other side.
  const auto later = track_patch(view_of(motion.now), view_of(motion.after), x, y,
                                 2 * static_cast<float>(x) - earlier->x_right,
                                 static_cast<float>(y) - earlier->rows, kReach);
  if (!later) return std::nullopt;
  return (later->rows - earlier->rows) / motion.duration;
}

}  // namespace

std::int64_t nearest_frame(const FrameIndex& index, double time) {
  const auto wanted = static_cast<Nanoseconds>(std::llround(time * kSecond));
  const auto next = std::lower_bound(index.times.begin(), index.times.end(), wanted);
  if (next == index.times.begin()) return 0;
  const auto last = std::prev(next);
  const bool later = next != index.times.end() && *next - wanted < wanted - *last;
  return (later ? next : last) - index.times.begin();
}

RowMatcher::RowMatcher(GrayFrames& left, GrayFrames& right)
    : left_(left), right_(right), inspector_(std::make_unique<PairInspector>()) {}

RowMatcher::~RowMatcher() = default;

MatchedPair RowMatcher::match(std::int64_t number, const ClockRelation& relation, Partner partner) {
  MatchedPair pair;
  if (number < 0 || number >= static_cast<std::int64_t>(left_.index().times.size())) return pair;
  pair.time = time_of(left_.index(), number);
  const double expected = pair.time * (1 + relation.drift) + relation.offset;
  std::int64_t other = nearest_frame(right_.index(), expected);
  if (partner == Partner::kOnOtherSide) {
    other += time_of(right_.index(), other) < expected ? 1 : -1;
    if (other < 0 || other >= static_cast<std::int64_t>(right_.index().times.size())) return pair;
  }
  pair.lateness = time_of(right_.index(), other) - expected;
  const Motion left = motion_at(left_, number), right = motion_at(right_, other);
  if (!left.complete() || !right.complete() || right.now.size() != left.now.size()) return pair;
  const int width = right.now.cols, height = right.now.rows;
  inspector_->inspect(view_of(left.now), view_of(right.now), width / kDisparityShare);
  pair.corners = inspector_->findings().candidates;
  pair.inliers = inspector_->findings().inliers;
  const double half = width / 2.0;
  for (const Match& match : inspector_->matches()) {
    const auto left_speed = speed_of(left, match.x_left, match.y_left);
    const auto right_speed = speed_of(right, match.x_right, match.y_left + match.rows);
    if (!left_speed || !right_speed) continue;
    pair.matches.push_back({(match.x_right + 0.5 - half) / half,
                            (match.y_left + 0.5 - height / 2.0) / half, match.rows, *left_speed,
                            *right_speed, match.variance});
  }
  return pair;
}

}  // namespace mtstereo::run
