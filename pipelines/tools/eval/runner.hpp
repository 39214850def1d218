// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/outputs/listed_folder.hpp"
#include "mtstereo/alignment.hpp"
#include "mtstereo/matcher.hpp"
#include "tools/eval/curve_means.hpp"
#include "tools/eval/datasets.hpp"
#include "tools/eval/degradation.hpp"
#include "tools/eval/flicker.hpp"
#include "tools/eval/images.hpp"
#include "tools/eval/metrics.hpp"
#include "tools/eval/opencv_matchers.hpp"

namespace mtstereo::eval {

/// The library's name among the methods of a report.
inline constexpr const char* kOwnMethod = "mtstereo";

/// The settings of a run.
struct RunSettings {
  Parameters parameters;  ///< max-disparity applies to all pairs if it is set
  /// Align each pair before the library matches it, as the element does; std::nullopt: unless the
  /// preset is the paper's.
  std::optional<bool> align;
  std::vector<OpenCvMethod> opencv_methods;
  int warm_up = 1;  ///< untimed frames before the timed ones
  int repeat = 1;   ///< timed frames; the result is their median
  DmapMeaning dmap = DmapMeaning::kAuto;
  std::optional<std::filesystem::path> disparity_folder;
  std::optional<std::filesystem::path> image_folder;
  bool curve = false;                     ///< sweep the confidence of every method
  std::vector<Degradation> degradations;  ///< evaluated in addition to the images as they are
  std::optional<double> flicker;          ///< standard deviation of its noise [gray values]
  bool stream = false;  ///< the pairs are successive frames, whose flicker is measured
};

/// Whether pairs are aligned.
bool aligns(const RunSettings& settings);

/// The kinds of images of a run: kCleanKind and the texts of the degradations.
std::vector<std::string> kinds_of(const RunSettings& settings);

/// The result of one method on one pair.
struct MethodResult {
  std::string method;
  Evaluation evaluation;
  double seconds = 0;                ///< wall time of one frame, median [s]
  double seconds_per_megapixel = 0;  ///< the same divided by the size of the left image [s/MP]
};

/// The flicker of one method.
struct MethodFlicker {
  std::string method;
  Flicker flicker;
};

/// The results of one pair and one kind of images.
struct PairReport {
  StereoPair pair;
  std::string kind = kCleanKind;
  cv::Size size;                      ///< of the images
  double scale = 1;                   ///< px per px of the original, of an enlarged kind
  int max_disparity = 0;              ///< search range [px]
  std::vector<MethodResult> results;  ///< the library's first; without methods that failed
  std::vector<MethodSweep> sweeps;    ///< with --curve, one per method
  /// with --flicker, of the images as they are; with --stream, of the frames up to this one
  std::vector<MethodFlicker> flicker;
  std::vector<std::string> failures;  ///< one sentence each
  std::vector<std::string> notes;
};

/// The search range of a pair: the requested one, or else the one of the data set, limited to the
/// width of the image and to the library's range. Adds a note if a limit applies. Throws UserError
/// if neither the request nor the data set states one.
int search_range(const StereoPair& pair, const Parameters& parameters, int width,
                 std::vector<std::string>& notes);

/// `wanted` [px] limited to the width of the image and to the library's range. Adds a note that
/// begins with `who` if a limit applies.
int limited_range(const std::string& who, int wanted, int width, std::vector<std::string>& notes);

/// Calls `frame` warm_up times, then times `repeat` calls and returns their median [s].
double median_seconds(int warm_up, int repeat, const std::function<void()>& frame);

/// Runs the library and the methods of OpenCV on each pair.
class Runner {
 public:
  /// Creates and locks the folders of maps and images. Throws UserError.
  explicit Runner(RunSettings settings);

  /// The images as they are. Does not throw for a pair that cannot be used: `failures` has the
  /// reason.
  PairReport run(const StereoPair& pair);

  /// The same for each kind of kinds_of(), in this order. The pair is read once. Only the clean
  /// pair if it cannot be read.
  std::vector<PairReport> run_kinds(const StereoPair& pair);

 private:
  outputs::ListedFolder& listed(const std::filesystem::path& folder);
  PairReport load(const StereoPair& pair, LoadedPair& images) const;
  void run_degraded(const Degradation& degradation, const LoadedPair& images, PairReport& report);
  void run_methods(const LoadedPair& images, PairReport& report);
  void run_own(const LoadedPair& images, PairReport& report);
  void run_opencv(OpenCvMethod method, const LoadedPair& images, PairReport& report);
  void run_flicker(const LoadedPair& images, PairReport& report);
  void run_own_flicker(const LoadedPair& images, PairReport& report);
  LoadedPair noisy(const LoadedPair& images, int frame) const;
  cv::Mat own_map(const LoadedPair& images);
  void prepare_matcher(const LoadedPair& images, int max_disparity);
  int warm_up(const PairReport& report) const;
  void finish(const std::string& method, const cv::Mat& disparity, double seconds,
              const LoadedPair& images, PairReport& report);

  RunSettings settings_;
  std::map<std::filesystem::path, std::unique_ptr<outputs::ListedFolder>> folders_;
  std::optional<Matcher> matcher_;
  std::optional<AlignmentTracker> tracker_;
  std::map<std::string, FlickerWindow> streams_;  // by method
};

}  // namespace mtstereo::eval
