// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/images/images.hpp"

#include "lib/images/open_module.hpp"
#include "lib/outputs/user_error.hpp"

namespace mtstereo::images {
namespace {

const Codecs& codecs() {
  static const Codecs& opened = open_module("libmtstereo-images.so");
  return opened;
}

}  // namespace

cv::Mat read(const std::filesystem::path& file, int flags) {
  const Codecs& opened = codecs();
  try {
    return opened.read(file.string(), flags);
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) throw;
    return {};
  }
}

void refuse_turned(const std::filesystem::path& image) {
  const cv::Mat shown = read(image, cv::IMREAD_GRAYSCALE);
  const cv::Mat stored = read(image, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  const bool equal = shown.size() == stored.size() &&
                     (shown.empty() || cv::norm(shown, stored, cv::NORM_INF) == 0);
  if (equal) return;
  throw UserError(image.string() +
                  ": programs that show this image turn it, as its EXIF data state: store the "
                  "images of both views turned (mogrify -auto-orient FILES)");
}

cv::Mat decode(std::string_view bytes, int flags) {
  // The bytes are not written to.
  const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  return codecs().decode(view, flags);
}

std::string encode(const std::string& suffix, const cv::Mat& image,
                   const std::vector<int>& options) {
  std::vector<unsigned char> bytes;
  if (!codecs().encode(suffix, image, bytes, options)) return {};
  return {bytes.begin(), bytes.end()};
}

}  // namespace mtstereo::images
