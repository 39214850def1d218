// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace mtstereo::eval::testing {

/// A folder of its own for a test, removed with all that is in it when the test ends.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Writes text or bytes, making the folders above.
void write_file(const std::filesystem::path& file, const std::string& bytes);
std::string read_file(const std::filesystem::path& file);

/// Writes an image in the format of its extension, making the folders above.
void write_image(const std::filesystem::path& file, const cv::Mat& image);

/// The values as the bytes of 32-bit floats, one after the other.
std::string float_bytes(const std::vector<float>& values, bool big_endian);

/// A rendered pair: a texture of random patches, shifted by a constant disparity.
struct TestPair {
  cv::Mat left;   ///< CV_8UC1
  cv::Mat right;  ///< CV_8UC1
  cv::Mat truth;  ///< CV_32FC1 [px], infinity where the right image does not show the point
};
TestPair make_pair(int width, int height, int disparity);

/// Writes a pair as a Middlebury folder with im0.png, im1.png, disp0GT.pfm and, unless `ndisp` is
/// 0, calib.txt.
void write_pair_folder(const std::filesystem::path& folder, const TestPair& pair, int ndisp);

/// CV_32FC1 truth as KITTI's 16-bit PNG; what is not finite becomes 0.
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

/// The environment variable that hides matplotlib from Python. Makes a module in this folder that
/// fails like a missing one.
std::string without_matplotlib(const std::filesystem::path& folder);

}  // namespace mtstereo::eval::testing
