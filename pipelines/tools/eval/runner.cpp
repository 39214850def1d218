// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/runner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <new>
#include <sstream>
#include <utility>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/degrade.hpp"
#include "tools/eval/metrics.hpp"
#include "tools/eval/opencv_sweep.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

GrayView view_of(const cv::Mat& image) {
  return GrayView{image.ptr<std::uint8_t>(), image.cols, image.rows,
                  static_cast<std::ptrdiff_t>(image.step)};
}

// No copy; valid as long as the view.
cv::Mat mat_of(GrayView view) {
  return {view.height, view.width, CV_8UC1, const_cast<std::uint8_t*>(view.data),
          static_cast<std::size_t>(view.stride)};
}

void require(const Status& status) {
  if (!status) throw UserError(status.error().message);
}

// Runs `step`; an exception becomes a failure whose text begins with `who`.
template <typename Step>
bool attempt(PairReport& report, const std::string& who, Step step) {
  const std::string prefix = who.empty() ? "" : who + ": ";
  try {
    step();
    return true;
  } catch (const std::bad_alloc&) {
    report.failures.push_back(prefix + "out of memory");
  } catch (const std::exception& error) {
    report.failures.push_back(prefix + error.what());
  }
  return false;
}

// The library's own files go directly into the folder, as the benchmark servers require. Each
// degradation and each method of OpenCV has a subfolder.
std::string output_name(const std::string& method, const PairReport& report,
                        const char* extension) {
  fs::path base = report.kind == kCleanKind ? fs::path() : fs::path(report.kind);
  if (method != kOwnMethod) base /= method;
  return (base / (report.pair.name + extension)).generic_string();
}

void note_foreign_factor(const cv::Mat& map, const LoadedPair& images, PairReport& report) {
  const auto factor = foreign_factor(map, images.truth.disparity);
  if (!factor) return;
  std::ostringstream text;
  text.precision(3);
  text << report.pair.name << ": most disparities are " << *factor
       << " times the ground truth, which seems to have another scale: .pfm must have px, 16-bit "
          ".png px * 256, and 8-bit .png px";
  report.notes.push_back(text.str());
}

}  // namespace

int search_range(const StereoPair& pair, const Parameters& parameters, int width,
                 std::vector<std::string>& notes) {
  const bool asked = parameters.is_set(Parameter::kMaxDisparity);
  if (!asked && !pair.max_disparity) {
    throw UserError(pair.left.parent_path() / "calib.txt",
                    "does not state the search range (ndisp=...); set it with --max-disparity");
  }
  const int wanted = asked ? parameters.integer(Parameter::kMaxDisparity) : *pair.max_disparity;
  return limited_range(pair.name, wanted, width, notes);
}

int limited_range(const std::string& who, int wanted, int width, std::vector<std::string>& notes) {
  const ParameterInfo& info = parameter_info(Parameter::kMaxDisparity);
  const int most = std::min(width, static_cast<int>(info.maximum));
  const int least = static_cast<int>(info.minimum);
  const int range = std::clamp(wanted, std::min(least, most), most);
  if (range != wanted) {
    notes.push_back(who + ": the search range is " + std::to_string(range) + " px, not " +
                    std::to_string(wanted) + " px: " +
                    (wanted > width   ? "the image is " + std::to_string(width) + " px wide"
                     : wanted > range ? "the maximum of the library"
                                      : "the minimum of the library"));
  }
  return range;
}

double median_seconds(int warm_up, int repeat, const std::function<void()>& frame) {
  using Clock = std::chrono::steady_clock;
  for (int i = 0; i < warm_up; ++i) frame();
  std::vector<double> seconds;
  for (int i = 0; i < std::max(repeat, 1); ++i) {
    const Clock::time_point start = Clock::now();
    frame();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  std::sort(seconds.begin(), seconds.end());
  const std::size_t middle = seconds.size() / 2;
  return seconds.size() % 2 == 1 ? seconds[middle] : (seconds[middle - 1] + seconds[middle]) / 2;
}

bool aligns(const RunSettings& settings) {
  return settings.align.value_or(settings.parameters.preset() != Preset::kPaper);
}

Runner::Runner(RunSettings settings) : settings_(std::move(settings)) {
  for (const auto& folder : {settings_.disparity_folder, settings_.image_folder}) {
    if (folder) listed(*folder);
  }
}

// Maps and images may be in the same folder.
outputs::ListedFolder& Runner::listed(const fs::path& folder) {
  std::unique_ptr<outputs::ListedFolder>& files =
      folders_[fs::weakly_canonical(fs::absolute(folder))];
  if (!files) files = std::make_unique<outputs::ListedFolder>(folder, "mtstereo-eval");
  return *files;
}

std::vector<std::string> kinds_of(const RunSettings& settings) {
  std::vector<std::string> kinds{kCleanKind};
  for (const Degradation& degradation : settings.degradations) {
    kinds.push_back(degradation_text(degradation));
  }
  return kinds;
}

// `failures` has the reason if the pair cannot be read.
PairReport Runner::load(const StereoPair& pair, LoadedPair& images) const {
  PairReport report;
  report.pair = pair;
  attempt(report, "", [&] {
    images = load_pair(pair, settings_.dmap);
    report.size = images.left.size();
    report.max_disparity =
        search_range(pair, settings_.parameters, report.size.width, report.notes);
  });
  return report;
}

PairReport Runner::run(const StereoPair& pair) {
  LoadedPair images;
  PairReport report = load(pair, images);
  if (!report.failures.empty()) return report;
  run_methods(images, report);
  if (settings_.flicker) run_flicker(images, report);
  return report;
}

std::vector<PairReport> Runner::run_kinds(const StereoPair& pair) {
  std::vector<PairReport> reports;
  LoadedPair images;
  const PairReport start = load(pair, images);
  reports.push_back(start);
  if (!start.failures.empty()) return reports;
  run_methods(images, reports[0]);
  if (settings_.flicker) run_flicker(images, reports[0]);
  for (const Degradation& degradation : settings_.degradations) {
    PairReport report = start;
    report.notes.clear();
    run_degraded(degradation, images, report);
    reports.push_back(std::move(report));
  }
  return reports;
}

// `report` has the search range of the pair as it is.
void Runner::run_degraded(const Degradation& degradation, const LoadedPair& images,
                          PairReport& report) {
  report.kind = degradation_text(degradation);
  DegradedPair pair;
  const bool done = attempt(report, report.kind,
                            [&] { pair = degrade(degradation, images, report.max_disparity); });
  if (!done) return;
  report.size = pair.images.left.size();
  report.scale = pair.images.truth.scale;
  report.max_disparity = limited_range(report.pair.name + ", " + report.kind, pair.max_disparity,
                                       report.size.width, report.notes);
  run_methods(pair.images, report);
}

void Runner::run_methods(const LoadedPair& images, PairReport& report) {
  const std::string prefix = report.kind == kCleanKind ? "" : report.kind + ": ";
  attempt(report, prefix + kOwnMethod, [&] { run_own(images, report); });
  for (const OpenCvMethod method : settings_.opencv_methods) {
    attempt(report, prefix + std::string(opencv_name(method)),
            [&] { run_opencv(method, images, report); });
  }
}

// Times are compared on the images as they are; those of degraded ones need no warm-up.
int Runner::warm_up(const PairReport& report) const {
  return report.kind == kCleanKind ? settings_.warm_up : 0;
}

void Runner::prepare_matcher(const LoadedPair& images, int max_disparity) {
  Parameters parameters = settings_.parameters;
  require(parameters.set(Parameter::kMaxDisparity, max_disparity));
  const int min_disparity = static_cast<int>(
      std::floor(images.truth.scale * parameters.integer(Parameter::kMinDisparity)));
  require(parameters.set(Parameter::kMinDisparity, min_disparity));
  if (matcher_) {
    require(matcher_->set_parameters(parameters));
    if (!settings_.stream) matcher_->restart();  // each pair is a stream of its own
  } else {
    Result<Matcher> made = Matcher::create(parameters);
    if (!made) throw UserError(made.error().message);
    matcher_.emplace(std::move(*made));
  }
  if (!aligns(settings_)) return;
  if (!tracker_) {
    Result<AlignmentTracker> made = AlignmentTracker::create();
    if (!made) throw UserError(made.error().message);
    tracker_.emplace(std::move(*made));
  }
  if (!settings_.stream) tracker_->reset();
  require(
      tracker_->inspect(view_of(images.left), view_of(images.right), max_disparity, min_disparity));
  require(matcher_->set_correction(tracker_->correction()));
}

void Runner::run_own(const LoadedPair& images, PairReport& report) {
  prepare_matcher(images, report.max_disparity);
  FrameResult found;
  const double seconds = median_seconds(warm_up(report), settings_.repeat, [&] {
    if (!settings_.stream) matcher_->forget();  // the frame is the same one
    Result<FrameResult> result = matcher_->compute(view_of(images.left), view_of(images.right));
    if (!result) throw UserError(result.error().message);
    found = *result;
  });
  const cv::Mat map = to_float(found.disparity, matcher_->parameters().disparity_offset());
  const cv::Mat confidence = mat_of(found.confidence);
  finish(kOwnMethod, map, seconds, images, report);
  if (report.kind == kCleanKind) note_foreign_factor(map, images, report);
  if (!settings_.curve) return;
  report.sweeps.push_back({kOwnMethod, confidence_sweep(map, confidence, images.truth)});
}

void Runner::run_opencv(OpenCvMethod method, const LoadedPair& images, PairReport& report) {
  OpenCvMatcher matcher(method, report.max_disparity);
  const double seconds = median_seconds(warm_up(report), settings_.repeat,
                                        [&] { matcher.compute(images.left, images.right); });
  const std::string name(opencv_name(method));
  finish(name, matcher.disparity(), seconds, images, report);
  if (!settings_.curve) return;
  report.sweeps.push_back({name, sweep_opencv(method, report.max_disparity, images,
                                              filter_settings(settings_.parameters))});
}

void Runner::finish(const std::string& method, const cv::Mat& disparity, double seconds,
                    const LoadedPair& images, PairReport& report) {
  MethodResult result;
  result.method = method;
  result.evaluation = evaluate(disparity, images);
  if (settings_.stream) {
    FlickerWindow& stream = streams_[method];
    stream.add(disparity, images.truth);
    if (const auto flicker = stream.measure()) report.flicker.push_back({method, *flicker});
  }
  result.seconds = seconds;
  result.seconds_per_megapixel = seconds * 1e6 / static_cast<double>(images.left.total());
  report.results.push_back(std::move(result));

  if (settings_.disparity_folder) {
    const std::string name = output_name(method, report, ".pfm");
    outputs::ListedFolder& files = listed(*settings_.disparity_folder);
    write_disparity(files.listed(name), disparity);
    files.measure(name);
  }
  if (settings_.image_folder) {
    const std::string name = output_name(method, report, ".png");
    outputs::ListedFolder& files = listed(*settings_.image_folder);
    write_image(files.listed(name), overview(images, disparity, report.max_disparity));
    files.measure(name);
  }
}

cv::Mat Runner::own_map(const LoadedPair& images) {
  Result<FrameResult> result = matcher_->compute(view_of(images.left), view_of(images.right));
  if (!result) throw UserError(result.error().message);
  return to_float(result->disparity, matcher_->parameters().disparity_offset());
}

// The frame of a still scene.
LoadedPair Runner::noisy(const LoadedPair& images, int frame) const {
  LoadedPair result{images.left.clone(), images.right.clone(), {}};
  add_flicker_noise(*settings_.flicker, frame, result.left, result.right);
  return result;
}

// The frames before the ones that are measured come first.
void Runner::run_own_flicker(const LoadedPair& images, PairReport& report) {
  prepare_matcher(noisy(images, 0), report.max_disparity);
  const bool leads = settings_.parameters.text(Parameter::kTemporal) != "off";
  FlickerWindow stream;
  for (int i = leads ? -kFlickerLead : 0; i < kFlickerFrames; ++i) {
    const int frame = i < 0 ? kFlickerFrames + kFlickerLead + i : i;
    stream.add(own_map(noisy(images, frame)), images.truth);
  }
  report.flicker.push_back({kOwnMethod, stream.measure().value()});
}

void Runner::run_flicker(const LoadedPair& images, PairReport& report) {
  attempt(report, std::string("flicker: ") + kOwnMethod, [&] { run_own_flicker(images, report); });
  for (const OpenCvMethod method : settings_.opencv_methods) {
    const std::string name(opencv_name(method));
    attempt(report, "flicker: " + name, [&] {
      OpenCvMatcher matcher(method, report.max_disparity);
      FlickerWindow stream;
      for (int i = 0; i < kFlickerFrames; ++i) {
        const LoadedPair frame = noisy(images, i);
        matcher.compute(frame.left, frame.right);
        stream.add(matcher.disparity(), images.truth);
      }
      report.flicker.push_back({name, stream.measure().value()});
    });
  }
}

}  // namespace mtstereo::eval
