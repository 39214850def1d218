// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/recognition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/product_files.hpp"
#include "recordings/support/recordings_folder.hpp"

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
using testing::kHeight;
using testing::kWidth;
using testing::names_of;
using ::testing::Not;
using testing::Recordings;
using testing::run_command;
using testing::view;
using testing::write_text;
using testing::write_video;

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
  fs::remove_all(path("day"));
  for (const char* name : {"", "shots", "shots/left", "shots/left/*.heic"}) {
    EXPECT_THAT(error_of({name}), HasSubstr(path("shots/left/0.heic") + ": is a kind of image"));
  }
}

TEST_F(Recordings, OfRosOrAZedAmongOthersAreNamedOncePerFolder) {
  write_images("one/left", {"1.png"});
  write_images("one/right", {"1.png"}, true);
  for (const char* name :
       {"all.mcap", "one/raw.bag", "two/a.db3", "two/b.db3", "zed/a.svo", "zed/b.npy"}) {
    write_text(folder_ / name, "x");
  }
  std::vector<Problem> problems;
  const std::vector<Recording> recordings = found(problems);
  ASSERT_EQ(recordings.size(), 1U);
  // The views may be those of the recording beside or below it.
  EXPECT_THAT(recordings[0].remarks,
              ElementsAre(AllOf(HasSubstr(path("one/raw.bag") + " is not used: it is a recording"),
                                HasSubstr("of both cameras to two folders")),
                          HasSubstr(path("all.mcap") + " is not used: it is a recording")));
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].input, path("two/a.db3"));
  EXPECT_THAT(problems[0].reason, AllOf(HasSubstr("is a recording of ROS: write"),
                                        HasSubstr("(2 such files are in this folder)")));
  EXPECT_EQ(problems[1].input, path("zed/a.svo"));
  EXPECT_THAT(problems[1].reason, Not(HasSubstr("such files")));
}

TEST_F(Recordings, PhotosThatAreNotReadAreNamedAmongOthers) {
  write_images("one/left", {"1.png"});
  write_images("one/right", {"1.png"}, true);
  for (const char* name : {"two/left/1.HEIC", "two/left/2.HEIC", "two/right/1.HEIC",
                           "one/disparity/left/1.pfm", "one/disparity/right/1.pfm"}) {
    write_text(folder_ / name, "x");
  }
  std::vector<Problem> problems;
  EXPECT_EQ(found(problems).size(), 1U);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems.front().input, path("two/left/1.HEIC"));
  EXPECT_THAT(problems.front().reason, HasSubstr("convert it to PNG"));
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
  const std::string folders = "left," + path("left"),
                    patterns = "left/%d.jpg," + path("left/*.jpg");
  EXPECT_THAT(error_of({folders.c_str()}),
              HasSubstr("no such file or folder; separate the two views by a space: " +
                        path("left") + " " + path("left")));
  EXPECT_THAT(error_of({patterns.c_str()}),
              HasSubstr("no file has such a name; separate the two views"));
  EXPECT_THAT(error_of({"broken.mp4,none.mp4"}), Not(HasSubstr("separate the two views")));
  write_text(folder_ / "no-bytes.mp4", "");
  EXPECT_THAT(error_of({"no-bytes.mp4"}), HasSubstr(path("no-bytes.mp4") + ": the file is empty"));
  fs::create_symlink("/none/a.mp4", folder_ / "lost.mp4");
  EXPECT_THAT(error_of({"lost.mp4", "other.mp4"}),
              HasSubstr("lost.mp4: is a link to /none/a.mp4, which does not exist"));
  fs::create_symlink("loop.mp4", folder_ / "loop.mp4");
  EXPECT_THAT(error_of({"loop.mp4", "other.mp4"}), HasSubstr("loop.mp4: Too many levels"));
  fs::create_directories(folder_ / "cloned/left");
  fs::create_directories(folder_ / "cloned/right");
  for (const char* name : {"left/0.png", "right/0.png"}) {
    write_text(folder_ / "cloned" / name, "version https://git-lfs.github.com/spec/v1\n");
  }
  EXPECT_THAT(
      error_of({"cloned"}),
      HasSubstr("the first one is a pointer of Git LFS without the data: get it (git lfs pull)"));
  write_text(folder_ / "other.mp4", "no video");
  EXPECT_THAT(error_of({"broken.mp4", "other.mp4"}), HasSubstr(path("broken.mp4") + ": "));
  EXPECT_THAT(error_of({"broken.mp4", "broken.mp4"}), HasSubstr("are the same file"));
  EXPECT_THAT(error_of({"empty", "left"}), HasSubstr(path("empty") + ": "));
  EXPECT_THAT(error_of({"empty"}), HasSubstr(path("empty") + ": no recording"));
  write_images("rig/primary", {"0.png"});
  write_images("rig/secondary", {"0.png"});
  EXPECT_THAT(error_of({"rig"}), HasSubstr("such as primary and secondary, do not say"));
  write_images("rig/third", {"0.png"});
  EXPECT_THAT(error_of({"rig"}), HasSubstr("primary and secondary (of 3 folders with images)"));
  write_images("set/scene/camera_5", {"0.png"});
  write_images("set/scene/camera_6", {"0.png"});
  EXPECT_THAT(error_of({"set"}), HasSubstr("such as scene/camera_5 and scene/camera_6, do not"));
  write_images("sim/camera/rgb", {"0.png"});
  EXPECT_THAT(error_of({"sim"}), HasSubstr("the images in camera/rgb do not say by their names"));
  write_images("sim/camera_01/rgb", {"0.png"});
  EXPECT_THAT(error_of({"sim"}), HasSubstr("such as camera/rgb and camera_01/rgb, do not say"));
  write_images("half/left", {"0.png"});
  fs::create_directories(folder_ / "half/right");
  write_text(folder_ / "half/right/0.png", "");
  EXPECT_EQ(error_of({"half"}).rfind(path("half/right") + ": no image can be read", 0), 0U);
  EXPECT_THAT(error_of({"left/%03d.png", "left"}), HasSubstr("no file has such a name"));
  EXPECT_THAT(error_of({"left", "broken.mp4"}), HasSubstr("one is a video"));
  EXPECT_THAT([] { recognize({"http://host/a.mjpg"}, {}); },
              ::testing::ThrowsMessage<UserError>(HasSubstr("http://host/a.mjpg: is a stream")));
  EXPECT_THAT([] { recognize({"file:///videos/a%20b.mkv"}, {}); },
              ::testing::ThrowsMessage<UserError>(
                  HasSubstr("is the address of a file: give its path, /videos/a b.mkv")));
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
  write_images("all", {"left.png", "flash_left.png", "imgL.jpg"});
  write_images("all", {"right.png", "flash_right.png", "imgR.jpg"}, true);
  EXPECT_THAT(error_of({"all"}), HasSubstr("3 recordings, such as all and flash"));
  std::vector<Problem> problems;
  std::vector<std::string> names;
  for (const Recording& recording : found(problems)) names.push_back(recording.name);
  EXPECT_THAT(names, ElementsAre("all", "all-flash", "all-img"));
  EXPECT_THAT(problems, IsEmpty());
}

TEST_F(Recordings, TheFirstImagesOfASequenceAreNoPair) {
  write_images("one", {"im1.png", "im2.png"});
  EXPECT_EQ(error_of({"one"}).rfind(path("one/im1.png") + ": 200x120 px is the shape of one", 0),
            0U)
      << error_of({"one"});
  EXPECT_THAT(error_of({"one"}), HasSubstr("patterns"));
  write_images("kitti", {"image_0.png", "image_1.png", "image_2.png", "image_3.png"});
  EXPECT_EQ(recognized({"kitti"}).left.images.size(), 2U);
  write_images("kitti", {"image_4.png"});
  EXPECT_THAT(error_of({"kitti"}), HasSubstr("image_0.png: 200x120 px is the shape of one"));
  write_images("rig", {"1_cam0.png", "1_cam1.png", "1_cam4.png", "2_cam0.png", "2_cam1.png",
                       "3_cam0.png", "3_cam1.png"});
  EXPECT_EQ(recognized({"rig"}).left.images.size(), 3U);
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

// Films and phones store views at half their width or height: the shape is that of one view.
TEST_F(Recordings, NamesTheArrangementThatMatchesAgainstTheShape) {
  for (const bool below : {false, true}) {
    cv::Mat half;
    cv::resize(both(below, false), half, {400, below ? 200 : 240}, 0, 0, cv::INTER_AREA);
    cv::imwrite((folder_ / "half.png").string(), half);
    EXPECT_THAT(error_of({"half.png"}),
                HasSubstr(below ? "its halves match one above the other: state --layout top-bottom"
                                : "its halves match side by side: state --layout side-by-side"));
  }
}

// Feature: recognition of videos, images and data sets
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

// The name of the stream stands for the box of its second layer.
TEST_F(Recordings, NamesSpatialVideosOfPhones) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const std::string name : {"usual", "lhvC"}) {
    run_command(
        "ffmpeg -v error -f lavfi -i testsrc=size=160x120:duration=0.2 -c:v mjpeg "
        "-metadata:s:v handler_name=" +
        name + " '" + path(name + ".mov") + "'");
  }
  EXPECT_THAT(error_of({"usual.mov"}), HasSubstr("one view: give the other view too"));
  EXPECT_THAT(error_of({"lhvC.mov"}), HasSubstr("one view: it is a spatial video (MV-HEVC)"));
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

TEST_F(Recordings, NamesViewsInAlternatingRowsOrColumns) {
  cv::Mat scene(kHeight, 2 * kWidth, CV_8UC1);
  cv::RNG(5).fill(scene, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(scene, scene, {}, 2);
  cv::Mat rows(kHeight * 2, kWidth, CV_8UC1);
  for (int y = 0; y < rows.rows; ++y) {
    const int shift = y % 2 == 0 ? 0 : 9;
    scene.row(y / 2).colRange(shift, shift + kWidth).copyTo(rows.row(y));
  }
  cv::imwrite((folder_ / "rows.png").string(), rows);
  cv::imwrite((folder_ / "columns.png").string(), rows.t());
  EXPECT_THAT(error_of({"rows.png"}), HasSubstr("stereo3d=irl:sbsl"));
  EXPECT_THAT(error_of({"columns.png"}), HasSubstr("its columns alternate"));
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
  EXPECT_THAT(error_of({"odd.png"}, stated),
              HasSubstr("its width is odd; write the views to two files"));
  EXPECT_THAT(error_of({"odd.png"}), HasSubstr("is the shape of one view: give the other view"));
}

TEST_F(Recordings, RefusesFolderWithSeveralRecordings) {
  for (const char* name : {"a_left.avi", "a_right.avi", "b_left.avi", "b_right.avi"}) {
    write_video(folder_ / name, "jpegenc ! avimux", constant_times(2));
  }
  EXPECT_THAT(error_of({""}), HasSubstr("2 recordings, such as a and b"));
}

TEST_F(Recordings, FoldersThatCannotBeReadAreNamed) {
  write_images("day/left", {"1.png"});
  write_images("day/right", {"1.png"}, true);
  fs::create_directory(path("lost+found"));
  fs::permissions(path(""), fs::perms::all);
  for (const char* name : {"day", "lost+found"}) fs::permissions(path(name), fs::perms::none);
  constexpr uid_t kNobody = 65534;
  const uid_t user = geteuid();
  ASSERT_EQ(seteuid(user == 0 ? kNobody : user), 0);  // root reads everything
  std::vector<Problem> problems;
  const std::vector<Recording> recordings = found(problems);
  ASSERT_EQ(seteuid(user), 0);
  for (const char* name : {"day", "lost+found"}) fs::permissions(path(name), fs::perms::all);
  EXPECT_THAT(recordings, IsEmpty());
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems.front().input, path("day"));
  EXPECT_THAT(problems.front().reason, HasSubstr("the folder cannot be read: "));
}

// Feature: recognition of videos, images and data sets
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
