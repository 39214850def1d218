// SPDX-License-Identifier: LGPL-2.1-or-later
// The readers of mtstereo-eval. The first byte selects the reader, the rest is the file. A file
// that cannot be used must give an UserError and nothing else.

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "fuzz_folder.hpp"
#include "fuzz_input.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/datasets.hpp"
#include "tools/eval/files.hpp"
#include "tools/eval/ground_truth.hpp"
#include "tools/eval/pfm.hpp"

namespace mtstereo::fuzz {
namespace {
namespace fs = std::filesystem;

/// A PNG whose header is valid; its size is limited, since OpenCV allocates the size in the header.
std::string png_of(FuzzInput& input) {
  std::string bytes(input.rest());
  const std::string signature = "\x89PNG\r\n\x1a\n";
  if (bytes.size() < 24 || bytes.compare(0, signature.size(), signature) != 0) return {};
  for (const std::size_t at : {16U, 17U, 20U, 21U}) bytes[at] = 0;
  return bytes;
}

void check_disparity(const cv::Mat& map) {
  require(map.type() == CV_32FC1 && !map.empty(), "a map has one channel and pixels");
  for (const float value : cv::Mat_<float>(map)) {
    require(std::isnan(value) || (std::isfinite(value) && value >= 0),
            "a known disparity is a number and not negative");
  }
}

void read_pfm(FuzzInput& input) {
  const fs::path file = folder().write("map.pfm", input.rest());
  const cv::Mat values = eval::read_pfm(file);
  eval::write_pfm(file, values);
  const cv::Mat again = eval::read_pfm(file);
  require(again.size() == values.size(), "a map has its size after it was written and read");
  require(std::memcmp(again.data, values.data, values.total() * sizeof(float)) == 0,
          "a map is equal after it was written and read");
  check_disparity(eval::read_pfm_disparity(file));
}

void read_png(FuzzInput& input) {
  check_disparity(eval::read_png_disparity(folder().write("map.png", png_of(input))));
}

void read_gray(FuzzInput& input) {
  const fs::path file = folder().write("view.png", png_of(input));
  const cv::Mat image = eval::read_gray(file);
  require(image.type() == CV_8UC1 && !image.empty(), "an image is gray and has pixels");
  for (const std::uint8_t value : cv::Mat_<std::uint8_t>(eval::read_visible_mask(file))) {
    require(value == 0 || value == 255, "a mask has two values");
  }
}

void read_dmap(FuzzInput& input) {
  const cv::Size size(input.between(1, 12), input.between(1, 12));
  const fs::path file = folder().write("x_dmap.bin", input.rest());
  const cv::Mat depth = eval::read_dmap(file, size);
  check_disparity(depth);
  const eval::Camera left{500, 100, {0, 0, 0}};
  const eval::Camera right{500, 101, {0.1, 0, 0}};
  for (const float value : cv::Mat_<float>(eval::depth_to_disparity(depth, left, right))) {
    require(std::isnan(value) || value >= 0, "a disparity of a depth is not negative");
  }
}

void read_camera(FuzzInput& input) {
  const eval::Camera camera = eval::read_camera(folder().write("x_cam.txt", input.rest()));
  require(camera.focal_length > 0, "a focal length is positive");
}

/// A folder of Middlebury with this calib.txt.
void read_calibration(FuzzInput& input) {
  const fs::path pair = folder().path() / "pairs" / "chair_1l";
  fs::create_directories(pair);
  for (const char* name : {"im0.png", "im1.png", "disp0GT.pfm"}) eval::write_bytes(pair / name, "");
  const bool eth3d = input.flag();
  eval::write_bytes(pair / "calib.txt", std::string(input.rest()));
  const fs::path root = folder().path() / "pairs";
  const eval::DataSet set =
      eval::find_pairs(root, eth3d ? eval::Layout::kEth3d : eval::Layout::kMiddlebury);
  require(set.pairs.size() + set.problems.size() == 1, "a pair is found, or a problem");
  for (const eval::StereoPair& found : set.pairs) {
    require(!found.max_disparity || *found.max_disparity > 0, "a search range is positive");
  }
}

}  // namespace
}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  mtstereo::fuzz::folder();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mtstereo::fuzz;
  constexpr std::array kReaders = {read_pfm,  read_png,    read_gray,
                                   read_dmap, read_camera, read_calibration};
  FuzzInput input(data, size);
  try {
    input.one_of(kReaders)(input);
  } catch (const mtstereo::UserError& error) {
    require(error.what()[0] != '\0', "an error has a message");
  }
  return 0;
}
