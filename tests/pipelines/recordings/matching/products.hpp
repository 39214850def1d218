// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"

// A recording of two cameras with a calibration, its products, and how they are read.

namespace mtstereo::run {

inline constexpr int kFrames = 5;
inline constexpr std::size_t kPixels = std::size_t{testing::kStereoWidth} * testing::kStereoHeight;
inline const Progress kNoProgress;

class Products : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  static std::filesystem::path file(const std::string& name) { return *folder_ / name; }

  /// Makes the products of all pairs, and returns their folder.
  static std::filesystem::path make(const std::vector<Product>& products, MapFormat format);
  /// What the elements give: the frames downstream of the matcher, which are made once.
  static const std::vector<std::string>& expected(const std::string& downstream);
  static std::string depth() { return "mtdepth calibration=" + file("calib.txt").string(); }

 private:
  static testing::TemporaryFolder* folder_;
  static std::map<std::string, std::vector<std::string>> expected_;
};

/// All frames one after another.
std::string joined(const std::vector<std::string>& frames);
/// The frames of a video by GStreamer.
std::string by_gstreamer(const std::filesystem::path& video, const std::string& format = "");
/// The values of a little-endian file, the first row on top.
std::vector<float> read_pfm(const std::filesystem::path& file);

}  // namespace mtstereo::run
