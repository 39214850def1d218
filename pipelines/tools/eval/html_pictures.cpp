// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/html_pictures.hpp"

#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tools/eval/input_error.hpp"
#include "tools/eval/pictures.hpp"

namespace mtstereo::eval {
namespace {

constexpr int kQuality = 70;

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j) bits = bits << 8 | (j < count ? bytes[i + j] : 0U);
    for (std::size_t j = 0; j < 4; ++j) {
      text += j <= count ? kDigits[bits >> (18 - 6 * j) & 63U] : '=';
    }
  }
  return text;
}

// Colors of several pixels are averaged.
cv::Mat reduced(const cv::Mat& picture) {
  if (picture.cols <= kHtmlPictureWidth) return picture;
  const double factor = static_cast<double>(kHtmlPictureWidth) / picture.cols;
  const int height = std::max(1, static_cast<int>(std::lround(picture.rows * factor)));
  cv::Mat result;
  cv::resize(picture, result, {kHtmlPictureWidth, height}, 0, 0, cv::INTER_AREA);
  return result;
}

}  // namespace

std::string data_uri(const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality})) {
    throw InputError("a picture of the HTML report cannot be encoded");
  }
  return "data:image/jpeg;base64," + base64(bytes);
}

HtmlPictures html_pictures(const LoadedPair& images, const cv::Mat& disparity,
                           const cv::Mat& confidence, int max_disparity) {
  return {data_uri(reduced(images.left)),
          data_uri(reduced(color_disparity(images.truth.disparity, max_disparity))),
          data_uri(reduced(color_disparity(disparity, max_disparity))),
          data_uri(reduced(color_error(disparity, images.truth))), data_uri(reduced(confidence))};
}

}  // namespace mtstereo::eval
