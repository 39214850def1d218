// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/degrade.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "eval/h264.hpp"
#include "eval/input_error.hpp"

namespace mtstereo::eval {
namespace {

/// The name of a kind and the range of its amount.
struct KindInfo {
  DegradationKind kind;
  std::string_view name;
  double least;
  double most;
  bool whole = false;  // the amount is a whole number
};

constexpr std::array kKinds = {
    KindInfo{DegradationKind::kNoise, "noise", 0, 100},
    KindInfo{DegradationKind::kJpeg, "jpeg", 1, 100, true},
    KindInfo{DegradationKind::kH264, "h264", 1, 50, true},
    KindInfo{DegradationKind::kDark, "dark", 0, 1},
    KindInfo{DegradationKind::kBright, "bright", 1, 16},
    KindInfo{DegradationKind::kBlurRight, "blur-right", 0, 10},
    KindInfo{DegradationKind::kLowerRight, "lower-right", -100, 100},
    KindInfo{DegradationKind::kRollRight, "roll-right", -45, 45},
    KindInfo{DegradationKind::kGainRight, "gain-right", 0, 16},
    KindInfo{DegradationKind::kGammaRight, "gamma-right", 0.1, 10},
};

constexpr double kDarkNoise = 2;  // [gray values]

const KindInfo& info_of(DegradationKind kind) {
  for (const KindInfo& info : kKinds) {
    if (info.kind == kind) return info;
  }
  throw InputError("unknown kind of degradation");
}

std::string kind_list() {
  std::string list;
  for (const KindInfo& info : kKinds) {
    if (!list.empty()) list += ", ";
    list += info.name;
  }
  return list;
}

std::string number_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string range_text(const KindInfo& info) {
  return std::string(info.name) + "=" + number_text(info.least) + " .. " + number_text(info.most);
}

void compress(double quality, cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, static_cast<int>(quality)});
  image = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
}

void scale(double factor, cv::Mat& image) {
  cv::Mat scaled;
  image.convertTo(scaled, -1, factor);
  image = scaled;
}

void blur(double sigma, cv::Mat& image) {
  if (sigma <= 0) return;
  cv::Mat blurred;
  cv::GaussianBlur(image, blurred, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
  image = blurred;
}

void warp(const cv::Matx23d& to_source, cv::Mat& image) {
  cv::Mat warped;
  cv::warpAffine(image, warped, to_source, image.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  image = warped;
}

void roll(double degrees, cv::Mat& image) {
  const cv::Point2f center((image.cols - 1) / 2.0F, (image.rows - 1) / 2.0F);
  // getRotationMatrix2D() turns counterclockwise; as a map to the source it turns clockwise.
  const cv::Mat to_source = cv::getRotationMatrix2D(center, degrees, 1);
  warp(cv::Matx23d(to_source), image);
}

void apply_gamma(double exponent, cv::Mat& image) {
  cv::Mat table(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i) {
    table.at<std::uint8_t>(i) =
        cv::saturate_cast<std::uint8_t>(255 * std::pow(i / 255.0, exponent));
  }
  cv::Mat mapped;
  cv::LUT(image, table, mapped);
  image = mapped;
}

}  // namespace

std::string degradation_kinds() {
  std::string list;
  for (const KindInfo& info : kKinds) {
    if (!list.empty()) list += ", ";
    list += range_text(info);
  }
  return list;
}

Degradation parse_degradation(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  for (const KindInfo& info : kKinds) {
    if (info.name != name) continue;
    const std::string range = range_text(info);
    if (equals == std::string_view::npos) {
      throw InputError("degradation '" + std::string(text) + "' has no amount; use " + range);
    }
    const std::string_view amount_text = text.substr(equals + 1);
    double amount = 0;
    const char* end = amount_text.data() + amount_text.size();
    const auto [stop, error] = std::from_chars(amount_text.data(), end, amount);
    if (error != std::errc() || stop != end || !(amount >= info.least && amount <= info.most)) {
      throw InputError("degradation '" + std::string(text) + "' is out of range; use " + range);
    }
    if (info.whole && amount != std::floor(amount)) {
      throw InputError("degradation '" + std::string(text) + "' needs a whole number; use " +
                       range);
    }
    return {info.kind, amount};
  }
  throw InputError("unknown degradation '" + std::string(text) + "'; the kinds are " + kind_list());
}

std::optional<std::string> degradation_obstacle(const Degradation& degradation) {
  return degradation.kind == DegradationKind::kH264 ? h264_obstacle() : std::nullopt;
}

std::string degradation_text(const Degradation& degradation) {
  return std::string(info_of(degradation.kind).name) + "=" + number_text(degradation.amount);
}

void add_noise(double sigma, std::uint64_t seed, cv::Mat& image) {
  cv::Mat noise(image.size(), CV_32F);
  cv::RNG random(seed);
  random.fill(noise, cv::RNG::NORMAL, 0, sigma);
  cv::Mat noisy;
  cv::add(image, noise, noisy, cv::noArray(), CV_8U);
  image = noisy;
}

void degrade(const Degradation& degradation, cv::Mat& left, cv::Mat& right) {
  const double amount = degradation.amount;
  std::uint64_t seed = 1;
  for (cv::Mat* view : {&left, &right}) {
    switch (degradation.kind) {
      case DegradationKind::kNoise:
        add_noise(amount, seed++, *view);
        break;
      case DegradationKind::kJpeg:
        compress(amount, *view);
        break;
      case DegradationKind::kH264:
        *view = through_h264(*view, static_cast<int>(amount));
        break;
      case DegradationKind::kDark:
        scale(amount, *view);
        add_noise(kDarkNoise, seed++, *view);
        break;
      case DegradationKind::kBright:
        scale(amount, *view);
        break;
      default:
        break;
    }
  }
  switch (degradation.kind) {
    case DegradationKind::kBlurRight:
      return blur(amount, right);
    case DegradationKind::kLowerRight:
      return warp({1, 0, 0, 0, 1, -amount}, right);
    case DegradationKind::kRollRight:
      return roll(amount, right);
    case DegradationKind::kGainRight:
      return scale(amount, right);
    case DegradationKind::kGammaRight:
      return apply_gamma(amount, right);
    default:
      return;
  }
}

}  // namespace mtstereo::eval
