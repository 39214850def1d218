// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eval/curve_means.hpp"
#include "eval/datasets.hpp"
#include "eval/metrics.hpp"
#include "eval/pictures.hpp"
#include "eval/rivals.hpp"
#include "mtstereo/matcher.hpp"

namespace mtstereo::eval {

/// The library's name among the methods of a report.
inline constexpr const char* kOwnMethod = "mtstereo";

/// How pairs are run.
struct RunSettings {
  Parameters parameters;  ///< where max-disparity is set, it holds for all pairs
  std::vector<Rival> rivals;
  int warm_up = 1;  ///< frames before the clock runs
  int repeat = 1;   ///< timed frames, of which the median counts
  DmapMeaning dmap = DmapMeaning::kAuto;
  std::optional<std::filesystem::path> disparity_folder;
  DisparityFormat disparity_format = DisparityFormat::kPfm;
  std::optional<std::filesystem::path> picture_folder;
  bool curve = false;  ///< sweep the confidence of every method
};

/// What one method reached on one pair.
struct MethodResult {
  std::string method;
  Evaluation evaluation;
  double seconds = 0;                ///< wall time of one frame, median [s]
  double seconds_per_megapixel = 0;  ///< the same by the size of the left image [s/MP]
};

/// What came of one pair.
struct PairReport {
  StereoPair pair;
  cv::Size size;
  int max_disparity = 0;              ///< searched [px]
  std::vector<MethodResult> results;  ///< the library's own first; methods that failed are not here
  std::vector<MethodSweep> sweeps;    ///< where a curve is asked for, one for each method
  std::vector<std::string> failures;  ///< one sentence each
  std::vector<std::string> notes;
};

/// The search range of a pair: what was asked for, or else what the data set says, within the width
/// of the image and what the library takes. A note is added where that is less. Throws InputError
/// where nobody says.
int search_range(const StereoPair& pair, const Parameters& parameters, int width,
                 std::vector<std::string>& notes);

/// Calls `frame` warm_up times, then `repeat` times against the clock; the median [s].
double median_seconds(int warm_up, int repeat, const std::function<void()>& frame);

/// Runs the library, and the rivals, on pair after pair.
class Runner {
 public:
  explicit Runner(RunSettings settings);

  /// Never throws for what is wrong with a pair: that is in `failures`.
  PairReport run(const StereoPair& pair);

 private:
  void run_own(const LoadedPair& images, PairReport& report);
  void run_rival(Rival rival, const LoadedPair& images, PairReport& report);
  void finish(const std::string& method, const cv::Mat& disparity, double seconds,
              const LoadedPair& images, PairReport& report) const;

  RunSettings settings_;
  std::optional<Matcher> matcher_;
};

}  // namespace mtstereo::eval
