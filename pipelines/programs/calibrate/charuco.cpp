// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/charuco.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/aruco.hpp>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::calibrate {
namespace {

struct NamedDictionary {
  const char* name;
  int number;
};
constexpr std::array kDictionaries{
    NamedDictionary{"4x4_50", cv::aruco::DICT_4X4_50},
    NamedDictionary{"4x4_100", cv::aruco::DICT_4X4_100},
    NamedDictionary{"4x4_250", cv::aruco::DICT_4X4_250},
    NamedDictionary{"4x4_1000", cv::aruco::DICT_4X4_1000},
    NamedDictionary{"5x5_50", cv::aruco::DICT_5X5_50},
    NamedDictionary{"5x5_100", cv::aruco::DICT_5X5_100},
    NamedDictionary{"5x5_250", cv::aruco::DICT_5X5_250},
    NamedDictionary{"5x5_1000", cv::aruco::DICT_5X5_1000},
    NamedDictionary{"6x6_50", cv::aruco::DICT_6X6_50},
    NamedDictionary{"6x6_100", cv::aruco::DICT_6X6_100},
    NamedDictionary{"6x6_250", cv::aruco::DICT_6X6_250},
    NamedDictionary{"6x6_1000", cv::aruco::DICT_6X6_1000},
    NamedDictionary{"7x7_50", cv::aruco::DICT_7X7_50},
    NamedDictionary{"7x7_100", cv::aruco::DICT_7X7_100},
    NamedDictionary{"7x7_250", cv::aruco::DICT_7X7_250},
    NamedDictionary{"7x7_1000", cv::aruco::DICT_7X7_1000},
    NamedDictionary{"original", cv::aruco::DICT_ARUCO_ORIGINAL},
};

cv::Ptr<cv::aruco::Dictionary> dictionary_of(const std::string& name) {
  for (const NamedDictionary& each : kDictionaries) {
    if (name == each.name) return cv::aruco::getPredefinedDictionary(each.number);
  }
  return nullptr;
}

cv::Ptr<cv::aruco::CharucoBoard> board_of(const BoardOptions& options) {
  const auto dictionary = dictionary_of(options.dictionary);
  if (!dictionary) throw UserError("no dictionary '" + options.dictionary + "'");
  return cv::aruco::CharucoBoard::create(options.columns, options.rows,
                                         static_cast<float>(options.square),
                                         static_cast<float>(options.marker_side()), dictionary);
}

// The rectangle between two opposite corners, in any order.
cv::Rect2d between(cv::Point2d a, cv::Point2d b) {
  return {cv::Point2d(std::min(a.x, b.x), std::min(a.y, b.y)),
          cv::Point2d(std::max(a.x, b.x), std::max(a.y, b.y))};
}

// The distance from each corner to the nearest other one [px].
double nearest_distance(const std::vector<cv::Point2f>& pixels, std::size_t index) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (i != index) nearest = std::min(nearest, cv::norm(pixels[i] - pixels[index]));
  }
  return nearest;
}

// Places the corners to a fraction of a pixel. OpenCV 4.6 has done so, but with an offset of half a
// pixel, and in windows that reach into the markers. Corners that are not where they seemed to be
// are removed.
void refine(const cv::Mat& gray, double marker_part, Corners& corners) {
  constexpr int kSmallestWindow = 2;
  constexpr int kLargestWindow = 10;
  constexpr float kSmallShift = 0.6F;  // of the window, in addition to OpenCV's half pixel
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3);
  Corners refined;
  refined.markers = corners.markers;
  for (std::size_t i = 0; i < corners.pixels.size(); ++i) {
    const double margin = (1 - marker_part) / 2 * nearest_distance(corners.pixels, i);
    const int window =
        static_cast<int>(std::clamp(0.9 * margin, 1.0 * kSmallestWindow, 1.0 * kLargestWindow));
    std::vector<cv::Point2f> pixel{corners.pixels[i]};
    cv::cornerSubPix(gray, pixel, {window, window}, {-1, -1}, until);
    const double shift = cv::norm(pixel.front() - corners.pixels[i]);
    if (shift > 1 + kSmallShift * static_cast<float>(window)) continue;
    refined.ids.push_back(corners.ids[i]);
    refined.pixels.push_back(pixel.front());
  }
  corners = std::move(refined);
}

}  // namespace

std::vector<std::string> dictionary_names() {
  std::vector<std::string> names;
  for (const NamedDictionary& each : kDictionaries) names.emplace_back(each.name);
  return names;
}

int dictionary_size(const std::string& name) {
  const auto dictionary = dictionary_of(name);
  return dictionary ? dictionary->bytesList.rows : 0;
}

std::vector<cv::Rect2d> marker_rectangles(const BoardOptions& options) {
  const auto board = board_of(options);
  const int cells = board->dictionary->markerSize + 2;  // with the black border
  std::vector<cv::Rect2d> result;
  for (std::size_t i = 0; i < board->ids.size(); ++i) {
    cv::Mat bits;
    cv::aruco::drawMarker(board->dictionary, board->ids[i], cells, bits, 1);
    const auto& outline = board->objPoints[i];  // upper left, upper right, lower right, lower left
    const cv::Point2d origin(outline[0].x, outline[0].y);
    const cv::Point2d across = (cv::Point2d(outline[1].x, outline[1].y) - origin) * (1.0 / cells);
    const cv::Point2d down = (cv::Point2d(outline[3].x, outline[3].y) - origin) * (1.0 / cells);
    for (int y = 0; y < cells; ++y) {
      for (int begin = 0; begin < cells; ++begin) {
        if (bits.at<std::uint8_t>(y, begin) != 0) continue;
        int end = begin + 1;
        while (end < cells && bits.at<std::uint8_t>(y, end) == 0) ++end;
        result.push_back(
            between(origin + begin * across + y * down, origin + end * across + (y + 1) * down));
        begin = end;
      }
    }
  }
  return result;
}

struct CharucoFinder::State {
  cv::Ptr<cv::aruco::CharucoBoard> board;
  cv::Ptr<cv::aruco::DetectorParameters> parameters;
  double marker_part;  // of the side of a square
};

CharucoFinder::CharucoFinder(const BoardOptions& options)
    : state_(
          std::make_unique<State>(State{board_of(options), cv::aruco::DetectorParameters::create(),
                                        options.marker_side() / options.square})) {}
CharucoFinder::~CharucoFinder() = default;
CharucoFinder::CharucoFinder(CharucoFinder&&) noexcept = default;
CharucoFinder& CharucoFinder::operator=(CharucoFinder&&) noexcept = default;

Corners CharucoFinder::find(const cv::Mat& gray) const {
  Corners result;
  std::vector<std::vector<cv::Point2f>> markers, rejected;
  std::vector<int> ids;
  cv::aruco::detectMarkers(gray, state_->board->dictionary, markers, ids, state_->parameters,
                           rejected);
  if (ids.empty()) return result;
  cv::aruco::refineDetectedMarkers(gray, state_->board, markers, ids, rejected);
  result.markers = static_cast<int>(ids.size());
  cv::Mat pixels, numbers;
  cv::aruco::interpolateCornersCharuco(markers, ids, gray, state_->board, pixels, numbers);
  for (int i = 0; i < numbers.rows; ++i) {
    result.ids.push_back(numbers.at<int>(i));
    result.pixels.push_back(pixels.at<cv::Point2f>(i));
  }
  refine(gray, state_->marker_part, result);
  return result;
}

}  // namespace mtstereo::calibrate
