// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/runner.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "eval/input_error.hpp"
#include "eval/rival_sweep.hpp"

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
  if (!status) throw InputError(status.error().message);
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

fs::path output_file(const fs::path& folder, const std::string& method, const std::string& name,
                     const char* extension) {
  // The library's own files go directly into the folder, as the benchmark servers require.
  const fs::path base = method == kOwnMethod ? folder : folder / method;
  return base / (name + extension);
}

}  // namespace

int search_range(const StereoPair& pair, const Parameters& parameters, int width,
                 std::vector<std::string>& notes) {
  const bool asked = parameters.is_set(Parameter::kMaxDisparity);
  if (!asked && !pair.max_disparity) {
    throw InputError(pair.left.parent_path() / "calib.txt",
                     "does not state the search range (ndisp=...); set it with --max-disparity");
  }
  const int wanted = asked ? parameters.integer(Parameter::kMaxDisparity) : *pair.max_disparity;
  const ParameterInfo& info = parameter_info(Parameter::kMaxDisparity);
  const int most = std::min(width, static_cast<int>(info.maximum));
  const int least = static_cast<int>(info.minimum);
  const int range = std::clamp(wanted, std::min(least, most), most);
  if (range != wanted) {
    notes.push_back(pair.name + ": the search range is " + std::to_string(range) + " px, not " +
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

Runner::Runner(RunSettings settings) : settings_(std::move(settings)) {}

PairReport Runner::run(const StereoPair& pair) {
  PairReport report;
  report.pair = pair;
  LoadedPair images;
  const bool loaded = attempt(report, "", [&] {
    images = load_pair(pair, settings_.dmap);
    report.size = images.left.size();
    report.max_disparity =
        search_range(pair, settings_.parameters, report.size.width, report.notes);
  });
  if (!loaded) return report;
  attempt(report, kOwnMethod, [&] { run_own(images, report); });
  for (const Rival rival : settings_.rivals) {
    attempt(report, std::string(rival_name(rival)), [&] { run_rival(rival, images, report); });
  }
  return report;
}

void Runner::run_own(const LoadedPair& images, PairReport& report) {
  Parameters parameters = settings_.parameters;
  require(parameters.set(Parameter::kMaxDisparity, report.max_disparity));
  if (matcher_) {
    require(matcher_->set_parameters(parameters));
  } else {
    Result<Matcher> made = Matcher::create(parameters);
    if (!made) throw InputError(made.error().message);
    matcher_.emplace(std::move(*made));
  }
  DisparityView disparity;
  const double seconds = median_seconds(settings_.warm_up, settings_.repeat, [&] {
    Result<DisparityView> result = matcher_->compute(view_of(images.left), view_of(images.right));
    if (!result) throw InputError(result.error().message);
    disparity = *result;
  });
  const cv::Mat map = to_float(disparity);
  finish(kOwnMethod, map, seconds, images, report);
  if (!settings_.curve) return;
  report.sweeps.push_back(
      {kOwnMethod, confidence_sweep(map, mat_of(matcher_->confidence()), images.truth.disparity)});
}

void Runner::run_rival(Rival rival, const LoadedPair& images, PairReport& report) {
  RivalMatcher matcher(rival, report.max_disparity);
  const double seconds = median_seconds(settings_.warm_up, settings_.repeat,
                                        [&] { matcher.compute(images.left, images.right); });
  const std::string name(rival_name(rival));
  finish(name, matcher.disparity(), seconds, images, report);
  if (!settings_.curve) return;
  report.sweeps.push_back({name, sweep_rival(rival, report.max_disparity, images,
                                             filter_settings(settings_.parameters))});
}

void Runner::finish(const std::string& method, const cv::Mat& disparity, double seconds,
                    const LoadedPair& images, PairReport& report) const {
  MethodResult result;
  result.method = method;
  result.evaluation = evaluate(disparity, images.truth);
  result.seconds = seconds;
  result.seconds_per_megapixel = seconds * 1e6 / static_cast<double>(images.left.total());
  report.results.push_back(std::move(result));

  if (settings_.disparity_folder) {
    const char* extension = extension_of(settings_.disparity_format);
    write_disparity(output_file(*settings_.disparity_folder, method, report.pair.name, extension),
                    disparity, settings_.disparity_format);
  }
  if (settings_.picture_folder) {
    write_picture(output_file(*settings_.picture_folder, method, report.pair.name, ".png"),
                  overview(images.left, disparity, images.truth.disparity, report.max_disparity));
  }
}

}  // namespace mtstereo::eval
