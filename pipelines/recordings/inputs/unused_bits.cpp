// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/unused_bits.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

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

// The largest value of some images; all of 16 bits if one has other values.
double largest_value(const std::vector<fs::path>& paths) {
  constexpr std::size_t kSamples = 4;
  constexpr double kAll = 65535;
  double largest = 0;
  const std::size_t count = std::min(kSamples, paths.size());
  for (std::size_t i = 0; i < count; ++i) {
    cv::Mat image;
    try {
      image = images::read(paths[i * paths.size() / count], cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {
      return kAll;
    }
    if (image.depth() != CV_16U) return kAll;
    double value = 0;
    cv::minMaxLoc(image.reshape(1), nullptr, &value);
    largest = std::max(largest, value);
  }
  return largest;
}

}  // namespace

void find_unused_bits(Recording& recording) {
  if (recording.left.images.empty() || !may_have_16_bits(recording.left.images.front())) return;
  const double largest =
      std::max(largest_value(recording.left.images), largest_value(recording.right.images));
  for (const int unused : {8, 6, 4, 2}) {  // of cameras with 8, 10, 12 or 14 bits
    const int factor = 1 << unused;
    if (largest == 0 || largest * factor > 65535) continue;
    recording.left.unused_bits = recording.right.unused_bits = unused;
    recording.remarks.push_back("The images have " + std::to_string(16 - unused) +
                                " of 16 bits: their values are multiplied by " +
                                std::to_string(factor) + ".");
    return;
  }
}

}  // namespace mtstereo::run
