// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "lib/outputs/user_error.hpp"
#include "programs/calibrate/source.hpp"
#include "support/exif.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::calibrate::image_source_test {
namespace {

// A pair of such images as the program reads them.
ImagePair read_pair(const cv::Mat& left, const cv::Mat& right) {
  const test::TemporaryFolder folder;
  SourceOptions options;
  options.left = folder / "left.png";
  options.right = folder / "right.png";
  cv::imwrite(options.left, left);
  cv::imwrite(options.right, right);
  ImagePair pair;
  EXPECT_EQ(open_source(options)->next(pair), SourceState::kPair);
  return pair;
}

TEST(ImageSource, UsesAllBitsOfCamerasWith12) {
  const cv::Mat left = (cv::Mat_<std::uint16_t>(1, 3) << 0, 2048, 4095);
  const cv::Mat right = (cv::Mat_<std::uint16_t>(1, 3) << 0, 32768, 65535);
  const ImagePair pair = read_pair(left, right);
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(1, 3) << 0, 128, 255);
  EXPECT_EQ(cv::norm(pair.left, expected, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(pair.right, expected, cv::NORM_INF), 0);
}

TEST(ImageSource, StretchesTheNarrowRangeOfCamerasOfHeat) {
  const cv::Mat thermal = (cv::Mat_<std::uint16_t>(1, 3) << 29000, 29400, 30000);
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(1, 3) << 0, 102, 255);
  EXPECT_EQ(cv::norm(read_pair(thermal, thermal).left, expected, cv::NORM_INF), 0);
}

TEST(ImageSource, KeepsImagesOf8BitsAndBlackOnes) {
  const cv::Mat gray = (cv::Mat_<std::uint8_t>(1, 3) << 0, 20, 90);
  const ImagePair pair = read_pair(gray, cv::Mat(1, 3, CV_16UC1, cv::Scalar(0)));
  EXPECT_EQ(cv::norm(pair.left, gray, cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(pair.right), 0);
}

// Empty images with these numbers in their names.
void write_numbered(const std::string& folder, std::initializer_list<int> numbers) {
  std::filesystem::create_directory(folder);
  for (const int number : numbers) std::ofstream(folder + "/" + std::to_string(number) + ".png");
}

TEST(ImageSource, RefusesListsOfOneLengthThatMissDifferentImages) {
  const test::TemporaryFolder folder;
  SourceOptions options;
  options.left = folder / "left";
  options.right = folder / "right";
  write_numbered(options.left, {1, 2, 4, 5, 6, 10});
  write_numbered(options.right, {1, 2, 3, 4, 5, 10});
  EXPECT_THAT([&options] { open_source(options); },
              ::testing::ThrowsMessage<UserError>(::testing::AllOf(
                  ::testing::HasSubstr("left/6.png and "), ::testing::HasSubstr("right/3.png"),
                  ::testing::HasSubstr("no partner with their number"))));
}

TEST(ImageSource, TakesNumbersThatAreNotThoseOfPairs) {
  const test::TemporaryFolder folder;
  SourceOptions options;
  options.left = folder / "left";
  options.right = folder / "right";
  write_numbered(options.left, {100, 203, 305, 400});  // such as times
  write_numbered(options.right, {101, 203, 306, 402});
  EXPECT_NO_THROW(open_source(options));
}

TEST(ImageSource, TakesTimesThatDifferByASecondNowAndThen) {
  const test::TemporaryFolder folder;
  SourceOptions options;
  options.left = folder / "left";
  options.right = folder / "right";
  write_numbered(options.left, {92610, 92615, 92619, 92630});
  write_numbered(options.right, {92610, 92616, 92619, 92630});
  EXPECT_NO_THROW(open_source(options));
}

TEST(ImageSource, RefusesImagesOfFloats) {
  const test::TemporaryFolder folder;
  SourceOptions options;
  options.left = options.right = folder / "a.tiff";
  cv::imwrite(options.left, cv::Mat(2, 3, CV_32FC1, cv::Scalar(0.5)));
  ImagePair pair;
  EXPECT_THAT(
      [&] { open_source(options)->next(pair); },
      ::testing::ThrowsMessage<UserError>(::testing::HasSubstr("a.tiff: has no values of 8")));
}

// The pixels of a phone that was turned between two photos are at the same places of its sensor.
TEST(ImageSource, ReadsLaterImagesAsTheyAreStored) {
  const test::TemporaryFolder folder;
  cv::Mat image(8, 16, CV_8UC1, cv::Scalar(0));
  image.colRange(8, 16).setTo(200);
  std::vector<unsigned char> coded;
  cv::imencode(".jpg", image, coded);
  for (const char orientation : {'\1', '\3'}) {
    std::ofstream(folder / (std::to_string(orientation) + ".jpg"))
        << test::with_orientation({coded.begin(), coded.end()}, orientation);
  }
  SourceOptions options;
  options.left = options.right = folder.path();
  const auto source = open_source(options);
  ImagePair first, second;
  EXPECT_EQ(source->next(first), SourceState::kPair);
  EXPECT_EQ(source->next(second), SourceState::kPair);
  EXPECT_EQ(second.name, "3.jpg");
  EXPECT_EQ(cv::norm(first.left, second.left, cv::NORM_INF), 0);
}

TEST(ImageSource, RefusesImagesThatProgramsTurn) {
  const test::TemporaryFolder folder;
  SourceOptions options;
  options.left = options.right = folder / "a.jpg";
  std::vector<unsigned char> coded;
  const cv::Mat image = (cv::Mat_<std::uint8_t>(1, 3) << 0, 20, 90);
  cv::imencode(".jpg", image, coded);
  for (const char orientation : {'\1', '\3'}) {
    std::ofstream(options.left) << test::with_orientation({coded.begin(), coded.end()},
                                                          orientation);
    ImagePair pair;
    const auto source = open_source(options);
    if (orientation == '\1') {
      EXPECT_EQ(source->next(pair), SourceState::kPair);
    } else {
      EXPECT_THAT([&] { source->next(pair); },
                  ::testing::ThrowsMessage<UserError>(::testing::HasSubstr("-auto-orient")));
    }
  }
}

TEST(ImageSource, NamesTheRemedyForAGif) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "a.gif") << "GIF89a";
  SourceOptions options;
  options.left = options.right = folder / "a.gif";
  EXPECT_THAT([&options] { input_files(options); },
              ::testing::ThrowsMessage<UserError>(::testing::HasSubstr("a.gif: is a GIF")));
}

}  // namespace
}  // namespace mtstereo::calibrate::image_source_test
