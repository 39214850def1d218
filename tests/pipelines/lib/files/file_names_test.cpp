// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/files/file_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "lib/outputs/user_error.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::files::file_names_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

class FileNames : public ::testing::Test {
 protected:
  void create(std::initializer_list<const char*> names) const {
    for (const char* name : names) std::ofstream(folder_ / name).put('x');
  }

  std::vector<std::string> match(const std::string& pattern) const {
    return names_of(files_of_pattern((folder_ / pattern).string()));
  }

  static std::vector<std::string> names_of(const std::vector<fs::path>& files) {
    std::vector<std::string> names;
    for (const fs::path& file : files) names.push_back(file.filename().string());
    return names;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(FileNames, SortsByNumbers) {
  create({"f10.png", "f9.png", "f009.png", "f1.png", "notes.txt", ".hidden.png"});
  EXPECT_THAT(names_of(images_in(folder_.path())),
              ElementsAre("f1.png", "f009.png", "f9.png", "f10.png"));
}

TEST_F(FileNames, LeavesWhatSystemsWriteBesideFiles) {
  for (const char* folder : {"left", "@eaDir", "__MACOSX", "$RECYCLE.BIN", "#recycle", "@home"}) {
    fs::create_directories(folder_ / folder);
  }
  create({"._1.png", ".DS_Store", "Thumbs.db", "1.png"});
  EXPECT_THAT(names_of(folders_in(folder_.path())), ElementsAre("@home", "left"));
  EXPECT_THAT(names_of(files_in(folder_.path())), ElementsAre("1.png", "Thumbs.db"));
  EXPECT_THAT(names_of(images_in(folder_.path())), ElementsAre("1.png"));
}

TEST_F(FileNames, ComparesNumbersLongerThanAnInteger) {
  EXPECT_TRUE(numbered_less("99999999999999999999998.png", "99999999999999999999999.png"));
  EXPECT_FALSE(numbered_less("99999999999999999999999.png", "99999999999999999999998.png"));
  EXPECT_FALSE(numbered_less("a", "a"));
}

TEST_F(FileNames, EndInANumber) {
  EXPECT_EQ(last_digits("2011/left_0012.png"), "0012");
  EXPECT_EQ(last_number("2011/left_0012.png"), "12");
  EXPECT_EQ(last_number("cam1_000.left.png"), "0");
  EXPECT_EQ(last_digits("7a"), "7");
  EXPECT_EQ(last_number("2011/left.png"), "");
}

TEST_F(FileNames, PatternMatchesItsWidth) {
  create({"left_0001.png", "left_0002.png", "left_10000.png", "left_3.png", "left_00004.png",
          "right_0001.png", "left_000x.png"});
  EXPECT_THAT(match("left_%04d.png"),
              ElementsAre("left_0001.png", "left_0002.png", "left_10000.png"));
  EXPECT_THAT(match("left_%d.png"), ElementsAre("left_3.png", "left_10000.png"));
}

TEST_F(FileNames, PatternMayBeThatOfAShell) {
  create({"l10.png", "l9.png", "r9.png", "l9.txt", ".l1.png"});
  EXPECT_TRUE(is_pattern((folder_ / "l*.png").string()));
  EXPECT_THAT(match("l*.png"), ElementsAre("l9.png", "l10.png"));
  EXPECT_THAT(match("?9.png"), ElementsAre("l9.png", "r9.png"));
  EXPECT_THAT(match("[a-m]9.*"), ElementsAre("l9.png", "l9.txt"));
  EXPECT_TRUE(match("z*").empty());

  create({"[x].png"});
  EXPECT_FALSE(is_pattern((folder_ / "[x].png").string())) << "the name of a file that exists";
}

TEST_F(FileNames, PatternMayHavePercentSigns) {
  create({"50%_7.png"});
  EXPECT_THAT(match("50%%_%d.png"), ElementsAre("50%_7.png"));
}

TEST_F(FileNames, RefusesPatternWithoutOneNumber) {
  EXPECT_THROW(match("%s.png"), UserError);
  EXPECT_THROW(match("%d_%d.png"), UserError);
  EXPECT_THROW(match("%4d.png"), UserError);
  EXPECT_THROW(match("%"), UserError);
}

TEST_F(FileNames, TellImagesAndVideos) {
  for (const char* name : {"a.PNG", "a.jpg", "b.jfif", "both.JPS", "a.webp", "a.jp2"}) {
    EXPECT_TRUE(is_image(name) && !is_video(name)) << name;
  }
  for (const char* name : {"a.mov", "a.MP4", "pi.h264", "a.wmv"})
    EXPECT_TRUE(is_video(name) && !is_image(name));
  for (const char* name : {"jps", "a.txt", ".jpg", "a.mpo"}) EXPECT_FALSE(is_image(name)) << name;
  EXPECT_TRUE(is_jpeg("a.jpe"));
  EXPECT_FALSE(is_jpeg("a.png"));
}

TEST_F(FileNames, FolderThatDoesNotExistIsEmpty) {
  EXPECT_TRUE(files_in(folder_ / "none").empty());
  EXPECT_TRUE(match("none/%d.png").empty());
}

}  // namespace
}  // namespace mtstereo::files::file_names_test
