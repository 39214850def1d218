// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/unused_bits.hpp"

#include <gst/video/video.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "lib/files/file_names.hpp"
#include "lib/images/images.hpp"
#include "recordings/media/video_scan.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

// Whether an image may have 16 bits: those of most kinds have not.
bool may_have_16_bits(const fs::path& image) {
  const std::string extension = files::extension_of(image);
  if (extension != ".png")
    return extension.starts_with(".p") || extension.starts_with(".tif") || extension == ".jp2";
  constexpr std::size_t kDepthPlace = 24;  // of the bits per channel in a PNG
  std::array<char, kDepthPlace + 1> head{};
  std::ifstream(image, std::ios::binary).read(head.data(), head.size());
  return head[kDepthPlace] == 16;
}

// The values of some images.
struct Values {
  bool known = false;  // they have 16 bits
  double largest = 0, mean = 0, deviation = 0;
};

// Adds those of one of `count` images.
void add_image(const cv::Mat& image, std::size_t count, Values& values) {
  double largest = 0;
  cv::minMaxLoc(image, nullptr, &largest);
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  values.largest = std::max(values.largest, largest);
  values.mean += mean[0] / static_cast<double>(count);
  values.deviation = std::max(values.deviation, deviation[0]);
}

Values values_of(const std::vector<fs::path>& paths) {
  constexpr std::size_t kSamples = 4;
  if (paths.empty() || !may_have_16_bits(paths.front())) return {};
  Values values{true};
  const std::size_t count = std::min(kSamples, paths.size());
  for (std::size_t i = 0; i < count; ++i) {
    const cv::Mat image = images::read(paths[i * paths.size() / count], cv::IMREAD_UNCHANGED);
    if (image.depth() != CV_16U || image.empty()) return {};
    add_image(image.reshape(1), count, values);
  }
  return values;
}

// Those of the first frame of a video.
Values values_of_video(const fs::path& video) {
  constexpr GstVideoFormat kGray =
      G_BYTE_ORDER == G_LITTLE_ENDIAN ? GST_VIDEO_FORMAT_GRAY16_LE : GST_VIDEO_FORMAT_GRAY16_BE;
  VideoScan scan(video, Reading::kDecoded);
  GstVideoInfo info;
  if (!scan.next() ||
      gst_video_info_from_caps(&info, gst_sample_get_caps(scan.sample())) == FALSE ||
      GST_VIDEO_INFO_FORMAT(&info) != kGray) {
    return {};
  }
  Values values{true};
  GstVideoFrame frame;
  if (gst_video_frame_map(&frame, &info, gst_sample_get_buffer(scan.sample()), GST_MAP_READ) ==
      FALSE) {
    return {};
  }
  const cv::Mat image(GST_VIDEO_FRAME_HEIGHT(&frame), GST_VIDEO_FRAME_WIDTH(&frame), CV_16UC1,
                      GST_VIDEO_FRAME_PLANE_DATA(&frame, 0),
                      static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0)));
  add_image(image, 1, values);
  gst_video_frame_unmap(&frame);
  return values;
}

// The high bits that no value uses.
int unused_bits(double largest) {
  for (const int unused : {8, 6, 4, 2}) {  // of cameras with 8, 10, 12 or 14 bits
    if (largest > 0 && largest * (1 << unused) <= 65535) return unused;
  }
  return 0;
}

// Thermal cameras use a small part of the values, far above 0. Matching reads 256 gray values.
constexpr double kGrayValue = 256;  // values of 16 bits
constexpr double kNarrow = 4;       // [gray values]

std::string narrow_range(const Values& left, const Values& right, bool video) {
  constexpr double kSpread = 4;  // [standard deviations]
  const double deviation = std::max(left.deviation, right.deviation);
  if (deviation == 0 || deviation >= kNarrow * kGrayValue) return "";
  const double least = std::max(std::min(left.mean, right.mean) - kSpread * deviation, 0.0);
  const double most = std::max(left.mean, right.mean) + kSpread * deviation;
  const std::string from = std::to_string(std::lround(least));
  const std::string remedy = video ? "ffmpeg -i FILE -vf 'lut=(val-" + from + ")*" +
                                         std::to_string(std::lround(65535 / (most - least))) +
                                         "' -c:v ffv1 view.mkv)."
                                   : "ImageMagick: mogrify -path FOLDER -level " + from + "," +
                                         std::to_string(std::lround(most)) + " IMAGES).";
  return std::string(video ? "The videos use" : "The images use") +
         " few of the values of 16 bits: matching sees about " +
         std::to_string(std::lround((most - least) / kGrayValue) + 1) +
         " of 256 gray values. Stretch both views alike (" + remedy;
}

void set_unused_bits(int unused, const std::string& images, std::vector<Source*> sources,
                     std::vector<std::string>& remarks) {
  if (unused == 0) return;
  for (Source* source : sources) source->unused_bits = unused;
  remarks.push_back("The " + images + " have " + std::to_string(16 - unused) +
                    " of 16 bits: their values are multiplied by " + std::to_string(1 << unused) +
                    ".");
}

}  // namespace

void find_unused_bits(Recording& recording) {
  Source &left = recording.left, &right = recording.right;
  const Values of_left = values_of(left.images);
  const Values of_right = right.empty() ? of_left : values_of(right.images);
  if (of_left.known && of_right.known) {
    const int unused = unused_bits(std::max(of_left.largest, of_right.largest));
    set_unused_bits(unused, "images", {&left, &right}, recording.remarks);
    const std::string narrow = unused == 0 ? narrow_range(of_left, of_right, false) : "";
    if (!narrow.empty()) recording.remarks.push_back(narrow);
  } else {
    // One camera of 8 bits.
    set_unused_bits(unused_bits(of_left.largest), "left images", {&left}, recording.remarks);
    set_unused_bits(unused_bits(of_right.largest), "right images", {&right}, recording.remarks);
  }
}

void note_narrow_video(Recording& recording, const cv::Mat& first) {
  const Source &left = recording.left, &right = recording.right;
  cv::Scalar mean, deviation;
  cv::meanStdDev(first, mean, deviation);
  if (left.video.empty() || deviation[0] >= kNarrow) return;
  const Values of_left = values_of_video(left.video);
  const Values of_right = right.empty() ? of_left : values_of_video(right.video);
  if (!of_left.known || !of_right.known) return;
  const std::string narrow = narrow_range(of_left, of_right, true);
  if (!narrow.empty()) recording.remarks.push_back(narrow);
}

}  // namespace mtstereo::run
