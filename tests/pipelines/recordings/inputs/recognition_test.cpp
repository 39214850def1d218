// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/recognition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/image_lists.hpp"
#include "recordings/matching/product_files.hpp"
#include "recordings/media/frame_index.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::recognition_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::constant_times;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::have_ffmpeg;
using ::testing::IsEmpty;
using testing::kBFrames;
using testing::run_command;
using ::testing::SizeIs;
using testing::TemporaryFolder;
using testing::write_beginning;
using testing::write_text;
using testing::write_video;

constexpr int kWidth = 200, kHeight = 120, kDisparity = 12;  // [px]

// The views of a plane with a texture.
cv::Mat view(bool right) {
  cv::Mat noise(kHeight, kWidth + kDisparity, CV_8UC1), smooth;
  cv::RNG random(7);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, smooth, {5, 5}, 1.2);
  return smooth(cv::Rect(right ? kDisparity : 0, 0, kWidth, kHeight)).clone();
}

cv::Mat both(bool below, bool swapped) {
  cv::Mat frame;
  const cv::Mat first = view(swapped), second = view(!swapped);
  if (below) {
    cv::vconcat(first, second, frame);
  } else {
    cv::hconcat(first, second, frame);
  }
  return frame;
}

class Recordings : public ::testing::Test {
 protected:
  void write_images(const std::string& folder, std::initializer_list<const char*> names,
                    bool right = false) const {
    for (const char* name : names) {
      const fs::path file = folder_ / (folder + "/" + name);
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
    try {
      recognized(inputs, options);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  }

  std::vector<Recording> found(std::vector<Problem>& problems) const {
    return find_recordings(folder_.path(), {}, problems);
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
};

std::vector<std::string> names_of(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  return names;
}

TEST_F(Recordings, TwoVideoFiles) {
  write_video(folder_ / "drive_left.mp4", std::string(kBFrames) + " ! mp4mux", constant_times(5));
  write_video(folder_ / "drive_right.mkv", "jpegenc ! matroskamux", constant_times(5));
  const Recording recording = recognized({"drive_left.mp4", "drive_right.mkv"});
  EXPECT_EQ(recording.kind, "two video files");
  EXPECT_EQ(recording.arrangement, Arrangement::kTwoSources);
  EXPECT_EQ(recording.left.video, path("drive_left.mp4"));
  EXPECT_EQ(recording.right.video, path("drive_right.mkv"));
  EXPECT_EQ(recording.frame_rate, 0);
  EXPECT_TRUE(recording.rectified);
  EXPECT_THAT(recording.calibration, IsEmpty());
  InputOptions swap;
  swap.swap = true;
  EXPECT_EQ(recognized({"drive_left.mp4", "drive_right.mkv"}, swap).left.video,
            path("drive_right.mkv"));
}

// GStreamer repeats such files for ever.
TEST_F(Recordings, RefusesAnimationsWithoutEnd) {
  write_text(folder_ / "a.gif", "GIF89a");
  write_text(folder_ / "b.mp4", "GIF87a");
  for (const char* name : {"a.gif", "b.mp4"}) {
    EXPECT_THAT(error_of({name}),
                AllOf(HasSubstr(path(name) + ": is a GIF"), HasSubstr("convert")));
  }
}

TEST_F(Recordings, KindsThatAreNotReadHaveARemedy) {
  for (const char* name : {"day/left.svo", "shots/left/0.heic", "shots/right/0.heic"}) {
    write_text(folder_ / name, "x");
  }
  EXPECT_THAT(error_of({"day/left.svo"}),
              HasSubstr(path("day/left.svo") + ": is a recording of a"));
  EXPECT_THAT(error_of({"day"}), HasSubstr(path("day/left.svo") + ": is a recording of a ZED"));
  for (const char* name : {"shots", "shots/left", "shots/left/*.heic"}) {
    EXPECT_THAT(error_of({name}), HasSubstr(path("shots/left/0.heic") + ": is a kind of image"));
  }
}

TEST_F(Recordings, FolderWithTwoVideos) {
  write_video(folder_ / "day/left.ts", std::string(kBFrames) + " ! mpegtsmux", constant_times(5));
  write_video(folder_ / "day/right.ts", std::string(kBFrames) + " ! mpegtsmux", constant_times(5));
  const Recording recording = recognized({"day"});
  EXPECT_EQ(recording.name, "day");
  EXPECT_EQ(recording.left.video, path("day/left.ts"));
  EXPECT_EQ(recording.right.video, path("day/right.ts"));
}

TEST_F(Recordings, RefusesVideosOfDifferentSizes) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  write_video(folder_ / "left.mp4", std::string(kBFrames) + " ! mp4mux", constant_times(5));
  run_command("ffmpeg -v error -f lavfi -i testsrc=size=128x96:duration=1 '" + path("right.mp4") +
              "'");
  EXPECT_THAT(error_of({"left.mp4", "right.mp4"}),
              AllOf(HasSubstr(path("left.mp4") + " has 64x48 px"),
                    HasSubstr(path("right.mp4") + " has 128x96 px")));
}

TEST_F(Recordings, NamesInputsThatCannotBeRead) {
  write_images("left", {"0.png"});
  write_text(folder_ / "broken.mp4", "no video");
  fs::create_directory(path("empty"));
  EXPECT_THAT(error_of({"none.mp4", "left"}), HasSubstr(path("none.mp4") + ": no such file"));
  write_text(folder_ / "other.mp4", "no video");
  EXPECT_THAT(error_of({"broken.mp4", "other.mp4"}), HasSubstr(path("broken.mp4") + ": "));
  EXPECT_THAT(error_of({"broken.mp4", "broken.mp4"}), HasSubstr("are the same file"));
  EXPECT_THAT(error_of({"empty", "left"}), HasSubstr(path("empty") + ": "));
  EXPECT_THAT(error_of({"empty"}), HasSubstr(path("empty") + ": no recording"));
  EXPECT_THAT(error_of({"left/%03d.png", "left"}), HasSubstr("no file has such a name"));
  EXPECT_THAT(error_of({"left", "broken.mp4"}), HasSubstr("one is a video"));
  EXPECT_THAT([] { recognize({"http://host/a.mjpg"}, {}); },
              ::testing::ThrowsMessage<UserError>(HasSubstr("http://host/a.mjpg: is a stream")));
  EXPECT_THROW(recognize({}, {}), UserError);
  EXPECT_THROW(recognize({"a", "b", "c"}, {}), UserError);
}

TEST_F(Recordings, FoldersOfImages) {
  write_images("run/left", {"8.png", "9.png", "10.png"});
  write_images("run/right", {"8.png", "9.png", "10.png"}, true);
  InputOptions options;
  options.frame_rate = 15;
  for (const Recording& recording :
       {recognized({"run/left", "run/right"}, options), recognized({"run"}, options)}) {
    EXPECT_EQ(recording.name, "run");
    EXPECT_EQ(recording.frame_rate, 15);
    EXPECT_THAT(names_of(recording.left.images), ElementsAre("8.png", "9.png", "10.png"));
    EXPECT_EQ(recording.right.images.front(), path("run/right/8.png"));
    EXPECT_THAT(recording.remarks, IsEmpty());
  }
}

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

TEST_F(Recordings, NamesThatAreSeconds) {
  write_images("cam0", {"1403636579.90.png", "1403636580.10.png", "1403636580.30.png"});
  write_images("cam1", {"1403636579.9004.png", "1403636580.3.png"}, true);
  const Recording recording = recognized({"cam0", "cam1"});
  EXPECT_THAT(recording.left.times, ElementsAre(0, 200'000'000, 400'000'000));
  EXPECT_THAT(recording.right.times, ElementsAre(400'000, 400'000'000));
  EXPECT_THAT(recording.remarks, IsEmpty());
  EXPECT_EQ(time_in_name("left_1625.123456.png"), 1'625'123'456'000);
  // Versions and dates are no times, and neither is what 64 bits cannot count.
  for (const char* name : {"v2.001.png", "12345678901.123456.png", "9999999999.5.png", "a.5.png"}) {
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

TEST_F(Recordings, NamesOfImagesThatMayBeNoViews) {
  write_images("left", {"1.png", "1_mask.png", "2.png", "2_mask.png"});
  write_images("right", {"1.png", "2.png"}, true);
  EXPECT_THAT(recognized({"left", "right"}).remarks,
              Contains(AllOf(HasSubstr("1.png"), HasSubstr("_mask.png are both taken as views"))));
}

TEST_F(Recordings, PatternsOfImages) {
  write_images("all", {"left_001.png", "left_002.png", "x_left_001.png"});
  write_images("all", {"right_001.png", "right_002.png"}, true);
  const Recording recording = recognized({"all/left_%03d.png", "all/right_%03d.png"});
  EXPECT_THAT(names_of(recording.left.images), ElementsAre("left_001.png", "left_002.png"));
  EXPECT_THAT(names_of(recording.right.images), ElementsAre("right_001.png", "right_002.png"));
}

TEST_F(Recordings, ImagesOfBothViewsInOneFolder) {
  write_images("all", {"left_001.png", "left_002.png"});
  write_images("all", {"right_001.png", "right_002.png"}, true);
  const Recording recording = recognized({"all"});
  EXPECT_THAT(names_of(recording.left.images), ElementsAre("left_001.png", "left_002.png"));
  EXPECT_THAT(names_of(recording.right.images), ElementsAre("right_001.png", "right_002.png"));
}

TEST_F(Recordings, OtherImagesInTheFolderAreNamed) {
  write_images("all", {"left_1.png", "left_2.png", "left_3.png"});
  write_images("all", {"right_1.png", "right_3.png"}, true);
  const Recording recording = recognized({"all"});
  EXPECT_THAT(names_of(recording.left.images), ElementsAre("left_1.png", "left_3.png"));
  EXPECT_THAT(recording.remarks, ElementsAre(HasSubstr("1, such as " + path("all/left_2.png"))));
}

TEST_F(Recordings, EarlierResultsBesideTheViewsAreNotViews) {
  write_images("day/left", {"1.png"});
  write_images("day/right", {"1.png"}, true);
  for (const std::string& name : product_paths()) {
    if (fs::path(name).has_extension()) {
      write_text(folder_ / ("day/" + name), "no video");
    } else {
      write_images("day/" + name, {"000000.png"});
    }
  }
  EXPECT_THAT(error_of({"day"}), HasSubstr("2 recordings, such as"));
  write_text(folder_ / "day/run.json", "{}");
  const Recording recording = recognized({"day"});
  EXPECT_THAT(recording.remarks, IsEmpty());
  EXPECT_EQ(recording.left.images.front(), path("day/left/1.png"));
}

TEST_F(Recordings, ImagesOfOtherKindsAreOtherRecordings) {
  write_images("all", {"left.png", "disp_left.png", "imgL.jpg"});
  write_images("all", {"right.png", "disp_right.png", "imgR.jpg"}, true);
  EXPECT_THAT(error_of({"all"}), HasSubstr("3 recordings, such as all and disp"));
  std::vector<Problem> problems;
  std::vector<std::string> names;
  for (const Recording& recording : found(problems)) names.push_back(recording.name);
  EXPECT_THAT(names, ElementsAre("all", "all-disp", "all-img"));
  EXPECT_THAT(problems, IsEmpty());
}

TEST_F(Recordings, TheFirstImagesOfASequenceAreNoPair) {
  write_images("one", {"im1.png", "im2.png"});
  EXPECT_EQ(error_of({"one"}).rfind(path("one/im1.png") + ": 200x120 px is the shape of one", 0),
            0U)
      << error_of({"one"});
  EXPECT_THAT(error_of({"one"}), HasSubstr("patterns"));
}

TEST_F(Recordings, ImagesWithoutCommonNumbersArePairsByTheirOrder) {
  write_images("left", {"1.png", "2.png"});
  write_images("right", {"101.png", "102.png"}, true);
  const Recording recording = recognized({"left", "right"});
  EXPECT_THAT(recording.left.times, IsEmpty());
  EXPECT_THAT(recording.remarks, ElementsAre(HasSubstr("no numbers in common")));
}

TEST_F(Recordings, GuessesTheArrangement) {
  for (const bool below : {false, true}) {
    for (const bool swapped : {false, true}) {
      const fs::path file = folder_ / "images/1.png";
      cv::imwrite(file.string(), both(below, swapped));
      const Recording recording = recognized({"images"});
      EXPECT_EQ(recording.arrangement, below ? Arrangement::kTopBottom : Arrangement::kSideBySide);
      EXPECT_EQ(recording.swapped, swapped);
      EXPECT_TRUE(recording.right.empty());
      EXPECT_THAT(recording.remarks, Contains(HasSubstr("Both views are in one frame")));
    }
  }
}

TEST_F(Recordings, GuessesTheArrangementOfVideos) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  cv::imwrite((folder_ / "both.png").string(), both(false, false));
  run_command("ffmpeg -v error -loop 1 -i '" + path("both.png") +
              "' -t 2 -r 30 -c:v libx264 -pix_fmt yuv420p '" + path("both.mp4") + "'");
  const Recording recording = recognized({"both.mp4"});
  EXPECT_EQ(recording.arrangement, Arrangement::kSideBySide);
  EXPECT_EQ(recording.kind, "video file with both views");
  EXPECT_EQ(recording.name, "both");
  EXPECT_FALSE(recording.swapped);
}

TEST_F(Recordings, NamesTheStreamsOfAFileWithTwo) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const std::string source = " -f lavfi -i testsrc=size=160x120:duration=0.2";
  run_command("ffmpeg -v error" + source + " -c:v mjpeg '" + path("one.mkv") + "'");
  run_command("ffmpeg -v error" + source + source + " -map 0 -map 1 -c:v mjpeg '" +
              path("two.mkv") + "'");
  EXPECT_THAT(error_of({"one.mkv"}), HasSubstr("one view: give the other view too"));
  EXPECT_THAT(error_of({"two.mkv"}), HasSubstr("one view: it has 2 video streams"));
}

TEST_F(Recordings, RefusesInterlacedVideo) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  run_command(
      "ffmpeg -v error -f lavfi -i testsrc=size=64x48:duration=0.2 -flags +ildct+ilme "
      "-c:v mpeg2video '" +
      path("left.mpg") + "'");
  fs::copy(path("left.mpg"), path("right.mpg"));
  EXPECT_THAT(error_of({"left.mpg", "right.mpg"}),
              AllOf(HasSubstr(path("left.mpg") + ": the video is interlaced"), HasSubstr("bwdif")));
}

TEST_F(Recordings, DoesNotGuessWhatDoesNotMatch) {
  cv::Mat wide(kHeight, 2 * kWidth, CV_8UC1);
  cv::RNG(3).fill(wide, cv::RNG::UNIFORM, 0, 256);
  cv::imwrite((folder_ / "wide.png").string(), wide);
  cv::imwrite((folder_ / "usual.png").string(), cv::Mat(wide, {0, 0, 160, kHeight}));
  EXPECT_THAT(error_of({"wide.png"}), HasSubstr("its halves do not match"));
  EXPECT_THAT(error_of({"usual.png"}), HasSubstr("160x120 px is the shape of one view"));
  InputOptions stated;
  stated.arrangement = Arrangement::kTopBottom;
  stated.swap = true;
  const Recording recording = recognized({"usual.png"}, stated);
  EXPECT_EQ(recording.arrangement, Arrangement::kTopBottom);
  EXPECT_TRUE(recording.swapped);
  EXPECT_THAT(error_of({"usual.png", "usual.png"}, stated), HasSubstr("needs one source"));
  stated.arrangement = Arrangement::kTwoSources;
  EXPECT_THAT(error_of({"usual.png"}, stated), HasSubstr("needs two sources"));
}

TEST_F(Recordings, RefusesOddHalves) {
  cv::imwrite((folder_ / "odd.png").string(), cv::Mat(100, 301, CV_8UC1, cv::Scalar(0)));
  InputOptions stated;
  stated.arrangement = Arrangement::kSideBySide;
  EXPECT_THAT(error_of({"odd.png"}, stated), HasSubstr("its width is odd"));
  EXPECT_THAT(error_of({"odd.png"}), HasSubstr("is the shape of one view: give the other view"));
}

TEST_F(Recordings, RefusesFolderWithSeveralRecordings) {
  for (const char* name : {"a_left.avi", "a_right.avi", "b_left.avi", "b_right.avi"}) {
    write_video(folder_ / name, "jpegenc ! avimux", constant_times(2));
  }
  EXPECT_THAT(error_of({""}), HasSubstr("2 recordings, such as a and b"));
}

TEST_F(Recordings, FindsAllOfAnArchive) {
  write_images("one/left", {"1.png"});
  write_images("one/right", {"1.png"}, true);
  write_images("sets/Teddy", {"im0.png", "im1.png"});
  write_images("lonely/left", {"1.png"});
  write_images("thumbnails", {"1.png", "2.png"});
  write_images("results/maps/left", {"1.png"});
  write_images("results/maps/right", {"1.png"});
  write_text(folder_ / "results/run.json", "{}");
  for (const char* name : {"videos/a_left.avi", "videos/a_right.avi", "videos/b_left.avi"}) {
    write_video(folder_ / name, "jpegenc ! avimux", constant_times(2));
  }
  write_text(folder_ / "videos/c_left.mp4", "broken");
  write_text(folder_ / "videos/c_right.mp4", "broken");
  std::vector<Problem> problems;
  std::vector<std::string> names, inputs;
  for (const Recording& recording : found(problems)) names.push_back(recording.name);
  for (const Problem& problem : problems) inputs.push_back(problem.input);
  EXPECT_THAT(names, ElementsAre("one", "sets-Teddy", "videos-a"));
  EXPECT_THAT(inputs,
              ::testing::UnorderedElementsAre(path("lonely/left"), path("videos/c_left.mp4"),
                                              path("videos/b_left.avi")));
  EXPECT_THROW(find_recordings(path("none"), {}, problems), UserError);
}

}  // namespace
}  // namespace mtstereo::run::recognition_test
