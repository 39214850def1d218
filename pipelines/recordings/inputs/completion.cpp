// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/completion.hpp"

#include <algorithm>
#include <utility>

#include "lib/outputs/printable.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/calibration_choice.hpp"
#include "recordings/inputs/halves.hpp"
#include "recordings/inputs/mosaic.hpp"
#include "recordings/inputs/sources.hpp"
#include "recordings/inputs/unused_bits.hpp"
#include "recordings/inputs/view_rectifier.hpp"
#include "recordings/media/container.hpp"
#include "recordings/media/sample_frames.hpp"
#include "recordings/media/video_scan.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

constexpr int kSamples = 3;  // frames in which halves are matched

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height) + " px";
}

const char* name_of(Arrangement arrangement) {
  return arrangement == Arrangement::kSideBySide ? "side by side" : "one above the other";
}

// How a user gives the other view of a source that has one.
std::string advice_for(const Source& source) {
  if (source.images.size() > 1) return "give the views as two images, folders or patterns";
  if (source.video.empty()) return "give the other view too";
  if (has_second_view(source.video)) {
    return "it is a spatial video (MV-HEVC), of which one view is decoded: put both side by side "
           "(ffmpeg 7.1 or later: ffmpeg -i FILE -filter_complex '[0:v:view:0][0:v:view:1]hstack' "
           "views.mkv)";
  }
  VideoScan scan(source.video, Reading::kGray);
  scan.next();
  if (scan.video_streams() < 2) return "give the other view too";
  return "it has " + std::to_string(scan.video_streams()) +
         " video streams, of which the first one is read: write them to two files (ffmpeg -i FILE "
         "-map 0:v:0 -c copy left.mkv -map 0:v:1 -c copy right.mkv)";
}

// Whether every other row is of the other view: rows that are two apart are more alike.
bool rows_alternate(const cv::Mat& frame) {
  constexpr double kLess = 1.3;  // 0.5 to 1 in other images
  const int rows = frame.rows - 2;
  if (rows < 2) return false;
  const auto difference = [&](int step) {
    return cv::norm(frame.rowRange(0, rows), frame.rowRange(step, rows + step), cv::NORM_L1);
  };
  return difference(1) > kLess * difference(2);
}

// What to do with both views in alternating rows or columns; empty for other frames.
std::string advice_for_alternation(const cv::Mat& frame) {
  const bool rows = rows_alternate(frame);
  if (!rows && !rows_alternate(frame.t())) return {};
  return std::string(rows ? "its rows" : "its columns") +
         " alternate between two views: put them side by side (ffmpeg -i FILE -vf stereo3d=" +
         (rows ? "irl" : "icl") + ":sbsl views.mkv)";
}

// How the user gives the arrangement of a frame whose shape does not tell it.
std::string advice_for_layout(const Recording& recording, const std::vector<cv::Mat>& frames) {
  const cv::Size size = frames.front().size();
  for (const Arrangement each : {Arrangement::kSideBySide, Arrangement::kTopBottom}) {
    const bool beside = each == Arrangement::kSideBySide;
    if ((beside ? size.width : size.height) % 2 != 0) continue;
    if (!match_halves(frames, each, std::nullopt).confirmed) continue;
    return std::string("its halves match ") + name_of(each) + ": state --layout " +
           (beside ? "side-by-side" : "top-bottom");
  }
  const std::string alternation = advice_for_alternation(frames.front());
  if (!alternation.empty()) return alternation;
  return advice_for(recording.left) + ", or state the arrangement (--layout)";
}

// The arrangement that the shape of a frame suggests.
Arrangement guess_arrangement(const Recording& recording, cv::Size size) {
  const std::optional<Arrangement> shape = arrangement_by_shape(size.width, size.height);
  const bool odd =
      shape && (*shape == Arrangement::kSideBySide ? size.width : size.height) % 2 != 0;
  if (shape && !odd) return *shape;
  throw UserError(file_of(recording.left).string() + ": " + size_text(size) +
                  " is the shape of one view: " +
                  advice_for_layout(recording, sample_frames(recording.left, kSamples)));
}

// Checks that the halves match, and finds which one is the left view unless the user states it.
void confirm_arrangement(Recording& recording, cv::Size size, cv::Size half, bool swap) {
  const std::vector<cv::Mat> frames = sample_frames(recording.left, kSamples);
  const auto calibration = rectifying_calibration(recording, half.width, half.height);
  HalvesMatch match = match_halves(frames, recording.arrangement, calibration);
  // Views that only match before they are rectified keep their order: the calibration is wrong.
  if (!match.confirmed && calibration) {
    match = match_halves(frames, recording.arrangement, std::nullopt);
    match.swapped = false;
  }
  const std::string text = size_text(size) + ", " + name_of(recording.arrangement) + ": " +
                           outputs::percent(std::max(match.forward, match.backward)) +
                           " of the points of one half are in the other one";
  if (!match.confirmed) {
    throw UserError(file_of(recording.left).string() +
                    ": by its shape it may have both views, but its halves do not match (" + text +
                    "): " + advice_for_layout(recording, frames));
  }
  recording.remarks.push_back("Both views are in one frame (" + text + ").");
  if (swap || !match.swapped) return;
  recording.swapped = true;
  recording.remarks.push_back("The first half is the right view: in the other order " +
                              outputs::percent(match.backward) +
                              " of the points match instead of " + outputs::percent(match.forward) +
                              ". --layout keeps the order.");
}

cv::Size half_size(cv::Size size, Arrangement arrangement, const fs::path& file) {
  const bool beside = arrangement == Arrangement::kSideBySide;
  if ((beside ? size.width : size.height) % 2 != 0) {
    throw UserError(file.string() + ": " + size_text(size) + " cannot be halved: its " +
                    (beside ? "width" : "height") +
                    " is odd; write the views to two files, or cut off a pixel (ffmpeg -vf crop)");
  }
  return beside ? cv::Size(size.width / 2, size.height) : cv::Size(size.width, size.height / 2);
}

// Encoders take no frames of a single row or column.
void refuse_line(const fs::path& file, cv::Size size) {
  if (size.width > 1 && size.height > 1) return;
  throw UserError(file.string() + ": " + size_text(size) +
                  " is a single row or column, and no view: give whole images");
}

void note_mosaic(Recording& recording, const cv::Mat& frame) {
  if (!is_mosaic(frame)) return;
  recording.remarks.emplace_back(
      "The views are the mosaic of a color camera (Bayer), which makes disparities less exact and "
      "more of them wrong: convert them to gray or color first (cv2.cvtColor, "
      "cv2.COLOR_BayerBG2GRAY or that of the camera).");
}

// The size of a view.
cv::Size size_of_two(Recording& recording) {
  const cv::Mat first = first_frame(recording.left);
  refuse_line(file_of(recording.left), first.size());
  note_mosaic(recording, first);
  note_narrow_video(recording, first);
  const cv::Size left = first.size();
  const cv::Size right = first_frame(recording.right).size();
  if (left == right) return left;
  throw UserError("the views have different sizes: " + file_of(recording.left).string() + " has " +
                  size_text(left) + ", " + file_of(recording.right).string() + " has " +
                  size_text(right) + ": record both in the same mode, or convert one of them");
}

// One source: the calibration is for a half, and decides how the halves match.
void complete_one(FoundRecording& found, const InputOptions& options) {
  Recording& recording = found.recording;
  const cv::Mat first = first_frame(recording.left);
  note_mosaic(recording, first);
  note_narrow_video(recording, first);
  const cv::Size size = first.size();
  recording.arrangement = options.arrangement.value_or(Arrangement::kTwoSources);
  if (!options.arrangement) recording.arrangement = guess_arrangement(recording, size);
  recording.swapped = options.swap;
  const cv::Size half = half_size(size, recording.arrangement, file_of(recording.left));
  refuse_line(file_of(recording.left), half);
  choose_calibration(found, options, half.width, half.height);
  if (!options.arrangement) confirm_arrangement(recording, size, half, options.swap);
}

}  // namespace

Recording completed(FoundRecording found, const InputOptions& options) {
  Recording& recording = found.recording;
  recording.name = outputs::printable(recording.name);  // it becomes that of a folder
  find_unused_bits(recording);
  if (recording.right.empty()) {
    complete_one(found, options);
    return std::move(recording);
  }
  if (options.swap) std::swap(recording.left, recording.right);
  const cv::Size size = size_of_two(recording);
  choose_calibration(found, options, size.width, size.height);
  return std::move(recording);
}

}  // namespace mtstereo::run
