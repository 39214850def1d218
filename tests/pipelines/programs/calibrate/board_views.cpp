// SPDX-License-Identifier: LGPL-2.1-or-later

// board-views: writes images of a board in front of two ideal cameras, as left/%03d.png and
// right/%03d.png.
//
// usage: board-views FOLDER POSES        the board at rest at this number of poses
//        board-views FOLDER POSES DELAY  a film of 30 frames per second: the board rests at each
//                                        pose for 3 frames and moves to the next one within 7. The
//                                        right camera exposes DELAY ms later.

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "programs/calibrate/board.hpp"
#include "programs/calibrate/lens.hpp"

namespace {

using namespace mtstereo::calibrate;

constexpr int kWidth = 384;
constexpr int kHeight = 288;
constexpr double kFocal = 336;
constexpr int kScale = 32;  // pixels of the printed board per square
constexpr double kRate = 30;
constexpr int kRest = 3;
constexpr int kMove = 7;

struct Place {
  Eigen::Vector3d turn;    // rotation vector
  Eigen::Vector3d center;  // of the board, in the left camera's coordinates [m]
};

std::vector<Place> places(int count) {
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967295.0);
  };
  std::vector<Place> result;
  for (int i = 0; i < count; ++i) {
    const double depth = uniform(0.35, 0.65);
    const double x = uniform(-0.35, 0.4) * kWidth / kFocal * depth;
    const double y = uniform(-0.35, 0.35) * kHeight / kFocal * depth;
    result.push_back({{uniform(-0.6, 0.6), uniform(-0.6, 0.6), uniform(-0.3, 0.3)}, {x, y, depth}});
  }
  return result;
}

// The place of the board at a time, in frames.
Place place_at(const std::vector<Place>& all, double frame) {
  const double position = std::max(0.0, frame) / (kRest + kMove);
  const auto index = std::min(all.size() - 1, static_cast<std::size_t>(position));
  const double rest = static_cast<double>(kRest) / (kRest + kMove);
  const double part = std::max(0.0, (position - static_cast<double>(index) - rest) / (1 - rest));
  const double blend = (1 - std::cos(M_PI * std::min(1.0, part))) / 2;
  const Place& next = all[std::min(all.size() - 1, index + 1)];
  return {all[index].turn + blend * (next.turn - all[index].turn),
          all[index].center + blend * (next.center - all[index].center)};
}

cv::Mat see(const cv::Mat& print, const BoardOptions& board, const Place& place, double camera_x,
            std::mt19937& random) {
  Eigen::Matrix<double, 6, 1> step;
  step << place.turn, Eigen::Vector3d::Zero();
  const Pose turned = Pose().moved(step);
  const double meters = board.square / kScale;
  // From a pixel of the print to the image.
  Eigen::Matrix3d plane;
  plane.col(0) = turned.rotation.col(0) * meters;
  plane.col(1) = turned.rotation.col(1) * meters;
  plane.col(2) = place.center - Eigen::Vector3d(camera_x, 0, 0) -
                 plane.col(0) * (print.cols - 1) / 2.0 - plane.col(1) * (print.rows - 1) / 2.0;
  Eigen::Matrix3d camera;
  camera << kFocal, 0, (kWidth - 1) / 2.0, 0, kFocal, (kHeight - 1) / 2.0, 0, 0, 1;
  const Eigen::Matrix3d homography = camera * plane;
  cv::Matx33d map;
  for (int i = 0; i < 9; ++i) map(i / 3, i % 3) = homography(i / 3, i % 3);
  cv::Mat image;
  const cv::Matx33d twice(2, 0, 0.5, 0, 2, 0.5, 0, 0, 1);
  cv::warpPerspective(print, image, twice * map, {2 * kWidth, 2 * kHeight}, cv::INTER_LINEAR,
                      cv::BORDER_CONSTANT, cv::Scalar(110));
  cv::resize(image, image, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(image, image, {}, 0.5);
  cv::Mat noise(image.size(), CV_16SC1), sum;
  cv::theRNG().state = random();
  cv::randn(noise, 0, 2);
  image.convertTo(sum, CV_16S, 0.8, 20);
  sum += noise;
  sum.convertTo(image, CV_8U);
  return image;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::cerr << "usage: board-views FOLDER POSES [DELAY]\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const BoardOptions board;
  const cv::Mat print = board_image(board, kScale);
  const std::vector<Place> all = places(std::atoi(argv[2]));
  const bool film = argc == 4;
  const double delay = film ? std::atof(argv[3]) / 1000 * kRate : 0;
  const int step = film ? 1 : kRest + kMove;
  std::mt19937 random(1);
  std::filesystem::create_directories(folder / "left");
  std::filesystem::create_directories(folder / "right");
  for (int frame = 0, i = 0; frame < static_cast<int>(all.size()) * (kRest + kMove);
       frame += step, ++i) {
    char name[16];
    std::snprintf(name, sizeof name, "%03d.png", i);
    cv::imwrite((folder / "left" / name).string(),
                see(print, board, place_at(all, frame), 0, random));
    cv::imwrite((folder / "right" / name).string(),
                see(print, board, place_at(all, frame + delay), 0.1, random));
  }
  return 0;
}
