// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/ground_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>

#include "lib/images/images.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/bytes.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/pfm.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// The image as stored. The bytes are read first, because OpenCV does not distinguish a missing
// file, a folder and a corrupt image.
cv::Mat read_stored(const fs::path& file) {
  const std::string bytes = read_bytes(file);
  if (bytes.empty()) throw UserError(file, "is empty");
  cv::Mat image;
  try {
    image = images::decode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw UserError(file, "cannot be decoded: " + error.err);
  }
  if (image.empty()) throw UserError(file, "is corrupt or not an image in a known format");
  return image;
}

cv::Vec3d center_of(const std::array<double, 11>& n) {
  const double length = std::sqrt(n[4] * n[4] + n[5] * n[5] + n[6] * n[6] + n[7] * n[7]);
  const double w = n[4] / length, x = n[5] / length, y = n[6] / length, z = n[7] / length;
  const cv::Matx33d rotation(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                             2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                             2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y));
  return -(rotation.t() * cv::Vec3d(n[8], n[9], n[10]));
}

}  // namespace

cv::Mat read_pfm_disparity(const fs::path& file) {
  cv::Mat map = read_pfm(file);
  const auto is_positive = [](float v) { return std::isfinite(v) && v > 0; };
  const float* begin = map.ptr<float>();
  const bool mirrored = std::none_of(begin, begin + map.total(), is_positive);
  for (float& value : cv::Mat_<float>(map)) {
    if (mirrored) value = -value;
    if (!is_positive(value)) value = kUnknown;
  }
  return map;
}

cv::Mat read_png_disparity(const fs::path& file) {
  const cv::Mat stored = read_stored(file);
  double scale = 1;
  if (stored.type() == CV_16UC1) {
    scale = 256;
  } else if (stored.type() != CV_8UC1) {
    throw UserError(file, "is not a disparity map: it has " + std::to_string(stored.channels()) +
                              " channels instead of one with 8 or 16 bit");
  }
  cv::Mat map;
  stored.convertTo(map, CV_32F, 1 / scale);
  for (float& value : cv::Mat_<float>(map)) {
    if (value == 0) value = kUnknown;
  }
  return map;
}

cv::Mat read_sintel_disparity(const fs::path& file) {
  cv::Mat map = read_stored(file);
  if (map.type() != CV_8UC3) throw UserError(file, "is no disparity of Sintel: it is not RGB");
  const cv::Matx13f of_blue_green_red(1.0F / 16384, 1.0F / 64, 4);
  map.convertTo(map, CV_32F);
  cv::transform(map, map, of_blue_green_red);
  map.setTo(kUnknown, map == 0);
  return map;
}

cv::Mat read_png_depth(const fs::path& file, double product) {
  const cv::Mat stored = read_stored(file);
  if (stored.type() != CV_16UC1) throw UserError(file, "is no depth image: 16 bits are needed");
  constexpr float kSky = 65535;
  cv::Mat map;
  stored.convertTo(map, CV_32F);
  for (float& value : cv::Mat_<float>(map)) {
    value = value > 0 && value < kSky ? static_cast<float>(product / value) : kUnknown;
  }
  return map;
}

cv::Mat read_dmap(const fs::path& file, cv::Size size) {
  const std::string bytes = read_bytes(file);
  const std::size_t needed = static_cast<std::size_t>(size.area()) * sizeof(float);
  if (bytes.size() != needed) {
    throw UserError(file, "has " + std::to_string(bytes.size()) + " bytes; an image of " +
                              size_text(size.width, size.height) + " needs " +
                              std::to_string(needed));
  }
  cv::Mat map(size, CV_32FC1);
  const char* source = bytes.data();
  for (int x = 0; x < size.width; ++x) {
    for (int y = 0; y < size.height; ++y, source += sizeof(float)) {
      const float value = load_float(source, std::endian::big);
      const bool known = std::isfinite(value) && value > 0 && value < kDmapNothingHit;
      map.at<float>(y, x) = known ? value : kUnknown;
    }
  }
  return map;
}

Camera read_camera(const fs::path& file) {
  std::istringstream stream(read_bytes(file));
  std::array<double, 11> numbers{};
  for (double& number : numbers) {
    if (!(stream >> number)) {
      throw UserError(file, "does not contain the 11 numbers fx fy cx cy qw qx qy qz tx ty tz");
    }
  }
  if (!(numbers[0] > 0)) throw UserError(file, "the focal length is not above 0");
  if (numbers[4] == 0 && numbers[5] == 0 && numbers[6] == 0 && numbers[7] == 0) {
    throw UserError(file, "the quaternion is 0");
  }
  return Camera{numbers[0], numbers[2], center_of(numbers)};
}

cv::Mat depth_to_disparity(const cv::Mat& depth, const Camera& left, const Camera& right) {
  const double baseline = cv::norm(left.center - right.center);
  if (!(baseline > 0)) throw UserError("the two cameras have the same position");
  const double shift = left.principal_x - right.principal_x;
  cv::Mat disparity = depth.clone();
  for (float& value : cv::Mat_<float>(disparity)) {
    const double d = left.focal_length * baseline / value + shift;
    value = d >= 0 ? static_cast<float>(d) : kUnknown;
  }
  return disparity;
}

cv::Mat read_gray(const fs::path& file) {
  cv::Mat image = read_stored(file);
  if (image.depth() == CV_16U) {
    image.convertTo(image, CV_8U, 1.0 / 257);
  } else if (image.depth() != CV_8U) {
    throw UserError(file, "has neither 8 nor 16 bits per value");
  }
  switch (image.channels()) {
    case 1:
      break;
    case 3:
      cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
      break;
    case 4:
      cv::cvtColor(image, image, cv::COLOR_BGRA2GRAY);
      break;
    default:
      throw UserError(file, "has " + std::to_string(image.channels()) + " channels; 1, 3 or 4 do");
  }
  return image;
}

cv::Mat read_visible_mask(const fs::path& file) {
  const cv::Mat stored = read_gray(file);
  return stored == 255;
}

void require_size(const fs::path& file, const cv::Mat& map, cv::Size image,
                  const std::string& advice) {
  if (map.size() == image) return;
  throw UserError(file, "is " + size_text(map.cols, map.rows) + ", the left image " +
                            size_text(image.width, image.height) + advice);
}

}  // namespace mtstereo::eval
