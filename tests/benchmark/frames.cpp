// SPDX-License-Identifier: LGPL-2.1-or-later
#include "frames.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <utility>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/datasets.hpp"
#include "tools/render/render.hpp"

namespace mtstereo::bench {
namespace {

constexpr const char* kRealPair = "000046_10";
constexpr int kRealDisparities = 100;

std::string frame_name(const std::string& what, cv::Size size, int disparities) {
  return what + "-" + std::to_string(size.width) + "x" + std::to_string(size.height) + "-" +
         std::to_string(disparities);
}

}  // namespace

Pair render_street(int width, int height, double time) {
  render::Settings settings;
  settings.width = width;
  settings.height = height;
  render::StereoFrame frame = render::render(render::make_scene("street", 1), time, settings);
  return {std::move(frame.left), std::move(frame.right)};
}

GrayView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

Frame::Frame(int width, int height, int disparities)
    : name_(frame_name("street", {width, height}, disparities)),
      disparities_(disparities),
      size_(width, height) {}

Frame::Frame(std::string name, int disparities, Pair images)
    : name_(std::move(name)),
      disparities_(disparities),
      size_(images.left.size()),
      images_(std::move(images)) {}

Frame Frame::kitti(const std::string& folder, const std::string& name, int disparities) {
  const eval::DataSet set = eval::find_pairs(folder, eval::Layout::kKitti2015);
  const auto pair = std::find_if(set.pairs.begin(), set.pairs.end(), [&](const auto& candidate) {
    return std::filesystem::path(candidate.name).filename() == name;
  });
  if (pair == set.pairs.end()) throw mtstereo::UserError(folder, "has no pair " + name);
  eval::LoadedPair loaded = eval::load_pair(*pair);
  const std::string full_name = frame_name("kitti", loaded.left.size(), disparities);
  return {full_name, disparities, {std::move(loaded.left), std::move(loaded.right)}};
}

const Pair& Frame::images() const {
  if (images_.left.empty()) images_ = render_street(size_.width, size_.height);
  return images_;
}

std::vector<FramePointer> frames(bool quick, const char* data) {
  if (quick) return {std::make_shared<Frame>(640, 480, 64)};
  std::vector<FramePointer> all = {
      std::make_shared<Frame>(1242, 375, 100),  std::make_shared<Frame>(1242, 375, 192),
      std::make_shared<Frame>(640, 480, 64),    std::make_shared<Frame>(1280, 720, 128),
      std::make_shared<Frame>(1920, 1080, 128),
  };
  if (data == nullptr || *data == '\0') {
    std::cerr << "MTSTEREO_TEST_DATA is not set: rendered pairs only\n";
    return all;
  }
  try {
    const std::string folder = (std::filesystem::path(data) / "kitti2015").string();
    all.insert(all.begin(),
               std::make_shared<Frame>(Frame::kitti(folder, kRealPair, kRealDisparities)));
  } catch (const mtstereo::UserError& error) {
    std::cerr << "MTSTEREO_TEST_DATA: " << error.what() << ": rendered pairs only\n";
  }
  return all;
}

FramePointer main_frame(const std::vector<FramePointer>& all) { return all.front(); }

}  // namespace mtstereo::bench
