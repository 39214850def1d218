// SPDX-License-Identifier: LGPL-2.1-or-later
// What programs may replace, locks of folders, names in messages, numbers in options.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "lib/outputs/folder_lock.hpp"
#include "lib/outputs/json_text.hpp"
#include "lib/outputs/listed_folder.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "lib/outputs/write_file.hpp"
#include "lib/outputs/written_files.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::outputs::outputs_test {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using namespace std::string_literals;

class Folder : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    test::write_text(folder_ / name, text);
    return folder_ / name;
  }
  std::string read(const std::string& name) const { return test::read_text(folder_ / name); }
  std::string obstacle(const Intent& intent) const { return obstacle_in(folder_, intent); }

  const test::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

using Obstacle = Folder;

TEST_F(Obstacle, IsNothingInAFolderThatIsMissingOrHasOtherFiles) {
  EXPECT_EQ(obstacle_in(folder_ / "missing", {{"a.mkv", "maps"}, {}, {}}), "");
  write("notes.txt", "mine");
  fs::create_directory(folder_ / "maps");
  EXPECT_EQ(obstacle({{"a.mkv", "maps"}, {}, {}}), "");
}

TEST_F(Obstacle, IsAForeignFileOrFolder) {
  write("a.mkv", "mine");
  write("maps/deep/1.png", "mine");
  EXPECT_THAT(obstacle({{"a.mkv"}, {}, {}}),
              AllOf(HasSubstr("a.mkv is in the way"), HasSubstr("move it")));
  EXPECT_THAT(obstacle({{"b.mkv", "maps"}, {}, {}}), HasSubstr("maps/deep/1.png is in the way"));
}

TEST_F(Obstacle, IsNoFileThatWasWrittenAndDidNotChange) {
  write("maps/1.png", "four");
  Intent intent{{"maps"}, {}, {}};
  intent.written.add("maps/1.png", 4);
  EXPECT_EQ(obstacle(intent), "");
  write("maps/1.png", "longer");
  EXPECT_THAT(obstacle(intent), AllOf(HasSubstr("1.png was changed"), HasSubstr("6 of 4 bytes")));
}

// Another process of the same plan moves its folders and removes them.
TEST_F(Obstacle, IsNoFileOrFolderThatIsRemovedMeanwhile) {
  std::atomic<bool> stop{false};
  std::thread other([&] {
    while (!stop) {
      write("new/deep/1.png", "four");
      fs::rename(folder_ / "new", folder_ / "maps");
      fs::remove_all(folder_ / "maps");
    }
  });
  Intent intent{{"maps"}, {}, {}};
  intent.written.add("maps/deep/1.png", 4);
  std::string found;
  for (int i = 0; i < 5000 && found.empty(); ++i) found = obstacle(intent);
  stop = true;
  other.join();
  EXPECT_EQ(found, "");
}

TEST_F(Obstacle, IsWhatCannotBeExamined) {
  EXPECT_THAT(obstacle({{std::string(300, 'a')}, {}, {}}),
              HasSubstr("cannot be examined: File name"));
}

TEST_F(Obstacle, IsALinkAPipeOrADevice) {
  WrittenFiles written;
  for (const char* name : {"link", "loose", "pipe"}) written.add(name);
  fs::create_symlink(write("target", "mine"), folder_ / "link");
  fs::create_symlink(folder_ / "none", folder_ / "loose");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const char* name : {"link", "loose", "pipe"}) {
    EXPECT_THAT(obstacle({{name}, written, {}}), HasSubstr(std::string(name) + " is in the way"));
  }
}

TEST_F(Obstacle, IsAnInputByAnyName) {
  const fs::path input = write("input.mkv", "video");
  fs::create_hard_link(input, folder_ / "a.mkv");
  fs::create_symlink(input, folder_ / "link.mkv");
  Intent intent{{"a.mkv"}, {}, FileSet({folder_ / "link.mkv"})};
  intent.written.add("a.mkv");
  EXPECT_THAT(obstacle(intent), HasSubstr("a.mkv is an input, and would be replaced"));
  // Not a target, but a file of an earlier run that would be removed.
  intent.targets = {"b.mkv"};
  EXPECT_THAT(obstacle(intent), HasSubstr("a.mkv is an input, and would be removed"));
}

TEST_F(Obstacle, NamesThatLeadOutOfTheFolderAreNotWritten) {
  WrittenFiles written;
  for (const char* name : {"/etc/passwd", "../up", "a/../../up", ".", "", "a//b/."}) {
    written.add(name);
  }
  EXPECT_TRUE(written.empty());
}

using Removal = Folder;

TEST_F(Removal, TakesWhatWasWrittenAndFoldersThatAreEmptyThen) {
  write("maps/1.png", "1");
  write("maps/2.png", "2");
  write("clouds/1.ply", "1");
  write("clouds/notes.txt", "mine");
  write("changed.mkv", "longer");
  WrittenFiles written;
  for (const char* name : {"maps/1.png", "maps/2.png", "clouds/1.ply"}) written.add(name, 1);
  written.add("changed.mkv", 1);
  written.add("missing.mkv", 1);
  remove_written(folder_, written);
  EXPECT_FALSE(fs::exists(folder_ / "maps"));
  EXPECT_FALSE(fs::exists(folder_ / "clouds/1.ply"));
  EXPECT_EQ(read("clouds/notes.txt"), "mine");
  EXPECT_EQ(read("changed.mkv"), "longer");
}

TEST_F(Removal, FollowsNoLinkToAFolder) {
  write("elsewhere/1.png", "1");
  fs::create_symlink(folder_ / "elsewhere", folder_ / "maps");
  WrittenFiles written;
  written.add("maps/1.png", 1);
  remove_written(folder_, written);
  EXPECT_EQ(read("elsewhere/1.png"), "1");
}

TEST_F(Removal, DefectsAreNamed) {
  WrittenFiles written;
  written.add("a.mkv", 4);
  EXPECT_EQ(defect_of(folder_, written), "a.mkv is missing");
  write("a.mkv", "ab");
  EXPECT_EQ(defect_of(folder_, written), "a.mkv has 2 of 4 bytes");
  write("a.mkv", "abcd");
  EXPECT_EQ(defect_of(folder_, written), "");
}

using Lock = Folder;

// Feature: files of the user are kept
TEST_F(Lock, IsHeldByOneAndNamesItsProcess) {
  const FolderLock lock(folder_ / "new/out");
  const std::string refused = error_of([&] { FolderLock(folder_ / "new/out"); });
  EXPECT_THAT(refused, AllOf(HasSubstr("new/out"), HasSubstr("writes into this folder")));
  if (fs::exists("/proc/locks")) {
    EXPECT_THAT(refused, HasSubstr("process " + std::to_string(getpid())));
  }
}

TEST_F(Lock, IsSharedByThoseThatShareIt) {
  {
    const FolderLock first(folder_, Sharing::kShared), second(folder_, Sharing::kShared);
    EXPECT_THAT(error_of([&] { FolderLock{folder_}; }), HasSubstr("writes into this folder"));
  }
  EXPECT_EQ(error_of([&] { FolderLock{folder_}; }), "");
}

TEST_F(Lock, RemovesOnlyEmptyFoldersThatItCreated) {
  fs::create_directory(folder_ / "old");
  { const FolderLock lock(folder_ / "old/a/b"); }
  EXPECT_TRUE(fs::exists(folder_ / "old"));
  EXPECT_FALSE(fs::exists(folder_ / "old/a"));
  {
    const FolderLock lock(folder_ / "old/a/b");
    write("old/a/notes.txt", "mine");
  }
  EXPECT_FALSE(fs::exists(folder_ / "old/a/b"));
  EXPECT_EQ(read("old/a/notes.txt"), "mine");
}

TEST_F(Lock, IsReleasedWhenTheProcessIsKilled) {
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder_);
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(error_of([&] { FolderLock{folder_}; }), "");
}

TEST_F(Lock, OfAFileIsRefused) {
  write("file", "");
  for (const char* given : {"file", "file/", "file/below", "file/below/that"}) {
    EXPECT_THAT(error_of([&] { FolderLock(folder_ / given); }),
                AllOf(HasSubstr((folder_ / given).string() + ": the folder cannot be created"),
                      HasSubstr("file is a file: give the name of a folder")))
        << given;
  }
}

TEST_F(Lock, OfALinkToNothingIsRefused) {
  fs::create_symlink("nowhere", folder_ / "link");
  for (const char* given : {"link", "link/", "link/below"}) {
    EXPECT_THAT(error_of([&] { FolderLock(folder_ / given); }),
                HasSubstr("link is a link to nowhere, which does not exist: create that folder, or "
                          "give another one"))
        << given;
  }
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

using WriteFile = Folder;

TEST_F(WriteFile, NeverMovesOntoAnother) {
  const fs::path from = write("from", "new"), to = write("to", "mine");
  EXPECT_THAT(error_of([&] { move_file(from, to); }), HasSubstr("appeared meanwhile"));
  EXPECT_EQ(read("to"), "mine");
  write("folder/new", "new");
  write("full/mine", "mine");
  fs::create_directory(folder_ / "empty");
  EXPECT_NE(error_of([&] { move_file(folder_ / "folder", folder_ / "full"); }), "");
  EXPECT_EQ(read("full/mine"), "mine");
  move_file(folder_ / "folder", folder_ / "empty");
  EXPECT_EQ(read("empty/new"), "new");
}

TEST_F(WriteFile, StatesWhyAFileCannotBeWritten) {
  fs::create_directory(folder_ / "folder");
  EXPECT_THAT(error_of([&] { write_file(folder_ / "folder", "x"); }),
              HasSubstr("not a regular file"));
  EXPECT_THAT(error_of([&] { write_file(folder_ / "none/file", "x"); }), HasSubstr("No such file"));
}

using Listed = Folder;

// Feature: files of the user are kept
TEST_F(Listed, ReplacesOnlyItsOwnFiles) {
  write("left/mine.png", "mine");
  {
    ListedFolder files(folder_, "program");
    files.write("right/1.png", "first");
    files.write("calib.txt", "first");
    EXPECT_THAT(error_of([&] { files.write("left/mine.png", "x"); }), HasSubstr("in the way"));
  }
  ListedFolder files(folder_, "program");
  EXPECT_THAT(error_of([&] { files.check({"left", "right"}, {}); }), HasSubstr("left/mine.png"));
  files.check({"right", "calib.txt"}, {});
  files.write("calib.txt", "second, longer");
  EXPECT_EQ(read("calib.txt"), "second, longer");
  files.clear();
  EXPECT_FALSE(fs::exists(folder_ / "right"));
  EXPECT_FALSE(fs::exists(folder_ / "calib.txt"));
  EXPECT_EQ(read("left/mine.png"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(Listed, RefusesInputsAndFilesThatChanged) {
  ListedFolder files(folder_, "program");
  files.write("a.png", "first");
  const FileSet inputs({folder_ / "a.png"});
  EXPECT_THAT(error_of([&] { files.check({"b.png"}, inputs); }), HasSubstr("is an input"));
  write("a.png", "changed by its user");
  EXPECT_THAT(error_of([&] { files.write("a.png", "x"); }), HasSubstr("was changed"));
  files.clear();
  EXPECT_EQ(read("a.png"), "changed by its user");
}

TEST_F(Listed, ListsOfOtherProgramsAreForeign) {
  write(".program-files", "Dear diary\n4 a.png\n");
  write("a.png", "mine");
  ListedFolder files(folder_, "program");
  EXPECT_THAT(error_of([&] { files.check({}, {}); }), HasSubstr(".program-files is in the way"));
  EXPECT_THAT(error_of([&] { files.write("a.png", "x"); }), HasSubstr("in the way"));
  EXPECT_EQ(read("a.png"), "mine");
}

TEST(Printable, EscapesWhatIsNoTextAndDoesItOnce) {
  for (const auto& [text, expected] :
       std::vector<std::pair<std::string, std::string>>{{"left.mp4", "left.mp4"},
                                                        {"Straße 東京", "Straße 東京"},
                                                        {"bad\xff", "bad\\xff"},
                                                        {"\x1b[31mred", "\\x1b[31mred"},
                                                        {"cut\0here"s, "cut\\x00here"},
                                                        {"a\nb\t", "a\\x0ab\\x09"},
                                                        {"\xc3", "\\xc3"},
                                                        {"\xc2\x9b"
                                                         "1m",
                                                         "\\xc2\\x9b1m"},
                                                        {"\xed\xa0\x80", "\\xed\\xa0\\x80"},
                                                        {"back\\slash", "back\\slash"}}) {
    EXPECT_EQ(printable(text), expected);
    EXPECT_EQ(printable(printable(text)), expected);
  }
  EXPECT_EQ(printable_lines("two\nlines\x1b"), "two\nlines\\x1b");
}

// Feature: files of the user are kept
TEST(Printable, NamesAreRestored) {
  std::string all;
  for (int byte = 1; byte < 256; ++byte) all += static_cast<char>(byte);
  for (const std::string& name :
       {all, "bad\xff"s, "back\\x41slash"s, "\\"s, "\\x"s, "\\xg1"s, ""s}) {
    EXPECT_EQ(unescaped(escaped(name)), name);
    nlohmann::json json{{"list", {{"name", escaped(name)}}}};
    EXPECT_EQ(unescaped(nlohmann::json::parse(text_of(json))["list"]["name"].get<std::string>()),
              name);
  }
}

TEST(Printable, MakesEveryTextInJsonValid) {
  EXPECT_EQ(text_of(nlohmann::json{{"a", {"bad\xff", 1}}}), R"({"a":["bad\\xff",1]})");
}

TEST(Texts, HaveTheDecimalsAndPluralsAskedFor) {
  const std::string name(1000, 'x');
  EXPECT_EQ(format("%s: %.2f", name.c_str(), 1.005e3), name + ": 1005.00");
  EXPECT_EQ(decimal(2.345, 1), "2.3");
  EXPECT_EQ(percent(0.256), "26 %");
  EXPECT_EQ(percent(0.256, 1), "25.6 %");
  EXPECT_EQ(counted(1, "view") + ", " + counted(0, "view"), "1 view, 0 views");
}

}  // namespace
}  // namespace mtstereo::outputs::outputs_test
