// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/unused_bits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "lib/files/file_names.hpp"
#include "lib/images/images.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

// Whether an image may have 16 bits: those of most kinds have not.
bool may_have_16_bits(const fs::path& image) {
  const std::string extension = files::extension_of(image);
  if (extension != ".png") return extension.starts_with(".p") || extension.starts_with(".tif");
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

Values values_of(const std::vector<fs::path>& paths) {
  constexpr std::size_t kSamples = 4;
  if (paths.empty() || !may_have_16_bits(paths.front())) return {};
  Values values{true};
  const std::size_t count = std::min(kSamples, paths.size());
  for (std::size_t i = 0; i < count; ++i) {
    cv::Mat image;
    try {
      image = images::read(paths[i * paths.size() / count], cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {
    }
    if (image.depth() != CV_16U || image.empty()) return {};
    image = image.reshape(1);
    double largest = 0;
    cv::minMaxLoc(image, nullptr, &largest);
    cv::Scalar mean, deviation;
    cv::meanStdDev(image, mean, deviation);
    values.largest = std::max(values.largest, largest);
    values.mean += mean[0] / static_cast<double>(count);
    values.deviation = std::max(values.deviation, deviation[0]);
  }
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
std::string narrow_range(const Values& left, const Values& right) {
  constexpr double kNarrow = 4, kSpread = 4;  // [gray values], [standard deviations]
  constexpr double kGray = 256;
  const double deviation = std::max(left.deviation, right.deviation);
  if (deviation == 0 || deviation >= kNarrow * kGray) return "";
  const double least = std::max(std::min(left.mean, right.mean) - kSpread * deviation, 0.0);
  const double most = std::max(left.mean, right.mean) + kSpread * deviation;
  return "The images use few of the values of 16 bits: matching sees about " +
         std::to_string(std::lround((most - least) / kGray) + 1) +
         " of 256 gray values. Stretch both views alike (ImageMagick: mogrify -path FOLDER "
         "-level " +
         std::to_string(std::lround(least)) + "," + std::to_string(std::lround(most)) + " IMAGES).";
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
    const std::string narrow = unused == 0 ? narrow_range(of_left, of_right) : "";
    if (!narrow.empty()) recording.remarks.push_back(narrow);
  } else {
    // One camera of 8 bits.
    set_unused_bits(unused_bits(of_left.largest), "left images", {&left}, recording.remarks);
    set_unused_bits(unused_bits(of_right.largest), "right images", {&right}, recording.remarks);
  }
}

}  // namespace mtstereo::run
