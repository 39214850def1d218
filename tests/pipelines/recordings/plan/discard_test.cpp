// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/discard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "fake_pieces.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/plan/plan_contents.hpp"
#include "recordings/plan/task.hpp"

namespace mtstereo::run::discard_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Discard : public ::testing::Test {
 protected:
  Discard() : files_(folder_.path()) { write_fake_plan(folder_.path()); }

  void do_one(std::size_t number) {
    do_task(folder_.path(), number, TaskOptions{fake_functions(), 0}, nullptr);
  }
  void do_all() {
    for (std::size_t i = 0; i < 5; ++i) do_one(i);
  }
  fs::path fake_file(std::size_t number) const { return files_.piece(number) / kFakeFile; }
  bool nothing_is_unfinished() const {
    return !fs::exists(files_.unfinished()) || fs::is_empty(files_.unfinished());
  }

  TemporaryFolder folder_;
  PlanFolder files_;
};

TEST_F(Discard, RefusesALinkInPlaceOfAPiece) {
  do_one(0);
  const fs::path elsewhere = folder_.path() / "elsewhere";
  fs::rename(files_.piece(0), elsewhere);
  fs::resize_file(elsewhere / kFakeFile, 1);
  fs::create_symlink(elsewhere, files_.piece(0));
  EXPECT_THROW(discard(files_.piece(0), files_.unfinished()), UserError);
  EXPECT_TRUE(fs::is_symlink(files_.piece(0)));
  EXPECT_EQ(read_text(elsewhere / kFakeFile).size(), 1U);
}

// Another process replaces the damaged piece after it was examined.
TEST_F(Discard, LeavesAPieceThatIsWholeByNow) {
  do_one(0);
  const Origin origin = origin_of(files_, "a", {0, 4});
  EXPECT_FALSE(discard_damaged(files_.piece(0), origin, files_.unfinished()));
  EXPECT_EQ(defect(files_.piece(0), origin, Check::kContents), "");
  EXPECT_TRUE(nothing_is_unfinished());
  fs::resize_file(fake_file(0), 1);
  EXPECT_TRUE(discard_damaged(files_.piece(0), origin, files_.unfinished()));
  EXPECT_FALSE(fs::exists(files_.piece(0)));
  EXPECT_TRUE(nothing_is_unfinished());
  EXPECT_TRUE(discard_damaged(files_.piece(0), origin, files_.unfinished()));
}

TEST_F(Discard, MayBeCalledWhileOthersPublishAndDiscard) {
  do_one(0);
  const fs::path original = folder_.path() / "original";
  fs::copy(files_.piece(0), original);
  fs::create_directories(files_.unfinished());
  std::atomic<bool> stop{false};
  std::thread publisher([&] {
    while (!stop) {
      const fs::path next = files_.unfinished() / "piece-0-host-1-2";
      fs::copy(original, next);
      std::error_code error;
      fs::rename(next, files_.piece(0), error);
      if (error) fs::remove_all(next);
    }
  });
  const auto discard_often = [&] {
    for (int i = 0; i < 1000; ++i) discard(files_.piece(0), files_.unfinished());
  };
  std::thread other([&] { EXPECT_NO_THROW(discard_often()); });
  EXPECT_NO_THROW(discard_often());
  other.join();
  stop = true;
  publisher.join();
  EXPECT_TRUE(nothing_is_unfinished());
}

// The file of the user appears in the last moment, and another process publishes the piece.
TEST_F(Discard, LeavesFilesThatAppearMeanwhile) {
  do_one(0);
  fs::path set_aside;
  EXPECT_TRUE(discard(files_.piece(0), files_.unfinished(), [&](const fs::path& aside) {
    write_text(aside / "notes.txt", "mine");
    set_aside = aside;
    return false;
  }));
  EXPECT_FALSE(fs::exists(set_aside / kFakeFile));
  do_all();
  EXPECT_EQ(merge(folder_.path(), {fake_functions(), 1, false}).joined, 2U);
  EXPECT_EQ(read_text(set_aside / "notes.txt"), "mine");
  EXPECT_THAT([&] { check_plan_folder(folder_.path(), {}); },
              ::testing::ThrowsMessage<UserError>(HasSubstr("notes.txt is in the way")));
  fs::remove(set_aside / "notes.txt");
  merge(folder_.path(), {fake_functions(), 1, false});
  EXPECT_FALSE(fs::exists(files_.unfinished()));
}

TEST_F(Discard, IsCompletedByAMergeIfItWasKilled) {
  do_all();
  fs::create_directories(files_.unfinished());
  const fs::path aside = files_.unfinished() / "discarded-host-1-2";
  fs::copy(files_.piece(0), aside);
  fs::remove(aside / kFakeFile);
  check_plan_folder(folder_.path(), {});
  EXPECT_EQ(merge(folder_.path(), {fake_functions(), 1, false}).joined, 2U);
  EXPECT_FALSE(fs::exists(files_.unfinished()));
}

}  // namespace
}  // namespace mtstereo::run::discard_test
