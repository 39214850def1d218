// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/files/unread_kinds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "lib/outputs/user_error.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::files::unread_kinds_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class UnreadKinds : public testing::Test {
 protected:
  fs::path write(const char* name, const char* text = "x") const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  const test::TemporaryFolder folder_;
};

// Feature: recognition of videos, images and data sets
TEST_F(UnreadKinds, AreNamedWithTheRemedy) {
  EXPECT_THAT(unread_kind(write("a.HEIC")), HasSubstr("convert it to PNG"));
  EXPECT_THAT(unread_kind(write("a.exr")), HasSubstr("the same curve to both views"));
  EXPECT_THAT(unread_kind(write("a.jxl")), HasSubstr("convert it to PNG"));
  EXPECT_THAT(unread_kind(write("a.m3u8")), HasSubstr("write its video to one file"));
  EXPECT_THAT(unread_kind(write("a.nut")), HasSubstr("rewrite it"));
  EXPECT_THAT(unread_kind(write("a.mpd")), HasSubstr("-c copy view.mkv"));
  EXPECT_THAT(unread_kind(write("a.dng")), HasSubstr("develop both views"));
  EXPECT_THAT(unread_kind(write("a.GPR")), HasSubstr("develop both views"));
  EXPECT_THAT(unread_kind(write("a.IMG")), HasSubstr("write each view as 16-bit PNG"));
  EXPECT_THAT(unread_kind(write("a.MPO")), HasSubstr("-mpimage2"));
  EXPECT_THAT(unread_kind(write("a.mcap")), HasSubstr("recording of ROS"));
  EXPECT_THAT(unread_kind(write("a.svo2")), HasSubstr("ZED_SVO_Export"));
  EXPECT_THAT(unread_kind(write("a.tar.gz")), HasSubstr("unpack"));
  EXPECT_THAT(unread_kind(write("a.mp4", "GIF89a")), HasSubstr("is a GIF"));
  EXPECT_THAT(unread_kind(write("a.apng", "\x89PNG\r\n IHDR acTL")), HasSubstr("animated PNG"));
  for (const char* name : {"a.png", "b.mkv"}) {
    EXPECT_THAT(unread_kind(write(name, "version https://git-lfs.github.com/spec/v1\noid")),
                HasSubstr("(git lfs pull)"))
        << name;
  }
  for (const char* name : {"a.mjpeg", "frames", "b.avi"}) {
    EXPECT_THAT(unread_kind(write(name, "\xff\xd8\xff\xe0")), HasSubstr("state their rate"))
        << name;
  }
  EXPECT_THAT(unread_kind(write("b.MPO", "\xff\xd8\xff\xe1")), HasSubstr("-mpimage2"));
  EXPECT_THAT(unread_kind(write("b.jfif", "\xff\xd8\xff\xe0")), IsEmpty());
  EXPECT_THROW(refuse_unread(write("a.npz")), UserError);
}

// An image file directory with a width and a height; `next`: the place of the next one.
std::string directory(bool big, char side, char next) {
  const auto number = [big](char value, std::size_t bytes) {
    std::string text(bytes, '\0');
    text[big ? bytes - 1 : 0] = value;
    return text;
  };
  std::string text = number(2, 2);
  for (const char each : {'\0', '\1'}) {
    const std::string id{big ? '\1' : each, big ? each : '\1'};
    text += id + number(3, 2) + number(1, 4) + number(side, 2) + std::string(2, '\0');
  }
  return text + number(next, 4);
}

TEST_F(UnreadKinds, ArePagesOfTiff) {
  const auto tiff = [this](bool big, char second_side, char next) {
    const std::string head =
        big ? std::string("MM\0*\0\0\0\10", 8) : std::string("II*\0\10\0\0\0", 8);
    const fs::path file = folder_ / "a.tif";
    std::ofstream(file) << head << directory(big, 9, next) << directory(big, second_side, 0);
    return unread_kind(file);
  };
  constexpr char kSecond = 8 + 2 + 2 * 12 + 4;
  for (const bool big : {false, true}) {
    EXPECT_THAT(tiff(big, 9, kSecond), HasSubstr("several images, of which only the first"));
    EXPECT_THAT(tiff(big, 3, kSecond), IsEmpty()) << "a preview";
    EXPECT_THAT(tiff(big, 9, 0), IsEmpty());
    EXPECT_THAT(tiff(big, 9, 100), IsEmpty()) << "beyond the end";
    EXPECT_THAT(tiff(big, 9, 8), HasSubstr("several images")) << "a circle";
  }
}

// Such as files above 4 GB: places have 8 bytes, and so do the values.
TEST_F(UnreadKinds, ArePagesOfBigTiff) {
  const auto page = [](char side, char next) {
    std::string text("\2\0\0\0\0\0\0\0", 8);
    for (const char tag : {'\0', '\1'}) {
      text += tag + std::string("\1\3\0\1\0\0\0\0\0\0\0", 11) + side + std::string(7, '\0');
    }
    return text + next + std::string(7, '\0');
  };
  constexpr char kFirst = 16, kSecond = kFirst + 8 + 2 * 20 + 8;
  const auto tiff = [&](char second_side, char next) {
    const fs::path file = folder_ / "a.tif";
    std::ofstream(file) << std::string("II+\0\10\0\0\0", 8) << kFirst << std::string(7, '\0')
                        << page(9, next) << page(second_side, 0);
    return unread_kind(file);
  };
  EXPECT_THAT(tiff(9, kSecond), HasSubstr("several images, of which only the first"));
  EXPECT_THAT(tiff(3, kSecond), IsEmpty()) << "a preview";
  EXPECT_THAT(tiff(9, 0), IsEmpty());
}

// OpenCV turns them, programs that read the pixels only do not.
TEST_F(UnreadKinds, AreTiffThatAreTurned) {
  for (char orientation = 0; orientation <= 9; ++orientation) {
    const fs::path file = folder_ / "a.tif";
    std::ofstream(file) << std::string("II*\0\10\0\0\0\1\0\22\1\3\0\1\0\0\0", 18) << orientation
                        << std::string(7, '\0');
    const bool turned = orientation > 1 && orientation < 9;
    EXPECT_EQ(unread_kind(file).find("orientation tag") != std::string::npos, turned)
        << static_cast<int>(orientation);
  }
}

TEST_F(UnreadKinds, AreNoOthers) {
  for (const char* name : {"a.png", "a.mkv", "a.jp2", "a", ".a", "a.ba", "a.", "a. .heic .x"}) {
    EXPECT_THAT(unread_kind(write(name)), IsEmpty()) << name;
    EXPECT_NO_THROW(refuse_unread(folder_ / name)) << name;
  }
  EXPECT_THAT(unread_kind(write("empty.png", "")), IsEmpty());
  EXPECT_THAT(unread_kind(folder_ / "none.bag"), IsEmpty());
  fs::create_directory(folder_ / "folder.bag");
  EXPECT_THAT(unread_kind(folder_ / "folder.bag"), IsEmpty());
  // Reading a pipe would wait.
  ASSERT_EQ(mkfifo((folder_ / "pipe.bag").c_str(), 0600), 0);
  EXPECT_THAT(unread_kind(folder_ / "pipe.bag"), IsEmpty());
}

TEST_F(UnreadKinds, OfSeveralFilesTheFirstIsNamed) {
  const fs::path image = write("a.png"), bag = write("b.bag"), svo = write("c.svo");
  EXPECT_THAT(first_unread({image, bag, svo}), HasSubstr(bag.string() + ": is a recording of ROS"));
  EXPECT_THAT(first_unread({image}), IsEmpty());
  EXPECT_THAT(first_unread({}), IsEmpty());
}

}  // namespace
}  // namespace mtstereo::files::unread_kinds_test
