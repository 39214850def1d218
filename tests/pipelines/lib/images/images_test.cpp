// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/images/images.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <thread>
#include <vector>

#include "lib/images/open_module.hpp"
#include "lib/outputs/user_error.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::images::images_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

cv::Mat sample() {
  cv::Mat image(3, 5, CV_16UC1);
  for (int i = 0; i < 15; ++i) image.at<std::uint16_t>(i / 5, i % 5) = 1000 * i;
  return image;
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

fs::path written(const test::TemporaryFolder& folder, const std::string& bytes) {
  std::ofstream(folder / "file", std::ios::binary) << bytes;
  return folder / "file";
}

// The first images of a program come from several threads. It is the first test of this program.
TEST(Images, AreFirstUsedBySeveralThreads) {
  std::atomic<int> good = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&good] { good += encode(".png", sample()).empty() ? 0 : 1; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(4, good);
}

TEST(Images, ReadWhatTheyWrite) {
  const test::TemporaryFolder folder;
  const std::string bytes = encode(".png", sample());
  EXPECT_TRUE(equal(sample(), decode(bytes, cv::IMREAD_UNCHANGED)));
  EXPECT_TRUE(equal(sample(), read(written(folder, bytes), cv::IMREAD_UNCHANGED)));
  EXPECT_EQ(CV_8UC1, read(folder / "file", cv::IMREAD_GRAYSCALE).type());
}

TEST(Images, AreEncodedWithOptions) {
  const cv::Mat image(64, 64, CV_8UC1, cv::Scalar(7));
  EXPECT_LT(encode(".png", image, {cv::IMWRITE_PNG_COMPRESSION, 9}).size(),
            encode(".png", image, {cv::IMWRITE_PNG_COMPRESSION, 0}).size());
}

TEST(Images, AreEmptyWithoutAnImage) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(read(folder / "nothing", cv::IMREAD_UNCHANGED).empty());
  EXPECT_TRUE(read(folder.path(), cv::IMREAD_UNCHANGED).empty());
  EXPECT_TRUE(read(written(folder, ""), cv::IMREAD_UNCHANGED).empty());
  EXPECT_TRUE(read(written(folder, "no image"), cv::IMREAD_UNCHANGED).empty());
  EXPECT_TRUE(decode("no image", cv::IMREAD_UNCHANGED).empty());
}

TEST(Images, AreEmptyIfOpenCvRefusesTheirSize) {
  const test::TemporaryFolder folder;
  const fs::path file = written(folder, "P5\n60000 60000\n255\n");
  EXPECT_TRUE(read(file, cv::IMREAD_UNCHANGED).empty());
}

TEST(Images, ReportWhatOpenCvRefuses) {
  EXPECT_THROW(encode(".unknown", sample()), cv::Exception);
  EXPECT_THROW(encode(".png", {}), cv::Exception);
}

std::string error_of(const std::string& module) {
  return test::error_of<UserError>([&] { open_module(module); });
}

TEST(ImageModule, IsNamedWithTheRemedyIfItIsMissing) {
  const std::string error = error_of("libmtstereo-nothing.so");
  EXPECT_THAT(error, HasSubstr("libmtstereo-nothing.so: cannot open"));
  EXPECT_THAT(error, HasSubstr("install mtstereo again"));
}

TEST(ImageModule, IsNamedIfItIsAnotherFile) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(error_of(written(folder, "no library").string()), HasSubstr("file: file too short"));
  EXPECT_THAT(error_of("libc.so.6"), HasSubstr("undefined symbol"));
}

}  // namespace
}  // namespace mtstereo::images::images_test
