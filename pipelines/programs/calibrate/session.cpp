// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/session.hpp"

#include <array>
#include <csignal>
#include <ctime>
#include <utility>

#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/calibrate/drawings.hpp"

namespace mtstereo::calibrate {
namespace {

constexpr std::size_t kEnoughViews = 20;  // if all of the image is covered
constexpr std::chrono::seconds kHintInterval{10};

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

const char* verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoBoard:
      return "no board in both images";
    case Verdict::kMoving:
      return "hold it still";
    case Verdict::kSimilar:
      return "taken already, move on";
    case Verdict::kTaken:
      break;
  }
  return "taken";
}

}  // namespace

Session::Session(const Options& options, std::ostream& out, std::ostream* status,
                 const std::atomic<bool>& stop)
    : options_(options),
      out_(out),
      status_(status),
      stop_(stop),
      finder_(options.board),
      folder_(options.out, options.overwrite, input_files(options.source)) {}

int Session::run() {
  const std::unique_ptr<PairSource> source = open_source(options_.source);
  const bool video = !source->stills();
  collect(*source);
  if (status_ != nullptr) *status_ << "\r\033[K" << std::flush;
  // From here on, there is nothing to finish: a signal ends the program.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (views_.size() < kFewestViews) {
    throw UserError(too_few_views(counts_, views_.size(), options_.board, video));
  }
  return finish(video);
}

void Session::collect(PairSource& source) {
  ImagePair images;
  while (!stop_ && !enough(source)) {
    const SourceState state = source.next(images);
    if (state == SourceState::kEnd) return;
    if (state == SourceState::kPair) take(images, !source.stills());
    if (source.live()) give_hint();
  }
}

bool Session::enough(const PairSource& source) const {
  if (source.stills()) return false;
  if (views_.size() >= static_cast<std::size_t>(options_.most_views)) return true;
  if (!source.live()) return false;
  if (views_.size() >= kEnoughViews && choice_->coverage().progress().complete()) return true;
  const std::chrono::duration<double> idle = Clock::now() - last_view_;
  return options_.give_up > 0 && idle.count() > options_.give_up;
}

void Session::check_sizes(const ImagePair& images) {
  if (images.left.size() != images.right.size()) {
    throw UserError(images.name + ": the left image is " + size_text(images.left.size()) +
                    ", the right one " + size_text(images.right.size()) +
                    ": both must have the same size");
  }
  if (!choice_) {
    left_size_ = images.left.size();
    right_size_ = images.right.size();
    const bool stills = options_.stills || is_images(options_.source.left);
    choice_.emplace(options_.board, left_size_, right_size_,
                    stills ? Choice::kStills : Choice::kVideo);
  }
  if (images.left.size() != left_size_) {
    throw UserError("the images change their size from " + size_text(left_size_) + " to " +
                    size_text(images.left.size()) + " at " + images.name);
  }
}

void Session::take(const ImagePair& images, bool video) {
  check_sizes(images);
  const CornerPair corners = finder_.find(images.left, images.right);
  const Verdict verdict = choice_->offer(corners, images.time);
  counts_.count(verdict, corners);
  if (video && !options_.stills && corners.usable()) {
    track_.add(images.time, finder_.view_of(corners));
  }
  if (verdict == Verdict::kTaken) {
    folder_.write_view(views_.size(), images, corners);
    views_.push_back(finder_.view_of(corners));
    names_.push_back(images.name);
    last_view_ = Clock::now();
    if (status_ != nullptr) *status_ << "\r\033[K" << std::flush;
    // Of stored images, nobody holds the board any more.
    const std::string missing = choice_->coverage().missing();
    const std::string next = missing.empty() ? "; all is covered"
                             : video         ? "; next, " + missing
                                             : "";
    out_ << "view " << views_.size() << ": " << images.name << ", " << corners.left.ids.size()
         << " and " << corners.right.ids.size() << " corners" << next << std::endl;
  }
  show_status(verdict);
}

void Session::show_status(Verdict verdict) const {
  if (status_ == nullptr) return;
  const Coverage::Progress now = choice_->coverage().progress();
  *status_ << "\r\033[K" << views_.size() << " views | x " << outputs::percent(now.x) << ", y "
           << outputs::percent(now.y) << ", size " << outputs::percent(now.size) << ", tilt "
           << outputs::percent(now.skew) << ", image " << outputs::percent(now.cells) << " | "
           << verdict_text(verdict) << std::flush;
}

// Live video in which nothing happens.
void Session::give_hint() {
  const Clock::time_point now = Clock::now();
  if (now - std::max(last_view_, last_hint_) < kHintInterval) return;
  last_hint_ = now;
  if (status_ != nullptr) *status_ << "\r\033[K" << std::flush;
  if (views_.empty()) {
    out_ << too_few_views(counts_, 0, options_.board, true) << std::endl;
  } else {
    out_ << views_.size() << " views; next, " << choice_->coverage().missing() << std::endl;
  }
}

int Session::finish(bool video) {
  out_ << "calibrating with " << views_.size() << " pairs of " << size_text(left_size_)
       << std::endl;
  const Calibrated calibrated = calibrate(options_.model, left_size_, right_size_, views_);
  Coverage coverage = choice_->coverage();
  if (calibrated.swapped) {
    folder_.swap_sides();
    coverage.swap_sides();
    for (BoardView& view : views_) std::swap(view.left, view.right);
  }
  std::optional<TimeOffset> offset;
  if (video && !options_.stills) {
    offset = estimate_offset(calibrated.solution.rig, track_, calibrated.swapped);
  }
  const Quality quality = judge(calibrated, coverage, offset);
  Report report;
  report.options = &options_;
  report.calibrated = &calibrated;
  report.quality = &quality;
  report.counts = counts_;
  report.names = names_;
  report.date = today();
  const std::size_t shown = calibrated.solution.indices[calibrated.solution.indices.size() / 2];
  folder_.write_image("rectified.png", draw_rectified(calibrated, folder_.view(shown, true),
                                                      folder_.view(shown, false)));
  folder_.write_image("coverage.png", draw_coverage(coverage, views_, left_size_, right_size_));
  folder_.write_image("residuals.png", draw_residuals(calibrated.solution));
  folder_.write_text("report.json", json_of(report));
  StereoCalibration file = calibration_of(calibrated.solution.rig);
  file.format = "mtstereo";
  file.date = report.date;
  const Status status = write_calibration(file, folder_.calibration().string());
  if (!status) throw UserError(status.error().message);
  print_report(out_, report);
  return options_.strict && !quality.warnings.empty() ? kWithWarnings : kWritten;
}

}  // namespace mtstereo::calibrate
