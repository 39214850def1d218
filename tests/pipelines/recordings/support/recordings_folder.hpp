// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <initializer_list>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/recognition.hpp"
#include "recordings/support/video_files.hpp"
#include "support/error_of.hpp"

// For the tests of what is recognized in a folder.

namespace mtstereo::run::testing {

inline constexpr int kWidth = 200, kHeight = 120, kDisparity = 12;  // [px]

/// The views of a plane with a texture.
inline cv::Mat view(bool right) {
  cv::Mat noise(kHeight, kWidth + kDisparity, CV_8UC1), smooth;
  cv::RNG random(7);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, smooth, {5, 5}, 1.2);
  return smooth(cv::Rect(right ? kDisparity : 0, 0, kWidth, kHeight)).clone();
}

/// A folder for recordings.
class Recordings : public ::testing::Test {
 protected:
  void write_images(const std::string& folder, std::initializer_list<const char*> names,
                    bool right = false) const {
    for (const char* name : names) {
      const std::filesystem::path file = folder_ / (folder + "/" + name);
      ASSERT_TRUE(cv::imwrite(file.string(), view(right))) << file;
    }
  }

  // A pair of images or folders is recognized by this path in the folder of the test.
  Recording recognized(std::initializer_list<const char*> inputs,
                       const InputOptions& options = {}) const {
    std::vector<std::string> paths;
    for (const char* input : inputs) paths.push_back((folder_.path() / input).string());
    return recognize(paths, options);
  }

  std::string error_of(std::initializer_list<const char*> inputs,
                       const InputOptions& options = {}) const {
    return test::error_of<UserError>([&] { recognized(inputs, options); });
  }

  std::vector<Recording> found(std::vector<Problem>& problems) const {
    return find_recordings(folder_.path(), {}, problems);
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
};

/// The names of files without their folders.
inline std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) names.push_back(file.filename().string());
  return names;
}

}  // namespace mtstereo::run::testing
