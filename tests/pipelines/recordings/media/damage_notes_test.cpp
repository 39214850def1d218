// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/damage_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mtstereo::run::damage_notes_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(AddDamage, ListsEachClauseOnce) {
  std::string damage;
  for (const char* clause : {"", "first", "second", "first", "", "second"}) {
    add_damage(damage, clause);
  }
  EXPECT_EQ(damage, "first; second");
}

TEST(AddDamage, KeepsALongClauseAndEndsALongList) {
  const std::string clause(5'000, 'x');
  std::string damage;
  add_damage(damage, clause);
  EXPECT_EQ(damage, clause);
  damage.clear();
  for (int i = 0; i < 10'000; ++i) add_damage(damage, "damage of piece " + std::to_string(i));
  EXPECT_LT(damage.size(), 2'100U);
  EXPECT_THAT(damage, StartsWith("damage of piece 0; damage of piece 1;"));
  EXPECT_THAT(damage, EndsWith("; and more"));
  EXPECT_EQ(damage.find("; and more"), damage.rfind("; and more"));
}

TEST(DamageNotes, AreOfTheirViews) {
  const std::vector<DamageNote> notes{{3, 1, {500'000'000, "bad"}},
                                      {7, 1, {std::nullopt, "worse"}},
                                      {7, 0, {std::nullopt, "torn"}}};
  EXPECT_EQ(
      damage_text(notes, true),
      "1 frame of the left view cannot be decoded without errors (torn); 2 frames of the right "
      "view cannot be decoded without errors, the first one at 0.500 s (bad)");
  EXPECT_THAT(damage_text({notes[2]}, false), HasSubstr("1 frame of the recording cannot"));
  EXPECT_EQ(damage_text(std::vector<DamageNote>(), true), "");
}

TEST(DamageNotes, AreReadAsTheyWereWritten) {
  for (const DamageNote& note :
       {DamageNote{0, 0, {std::nullopt, "no time"}}, DamageNote{0, 1, {0, "at  the start"}},
        DamageNote{0, 1, {-5, "1 2 3"}}, DamageNote{0, 0, {9'000'000'000'000, "{}:\\"}}}) {
    const std::string line = line_of(note);
    ASSERT_THAT(line, EndsWith("\n"));
    DamageNote read;
    ASSERT_TRUE(parse_line(line.substr(0, line.size() - 1), read)) << line;
    EXPECT_EQ(read.side, note.side);
    EXPECT_EQ(read.frame.time, note.frame.time);
    EXPECT_EQ(read.frame.reason, note.frame.reason);
  }
}

TEST(DamageNotes, HaveOneLineForAnyReason) {
  const std::string line = line_of({0, 0, {1, "a\nb\xff"}});
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  DamageNote read;
  ASSERT_TRUE(parse_line(line.substr(0, line.size() - 1), read));
  EXPECT_EQ(read.frame.reason, "a\\x0ab\\xff");
}

TEST(DamageNotes, AreNoOtherLines) {
  for (const char* line :
       {"", "damaged", "damaged 0", "damaged 0 5", "damaged 2 5 bad", "damaged -1 5 bad",
        "damaged 0 x bad", "damaged 0 5x bad", "damaged 0 99999999999999999999 bad",
        "7 7 7 0.5 0.5 0.5", "undamaged 0 5 bad", "damaged x 5 bad"}) {
    DamageNote note;
    EXPECT_FALSE(parse_line(line, note)) << line;
  }
}

}  // namespace
}  // namespace mtstereo::run::damage_notes_test
