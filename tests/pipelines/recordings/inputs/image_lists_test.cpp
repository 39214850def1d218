// SPDX-License-Identifier: LGPL-2.1-or-later
// Which images are frames, and which frames are pairs.
#include "recordings/inputs/image_lists.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "recordings/inputs/image_sizes.hpp"
#include "recordings/inputs/name_times.hpp"
#include "recordings/support/recordings_folder.hpp"

namespace mtstereo::run::image_lists_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::names_of;
using testing::Recordings;
using ::testing::SizeIs;
using testing::view;
using testing::write_beginning;
using testing::write_text;

// Images are pairs by their numbers, also where some are missing or broken.
TEST_F(Recordings, ImagesWithTheSameNumberHaveTheSameTime) {
  write_images("left", {"a_0010.png", "a_0011.png", "a_0012.png", "a_0014.png"});
  write_images("right", {"b_10.png", "b_12.png", "b_13.png", "b_14.png"}, true);
  write_beginning(path("right/b_14.png"), path("right/b_15.png"), 0.5);
  write_text(folder_ / "left/a_0015.png", "");
  InputOptions options;
  options.frame_rate = 10;
  const Recording recording = recognized({"left", "right"}, options);
  const Nanoseconds step = 100'000'000;
  EXPECT_THAT(recording.left.times, ElementsAre(0, step, 2 * step, 4 * step));
  EXPECT_THAT(recording.right.times, ElementsAre(0, 2 * step, 3 * step, 4 * step));
  EXPECT_THAT(recording.left.images, SizeIs(4));
  EXPECT_THAT(recording.remarks,
              Contains(path("right/b_15.png") + " is left out: it is truncated."));
  EXPECT_THAT(recording.remarks, Contains(HasSubstr(path("left/a_0015.png"))));
  EXPECT_EQ(recording.left.damage, "1 of 5 images is left out");
  EXPECT_EQ(recording.right.damage, "1 of 5 images is left out");
}

TEST_F(Recordings, EachTenthImageIsAFrame) {
  write_images("left", {"000.png", "010.png", "020.png"});
  write_images("right", {"000.png", "010.png", "020.png"}, true);
  const Recording recording = recognized({"left", "right"});
  EXPECT_THAT(recording.left.times, IsEmpty());
  EXPECT_EQ(recording.frame_rate, 30);
}

TEST_F(Recordings, NamesThatAreTimes) {
  write_images("cam0", {"1403636579763555584.png", "1403636579813555456.png"});
  write_images("cam1", {"1403636579763555999.png", "1403636579813555456.png"}, true);
  const Recording recording = recognized({"cam0", "cam1"});
  EXPECT_THAT(recording.left.times, ElementsAre(0, 49'999'872));
  EXPECT_THAT(recording.right.times, ElementsAre(415, 49'999'872));
}

TEST_F(Recordings, NamesThatAreDates) {
  write_images("left", {"2026-11-26_09-59-59.900000.png", "2026-11-26_10-00-00.100000.png",
                        "2026-11-26_10-00-00.300000.png"});
  write_images("right", {"cam_20261126T095959_901.png", "cam_20261126T100000301.png"}, true);
  const Recording recording = recognized({"left", "right"});
  EXPECT_THAT(recording.left.times, ElementsAre(0, 200'000'000, 400'000'000));
  EXPECT_THAT(recording.right.times, ElementsAre(1'000'000, 401'000'000));
  EXPECT_THAT(recording.remarks, IsEmpty());
}

// As in KITTI 2015.
TEST_F(Recordings, ImagesOfEachSizeAreARecording) {
  const auto write = [this](const char* name, int columns, bool right) {
    cv::imwrite((folder_ / name).string(), view(right).colRange(0, columns));
  };
  for (const bool right : {false, true}) {
    const std::string folder = right ? "set/right/" : "set/left/";
    write((folder + "0.png").c_str(), 200, right);
    write((folder + "1.jpg").c_str(), 180, right);
    write((folder + "2.png").c_str(), 200, right);
    if (!right) write((folder + "3.png").c_str(), 160, right);
  }
  std::vector<Problem> problems;
  const std::vector<Recording> recordings = found(problems);
  ASSERT_THAT(recordings, SizeIs(2));
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(recordings[0].name, "set-180x120");
  EXPECT_EQ(recordings[1].name, "set-200x120");
  EXPECT_THAT(names_of(recordings[0].right.images), ElementsAre("1.jpg"));
  EXPECT_THAT(names_of(recordings[1].left.images), ElementsAre("0.png", "2.png"));
}

TEST_F(Recordings, SizesOfBrokenImagesAreUnknown) {
  for (const char* name : {"a.png", "a.jpg"}) {
    cv::imwrite((folder_ / name).string(), view(false));
    EXPECT_EQ(stated_size(path(name)), "200x120") << name;
    for (const double part : {0.0, 0.001, 0.002, 0.01}) {
      write_beginning(path(name), path("part"), part);
      EXPECT_THAT(stated_size(path("part")), ::testing::AnyOf("", "200x120")) << part;
    }
  }
  for (const char* bytes :
       {"\xff\xd8\xff\xe0", "\xff\xd8\xff\xe0\x01\x01zz", "\x89P", "GIF8", ""}) {
    write_text(folder_ / "b", bytes);
    EXPECT_THAT(stated_size(path("b")), IsEmpty());
  }
  EXPECT_THAT(stated_size(path("none")), IsEmpty());
}

// The number of the camera follows that of the frame.
TEST_F(Recordings, NamesThatEndWithTheSameNumber) {
  write_images("a", {"000001_40123.png", "000003_40123.png", "000004_40123.png"});
  write_images("b", {"000001_40129.png", "000002_40129.png", "000004_40129.png"}, true);
  const Recording recording = recognized({"a", "b"});
  EXPECT_THAT(recording.remarks, IsEmpty());
  EXPECT_EQ(recording.left.times.back(), recording.right.times.back());
  EXPECT_EQ(recording.left.times.front(), recording.right.times.front());
  EXPECT_GT(recording.left.times[1], recording.right.times[1]);
}

// The exposure follows the number of the frame, and some exposures are those of other frames.
TEST_F(Recordings, NamesThatEndWithOtherNumbers) {
  write_images("a", {"01_exp50.png", "02_exp60.png", "03_exp70.png", "04_exp80.png"});
  write_images("b", {"01_exp60.png", "02_exp70.png", "04_exp81.png"}, true);
  Recording recording = recognized({"a", "b"});
  EXPECT_THAT(recording.left.times, ElementsAre(0, 33'333'333, 66'666'667, 100'000'000));
  EXPECT_THAT(recording.right.times, ElementsAre(0, 33'333'333, 100'000'000));
  EXPECT_THAT(recording.remarks, IsEmpty());
  write_images("e", {"01_exp51.png", "02_exp61.png", "04_exp81.png"}, true);
  recording = recognized({"a", "e"});
  EXPECT_THAT(recording.right.times, ElementsAre(0, 33'333'333, 100'000'000));
  EXPECT_THAT(recording.remarks, IsEmpty());
  // Those of the frames are the last ones, if as many of them are on both sides.
  write_images("c", {"1_7.png", "2_8.png", "3_9.png"});
  write_images("d", {"1_8.png", "2_9.png", "4_10.png"}, true);
  recording = recognized({"c", "d"});
  EXPECT_THAT(recording.left.times, ElementsAre(0, 33'333'333, 66'666'667));
  EXPECT_THAT(recording.right.times, ElementsAre(33'333'333, 66'666'667, 100'000'000));
}

// Numbers after the date at which the recording began, which is not that of the other camera.
TEST_F(Recordings, NamesThatBeginWithADate) {
  write_images("left", {"20261126_093059_000101.png", "20261126_093059_000102.png"});
  write_images("right", {"20261126_093104_000101.png", "20261126_093104_000102.png"}, true);
  Recording recording = recognized({"left", "right"});
  EXPECT_THAT(recording.left.times, IsEmpty());
  EXPECT_EQ(recording.frame_rate, 30);
  write_images("burst", {"20261126_093059_001.png", "20261126_093059_002.png",
                         "20261126_093101_001.png", "20261126_139999_001.png"});
  recording = recognized({"burst", "left"});
  EXPECT_THAT(recording.remarks, Contains(HasSubstr("no numbers in common")));
}

TEST_F(Recordings, NamesThatAreSeconds) {
  write_images("cam0", {"1403636579.90.png", "1403636580.10.png", "1403636580.30.png"});
  write_images("cam1", {"1403636579.9004.png", "1403636580.3.png"}, true);
  const Recording recording = recognized({"cam0", "cam1"});
  EXPECT_THAT(recording.left.times, ElementsAre(0, 200'000'000, 400'000'000));
  EXPECT_THAT(recording.right.times, ElementsAre(400'000, 400'000'000));
  EXPECT_THAT(recording.remarks, IsEmpty());
  EXPECT_EQ(time_in_name("left_1625.123456.png"), 1'625'123'456'000);
  EXPECT_EQ(time_in_name("a1_1625.123456_left.png"), 1'625'123'456'000);
  // Versions and dates are no times, and neither is what 64 bits cannot count.
  for (const char* name : {"v2.001.png", "12345678901.123456.png", "9999999999.5.png", "a.5.png",
                           "1625.1234_left.png", "1625.123456_2.png", "left.png"}) {
    EXPECT_FALSE(time_in_name(name)) << name;
  }
}

// As Python prints them: by their digits, .7 and .70003 precede .12345.
TEST_F(Recordings, NamesThatAreSecondsWithFewOrManyDigits) {
  write_images("left", {"1403636579.7.png", "1403636579.70003.png", "1403636579.12345.png"});
  write_images("right", {"1403636579.123.png", "1403636579.6999999.png", "1403636579.8.png"}, true);
  Recording recording = recognized({"left", "right"});
  EXPECT_THAT(names_of(recording.left.images),
              ElementsAre("1403636579.12345.png", "1403636579.7.png", "1403636579.70003.png"));
  EXPECT_THAT(recording.left.times, ElementsAre(450'000, 577'000'000, 577'030'000));
  EXPECT_THAT(names_of(recording.right.images),
              ElementsAre("1403636579.123.png", "1403636579.6999999.png", "1403636579.8.png"));
  EXPECT_THAT(recording.right.times, ElementsAre(0, 576'999'900, 677'000'000));
  EXPECT_THAT(recording.remarks, IsEmpty());
  // The same time twice: they are no times of frames.
  write_images("right", {"1403636579.80.png"}, true);
  recording = recognized({"left", "right"});
  EXPECT_EQ(recording.left.images.front().filename(), "1403636579.7.png");
  EXPECT_THAT(recording.remarks, Contains(HasSubstr("no numbers in common")));
}

// As rs-convert writes them.
TEST_F(Recordings, NamesThatAreMillisecondsWithAFraction) {
  write_images("day", {"a_Infrared_1_1403636579900.25.png", "a_Infrared_1_1403636579933.5.png"});
  write_images(
      "day", {"a_Infrared_2_1403636579900.75.png", "a_Infrared_2_1403636579933.00000000000000.png"},
      true);
  const Recording recording = recognized({"day"});
  EXPECT_THAT(recording.left.times, ElementsAre(0, 33'250'000));
  EXPECT_THAT(recording.right.times, ElementsAre(500'000, 32'750'000));
  for (const char* name : {"140363657990.5.png", "14036365799000.5.png"}) {
    EXPECT_FALSE(time_in_name(name)) << name;
  }
}

TEST_F(Recordings, NamesWithNumbersThatAreNoFrames) {
  EXPECT_EQ(time_in_name("left_315978406032859416.jpg"), 315'978'406'032'859'416);
  EXPECT_FALSE(time_in_name("638400000000000000.jpg"));
  const std::initializer_list<const char*> names{"20231231235959998.png", "20231231235959999.png",
                                                 "638400000000000000.png"};
  write_images("left", names);
  write_images("right", names, true);
  const Recording recording = recognized({"left", "right"});
  EXPECT_THAT(recording.left.times, IsEmpty());
  EXPECT_THAT(recording.left.images, SizeIs(3));
  EXPECT_THAT(recording.remarks, ElementsAre(HasSubstr("too far apart for frames")));
}

// The last digits of such names are no numbers of frames.
TEST_F(Recordings, NamesThatDifferInTheirView) {
  write_images("left", {"2_leftImg8bit.png", "9_leftImg8bit.png", "10_leftImg8bit.png"});
  write_images("right", {"2_rightImg8bit.png", "10_rightImg8bit.png"}, true);
  const Recording recording = recognized({"left", "right"});
  const Nanoseconds period = 33'333'333;
  EXPECT_THAT(recording.left.times, ElementsAre(0, period, 2 * period + 1));
  EXPECT_THAT(recording.right.times, ElementsAre(0, 2 * period + 1));
  EXPECT_THAT(recording.remarks, IsEmpty());
}

// In the order of the names, "a2_l" is before "a_l", but "a" is before "a2".
TEST_F(Recordings, NamesWithAndWithoutNumbers) {
  write_images("all", {"a_l.png", "a2_l.png"});
  write_images("all", {"a_r.png", "a2_r.png"}, true);
  const Recording recording = recognized({"all"});
  EXPECT_THAT(names_of(recording.left.images), ElementsAre("a2_l.png", "a_l.png"));
  EXPECT_THAT(names_of(recording.right.images), ElementsAre("a2_r.png", "a_r.png"));
  EXPECT_THAT(recording.left.damage, IsEmpty());
}

// Cameras of 12 bits store their values in 16 bits.
TEST_F(Recordings, ImagesWithUnusedBits) {
  const auto write = [this](int left, int right, int depth) {
    for (const auto& [name, largest] :
         {std::pair("left/0.png", left), std::pair("right/0.png", right)}) {
      cv::Mat image;
      view(false).convertTo(image, depth, largest / 255.0);
      cv::imwrite((folder_ / name).string(), image);
    }
    return recognized({"left", "right"});
  };
  const Recording recording = write(700, 4095, CV_16U);
  EXPECT_EQ(recording.left.unused_bits, 4);
  EXPECT_EQ(recording.right.unused_bits, 4);
  EXPECT_THAT(recording.remarks,
              ElementsAre(HasSubstr("12 of 16 bits: their values are multiplied by 16")));
  EXPECT_EQ(write(700, 700, CV_16U).left.unused_bits, 6);
  for (const Recording& full :
       {write(700, 65535, CV_16U), write(0, 0, CV_16U), write(90, 90, CV_8U)}) {
    EXPECT_EQ(full.left.unused_bits, 0);
    EXPECT_THAT(full.remarks, IsEmpty());
  }
}

TEST_F(Recordings, ImagesOfACameraWithUnusedBitsBesideOneOf8) {
  write_images("left", {"0.png"});
  cv::Mat image;
  view(true).convertTo(image, CV_16U, 1023 / 255.0);
  cv::imwrite((folder_ / "right/0.png").string(), image);
  const Recording recording = recognized({"left", "right"});
  EXPECT_EQ(recording.left.unused_bits, 0);
  EXPECT_EQ(recording.right.unused_bits, 6);
  EXPECT_THAT(recording.remarks, ElementsAre(HasSubstr("The right images have 10 of 16 bits")));
}

TEST_F(Recordings, ImagesOfHeatWithFewValues) {
  for (const char* name : {"left/0.png", "right/0.png"}) {
    cv::Mat image;
    view(false).convertTo(image, CV_16U, 10, 29000);
    cv::imwrite((folder_ / name).string(), image);
  }
  const Recording recording = recognized({"left", "right"});
  EXPECT_EQ(recording.left.unused_bits, 0);
  EXPECT_THAT(recording.remarks, ElementsAre(AllOf(HasSubstr("of 256 gray values. Stretch"),
                                                   HasSubstr("mogrify -path"))));
}

TEST_F(Recordings, PosesAndTimesBesideTheViewsAreNoCalibrations) {
  write_images("all/image_left", {"1.png"});
  write_images("all/image_right", {"1.png"}, true);
  for (const char* name :
       {"pose_left.txt", "pose_right.txt", "left_times.txt", "right_times.txt"}) {
    write_text(folder_ / "all" / name, "0 0 0 0 0 0 1\n");
  }
  EXPECT_THAT(recognized({"all"}).remarks, IsEmpty());
}

TEST_F(Recordings, NamesOfImagesThatMayBeNoViews) {
  write_images("left", {"1.png", "1_mask.png", "2.png", "2_mask.png"});
  write_images("right", {"1.png", "2.png"}, true);
  EXPECT_THAT(recognized({"left", "right"}).remarks,
              Contains(AllOf(HasSubstr("1.png"), HasSubstr("_mask.png are both taken as views"))));
}

TEST_F(Recordings, ImagesWithoutCommonNumbersArePairsByTheirOrder) {
  write_images("left", {"1.png", "2.png"});
  write_images("right", {"101.png", "102.png"}, true);
  const Recording recording = recognized({"left", "right"});
  EXPECT_THAT(recording.left.times, IsEmpty());
  EXPECT_THAT(recording.remarks, ElementsAre(HasSubstr("no numbers in common")));
}

}  // namespace
}  // namespace mtstereo::run::image_lists_test
