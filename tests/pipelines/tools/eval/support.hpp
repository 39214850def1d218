// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace mtstereo::eval::testing {

using test::TemporaryFolder;

/// Writes text or bytes and creates the folders of the path.
void write_file(const std::filesystem::path& file, const std::string& bytes);
std::string read_file(const std::filesystem::path& file);

/// Writes an image in the format of its extension and creates the folders of the path.
void write_image(const std::filesystem::path& file, const cv::Mat& image);

/// The values as the bytes of consecutive 32-bit floats.
std::string float_bytes(const std::vector<float>& values, bool big_endian);

/// A synthetic pair: a texture of random patches, shifted by a constant disparity.
struct TestPair {
  cv::Mat left;   ///< CV_8UC1
  cv::Mat right;  ///< CV_8UC1
  cv::Mat truth;  ///< CV_32FC1 [px], infinity where the point is outside the right image
};
TestPair make_pair(int width, int height, int disparity);

/// Writes a pair as a Middlebury folder with im0.png, im1.png, disp0GT.pfm and, if `ndisp` is not
/// 0, calib.txt.
void write_pair_folder(const std::filesystem::path& folder, const TestPair& pair, int ndisp);

/// A set of two pairs in Middlebury's layout, A and B.
class TwoPairs : public ::testing::Test {
 protected:
  void SetUp() override {
    write_pair_folder(folder_ / "set/A", make_pair(240, 120, 9), 32);
    write_pair_folder(folder_ / "set/B", make_pair(200, 100, 5), 16);
  }
  std::string set() const { return folder_ / "set"; }
  nlohmann::json report() const { return nlohmann::json::parse(read_file(folder_ / "r.json")); }
  TemporaryFolder folder_;
};

/// Writes CV_32FC1 ground truth as KITTI's 16-bit PNG; values that are not finite become 0.
void write_kitti_truth(const std::filesystem::path& file, const cv::Mat& truth);

/// The result of a program that ended.
struct Outcome {
  int status = -1;  ///< exit status; -1 if a signal ended the program
  std::string out, err;
};

/// Runs a program in the environment of the test, with these variables, "NAME=VALUE", added.
Outcome run_program(const std::string& program, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment = {});

/// Runs mtstereo-eval, whose path is in the environment variable MTSTEREO_EVAL.
Outcome run_eval(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment = {});

/// Runs plot.py, whose path is in the environment variable MTSTEREO_PLOT.
Outcome run_plot(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment = {});

/// The environment variable that hides matplotlib from Python. Writes a module to this folder whose
/// import fails like that of a missing one.
std::string without_matplotlib(const std::filesystem::path& folder);

}  // namespace mtstereo::eval::testing
