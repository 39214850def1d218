// SPDX-License-Identifier: LGPL-2.1-or-later
// The properties on alignment and sharpness: defaults, ranges, rejected values.
#include <gtest/gtest.h>

#include "support/fixtures.hpp"

namespace mtstereo::test::match_properties_test {
namespace {

class AlignmentProperties : public ElementTest {};

TEST_F(AlignmentProperties, CorrectByDefault) {
  EXPECT_EQ(text("alignment"), "correct");
  EXPECT_EQ(text("sharpness"), "match");
  EXPECT_EQ(text("alignment-interval"), "0");
  EXPECT_EQ(text("alignment-field"), "");
}

TEST_F(AlignmentProperties, FollowThePresetUnlessSet) {
  set("preset", "paper");
  EXPECT_EQ(text("alignment"), "off");
  EXPECT_EQ(text("sharpness"), "keep");
  set("preset", "fast");
  EXPECT_EQ(text("alignment"), "correct");
  EXPECT_EQ(text("sharpness"), "match");
}

TEST_F(AlignmentProperties, DoNotFollowThePresetIfSet) {
  set("alignment", "monitor");
  set("sharpness", "match");
  set("preset", "paper");
  EXPECT_EQ(text("alignment"), "monitor");
  EXPECT_EQ(text("sharpness"), "match");
}

TEST_F(AlignmentProperties, TakeChoicesByWord) {
  for (const char* word : {"off", "monitor", "correct", "hold"}) {
    set("alignment", word);
    EXPECT_EQ(text("alignment"), word);
  }
  for (const char* word : {"keep", "match"}) {
    set("sharpness", word);
    EXPECT_EQ(text("sharpness"), word);
  }
}

TEST_F(AlignmentProperties, CanBeChangedWhilePlaying) {
  for (const char* name : {"alignment", "alignment-interval", "alignment-field", "sharpness",
                           "left-blur", "right-blur"}) {
    GParamSpec* spec = find(name);
    ASSERT_NE(spec, nullptr) << name;
    EXPECT_TRUE(spec->flags & GST_PARAM_MUTABLE_PLAYING) << name;
    EXPECT_EQ(spec->flags & G_PARAM_READWRITE, G_PARAM_READWRITE) << name;
  }
}

TEST_F(AlignmentProperties, BlurIsReadAsItWasSet) {
  EXPECT_EQ(text("left-blur"), "0");
  set("left-blur", "1.25");
  set("right-blur", "0.5");
  EXPECT_EQ(text("left-blur"), "1.25");
  EXPECT_EQ(text("right-blur"), "0.5");
}

TEST_F(AlignmentProperties, FieldIsReadAsItWasSet) {
  set("alignment-field", "0.5,-0.25,0,1e-3,0");
  const Result<RowField> read = RowField::parse(text("alignment-field"));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (RowField{0.5, -0.25, 0, 1e-3, 0}));
  set("alignment-field", "");
  EXPECT_EQ(text("alignment-field"), "");
}

TEST_F(AlignmentProperties, FieldCanBeNull) {
  g_object_set(element, "alignment-field", nullptr, nullptr);
  EXPECT_EQ(text("alignment-field"), "");
}

class RejectedField : public testing::TestWithParam<const char*> {};

TEST_P(RejectedField, IsOneWarning) {
  StereoHarness harness;
  const Pair pair = noise_pair(64, 48, 4, 4);
  harness.caps(raw_caps("GRAY8", 64, 48));
  g_object_set(harness.element(), "alignment-field", "1,0,0,0,0", nullptr);
  harness.push_pair(pair, 0);
  ASSERT_TRUE(harness.pull());
  g_object_set(harness.element(), "alignment-field", GetParam(), nullptr);
  EXPECT_EQ(property_text(harness.element(), "alignment-field").find("1,"), 0u)
      << "a rejected value must not change the property";
  EXPECT_EQ(harness.warnings().size(), 1u);
  harness.push_pair(pair, kFrame);
  EXPECT_TRUE(harness.pull());
  EXPECT_EQ(harness.further_errors(0), 0);
}

INSTANTIATE_TEST_SUITE_P(Texts, RejectedField,
                         testing::Values("up", "1,2,3", "1,2,3,4,5,6", "1,2,3,4,nan", "1e9,0,0,0,0",
                                         "1;0;0;0;0"));

TEST(AcceptedField, ReplacesARejectedOne) {
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 64, 48));
  g_object_set(harness.element(), "alignment-field", "wrong", nullptr);
  g_object_set(harness.element(), "alignment-field", "0,0,0,0,0", nullptr);
  harness.push_pair(noise_pair(64, 48, 4, 4), 0);
  EXPECT_TRUE(harness.pull());
  EXPECT_EQ(harness.further_errors(), 0);
}

}  // namespace
}  // namespace mtstereo::test::match_properties_test
