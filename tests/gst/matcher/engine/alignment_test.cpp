// SPDX-License-Identifier: LGPL-2.1-or-later
// Inspection and correction of rendered pairs from a rig that is out of line.
#include "matcher/engine/alignment.hpp"

#include <gtest/gtest.h>

#include "support/rendered.hpp"

namespace mtstereo::test::alignment_test {
namespace {

using Maps = std::vector<std::vector<std::uint16_t>>;

const std::string kRange = "max-disparity=64 ";

render::Rig crooked() {
  render::Rig rig;
  rig.row_offset = 1.5, rig.roll = 0.3;
  return rig;
}

const std::vector<Pair>& crooked_pairs() {
  static const std::vector<Pair> pairs =
      rendered_pairs("street", 8, 0.2, rendered_settings(crooked()));
  return pairs;
}

const std::vector<Pair>& aligned_pairs() {
  static const std::vector<Pair> pairs = rendered_pairs("street", 8, 0.2);
  return pairs;
}

std::vector<Pair> first(const std::vector<Pair>& pairs, std::size_t count) {
  return {pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::string rendered_caps() { return raw_caps("GRAY8", kRenderedWidth, kRenderedHeight); }

/// The maps of a new element.
Maps maps_with(const std::string& properties, const std::vector<Pair>& pairs) {
  StereoHarness harness(kRange + properties);
  harness.caps(rendered_caps());
  return match_all(harness, pairs);
}

bool flag_of(const GstStructure* structure, const char* field) {
  gboolean flag = FALSE;
  EXPECT_TRUE(gst_structure_get_boolean(structure, field, &flag)) << field;
  return flag != FALSE;
}

// Feature: rectification
TEST(Alignment, CorrectsEvenASinglePair) {
  const std::vector<Pair> one = first(crooked_pairs(), 1);
  const double aligned = density_of(maps_with("alignment=off", first(aligned_pairs(), 1))[0]);
  const double crooked = density_of(maps_with("alignment=off", one)[0]);
  const double corrected = density_of(maps_with("", one)[0]);
  EXPECT_LT(crooked, 0.7 * aligned);
  EXPECT_GT(corrected, 0.93 * aligned);
}

TEST(Alignment, CorrectsWithPresetFast) {
  const std::vector<Pair> one = first(crooked_pairs(), 1);
  EXPECT_GT(density_of(maps_with("preset=fast", one)[0]),
            1.2 * density_of(maps_with("preset=fast alignment=off", one)[0]));
}

// Feature: misaligned rows are detected and corrected
TEST(Alignment, IsReportedByTheStatistics) {
  StereoHarness harness(kRange);
  harness.caps(rendered_caps());
  match_all(harness, first(crooked_pairs(), 1));
  const StructurePointer stats = stats_structure(harness.element());
  EXPECT_NEAR(number_of(stats.get(), "offset"), 1.5, 0.1);
  EXPECT_NEAR(number_of(stats.get(), "roll"), -0.3, 0.05);  // the right side is higher
  EXPECT_LT(number_of(stats.get(), "residual"), 0.45);
  EXPECT_TRUE(flag_of(stats.get(), "trust"));
  EXPECT_TRUE(flag_of(stats.get(), "applied"));
  EXPECT_EQ(number_of(stats.get(), "inspections"), 1);
  EXPECT_NEAR(number_of(stats.get(), "sharpness"), 1, 0.2);
  EXPECT_STREQ(gst_structure_get_string(stats.get(), "problem"), "");
}

TEST(Alignment, LeavesExactPairsAsTheyAre) {
  for (const std::string& scene : render::scene_names()) {
    const std::vector<Pair> pairs = rendered_pairs(scene, 3, 0.5);
    EXPECT_EQ(maps_with("alignment-interval=1", pairs), maps_with("alignment=off", pairs)) << scene;
  }
}

TEST(Alignment, OfPresetPaperIsOff) {
  StereoHarness harness(kRange + "preset=paper");
  harness.caps(rendered_caps());
  match_all(harness, first(crooked_pairs(), 1));
  EXPECT_EQ(number_of(stats_structure(harness.element()).get(), "inspections"), 0);
}

TEST(Alignment, MonitorReportsAndChangesNothing) {
  StereoHarness harness(kRange + "alignment=monitor");
  harness.caps(rendered_caps());
  EXPECT_EQ(match_all(harness, first(crooked_pairs(), 2)),
            maps_with("alignment=off", first(crooked_pairs(), 2)));
  const StructurePointer stats = stats_structure(harness.element());
  EXPECT_NEAR(number_of(stats.get(), "offset"), 1.5, 0.1);
  EXPECT_FALSE(flag_of(stats.get(), "applied"));
  EXPECT_NE(field_text(harness.element()), "");
}

TEST(Alignment, InspectsOnePairPerInterval) {
  StereoHarness harness(kRange + "alignment-interval=3");
  harness.caps(rendered_caps());
  match_all(harness, first(crooked_pairs(), 8));
  EXPECT_EQ(number_of(stats_structure(harness.element()).get(), "inspections"), 3);  // 0, 3, 6
}

TEST(Alignment, InspectsSeldomByDefault) {
  StereoHarness harness("max-disparity=256");
  harness.caps(rendered_caps());
  // 1.1e9 / (480 x 270 x 256) = 33 pairs.
  match_all(harness, std::vector<Pair>(33, aligned_pairs()[0]));
  EXPECT_EQ(number_of(stats_structure(harness.element()).get(), "inspections"), 1);
  match_all(harness, {aligned_pairs()[1]}, 33 * kFrame);
  EXPECT_EQ(number_of(stats_structure(harness.element()).get(), "inspections"), 2);
}

TEST(Alignment, IsTheSameInEveryRunAndForAnyNumberOfThreads) {
  const std::vector<Pair> pairs = first(crooked_pairs(), 4);
  const Maps once = maps_with("alignment-interval=2 threads=1", pairs);
  EXPECT_EQ(once, maps_with("alignment-interval=2 threads=1", pairs));
  EXPECT_EQ(once, maps_with("alignment-interval=2 threads=3", pairs));
}

/// The maps of three crooked pairs, the first of which a new element corrects, are the same after
/// others.
void expect_start_over(void (*start_over)(StereoHarness&)) {
  const std::string properties = "alignment-interval=2";
  StereoHarness harness(kRange + properties);
  harness.caps(rendered_caps());
  match_all(harness, first(aligned_pairs(), 3));
  start_over(harness);
  const std::vector<Pair> next = first(crooked_pairs(), 3);
  EXPECT_EQ(maps_with(properties, next), match_all(harness, next));
}

TEST(Alignment, StartsOverAfterAFlush) {
  expect_start_over([](StereoHarness& harness) { harness.flush(7); });
}

TEST(Alignment, StartsOverWithANewSegment) {
  expect_start_over([](StereoHarness& harness) { harness.segment(); });
}

/// A pair that gives no field.
Pair flat_pair(int width, int height) {
  const GrayImage gray = {width, height,
                          std::vector<std::uint8_t>(static_cast<std::size_t>(width * height), 100)};
  return {gray, gray};
}

TEST(Alignment, FieldOfAnotherFrameSizeIsNotReported) {
  StereoHarness harness(kRange);
  harness.caps(rendered_caps());
  match_all(harness, first(crooked_pairs(), 1));
  EXPECT_NE(field_text(harness.element()), "");
  harness.caps(raw_caps("GRAY8", 320, 180));
  match_all(harness, {flat_pair(320, 180)}, kFrame);
  EXPECT_EQ(field_text(harness.element()), "");
}

TEST(Alignment, StartsOverWithAnotherFrameSize) {
  StereoHarness harness(kRange + "alignment-interval=1000");
  harness.caps(rendered_caps());
  match_all(harness, first(crooked_pairs(), 2));
  render::Settings small = rendered_settings();
  small.width = 320, small.height = 180;
  const std::vector<Pair> aligned = rendered_pairs("street", 1, 0.1, small);
  harness.caps(raw_caps("GRAY8", 320, 180));
  const Maps maps = match_all(harness, aligned, 2 * kFrame);
  StereoHarness fresh(kRange + "alignment=off");
  fresh.caps(raw_caps("GRAY8", 320, 180));
  EXPECT_EQ(maps, match_all(fresh, aligned)) << "the field of the other size was applied";
  EXPECT_EQ(number_of(stats_structure(harness.element()).get(), "inspections"), 2);
}

TEST(Alignment, CanBeSwitchedWhilePlaying) {
  const std::vector<Pair> three(3, crooked_pairs()[0]);
  StereoHarness harness(kRange + "alignment=off");
  harness.caps(rendered_caps());
  Maps maps;
  int count = 0;
  for (const char* word : {"off", "correct", "off"}) {
    gst_util_set_object_arg(G_OBJECT(harness.element()), "alignment", word);
    maps.push_back(
        match_all(harness, {crooked_pairs()[0]}, static_cast<GstClockTime>(count++) * kFrame)[0]);
  }
  EXPECT_EQ(maps[0], maps[2]);
  EXPECT_GT(density_of(maps[1]), 1.2 * density_of(maps[0]));
}

// --- the field: stored, restored, announced ---

TEST(AlignmentField, CanBeStoredAndRestored) {
  StereoHarness harness(kRange);
  harness.caps(rendered_caps());
  match_all(harness, crooked_pairs());
  const Result<RowField> field = RowField::parse(field_text(harness.element()));
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->offset, 1.5, 0.1);

  // A pair that gives no field of its own is corrected by the restored one.
  const Pair flat = flat_pair(kRenderedWidth, kRenderedHeight);
  StereoHarness next(kRange + "alignment-field=" + field->to_text());
  next.caps(rendered_caps());
  match_all(next, {flat});
  EXPECT_TRUE(flag_of(stats_structure(next.element()).get(), "applied"));
  EXPECT_EQ(field_text(next.element()), field->to_text());
}

TEST(AlignmentField, AppliesAgainAfterAFlush) {
  StereoHarness harness(kRange + "alignment-interval=1000 alignment-field=6,0,0,0,0");
  harness.caps(rendered_caps());
  const std::vector<Pair> one = first(aligned_pairs(), 1);
  const Maps before = match_all(harness, one);
  EXPECT_NE(before, maps_with("alignment=off", one)) << "the field had no effect";
  harness.flush(7);
  EXPECT_EQ(before, match_all(harness, one));
}

TEST(AlignmentField, IsReplacedIfThePairsContradictIt) {
  StereoHarness harness(kRange + "alignment-interval=1 alignment-field=3,0,0,0,0");
  harness.caps(rendered_caps());
  match_all(harness, aligned_pairs());
  EXPECT_NEAR(number_of(stats_structure(harness.element()).get(), "offset"), 0, 0.1);
  EXPECT_FALSE(flag_of(stats_structure(harness.element()).get(), "applied"));
}

TEST(AlignmentField, SetWhilePlayingAppliesFromTheNextPair) {
  StereoHarness harness(kRange + "alignment-interval=1000");
  harness.caps(rendered_caps());
  const std::vector<Pair> one = first(aligned_pairs(), 1);
  match_all(harness, one);
  g_object_set(harness.element(), "alignment-field", "6,0,0,0,0", nullptr);
  EXPECT_EQ(field_text(harness.element()).substr(0, 2), "6,");
  match_all(harness, one, kFrame);
  EXPECT_TRUE(flag_of(stats_structure(harness.element()).get(), "applied"));
  g_object_set(harness.element(), "alignment-field", "", nullptr);
  match_all(harness, one, 2 * kFrame);
  EXPECT_FALSE(flag_of(stats_structure(harness.element()).get(), "applied"));
}

// --- a correction that is held ---

TEST(AlignmentHold, AppliesTheFieldThatWasSetToEveryPair) {
  const std::string field = "alignment-field=1.5,-0.8,0,0,0 ";
  StereoHarness harness(kRange + "alignment=hold alignment-interval=1 " + field);
  harness.caps(rendered_caps());
  const Maps whole = match_all(harness, first(crooked_pairs(), 3));
  const StructurePointer stats = stats_structure(harness.element());
  EXPECT_TRUE(flag_of(stats.get(), "applied"));
  EXPECT_FALSE(flag_of(stats.get(), "trust"));
  EXPECT_EQ(number_of(stats.get(), "inspections"), 0);
  EXPECT_EQ(field_text(harness.element()), "1.5,-0.8,0,0,0");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(maps_with("alignment=hold " + field, {crooked_pairs()[i]})[0], whole[i]) << i;
  }
  EXPECT_GT(density_of(whole[0]),
            1.2 * density_of(maps_with("alignment=off", first(crooked_pairs(), 1))[0]));
}

TEST(AlignmentHold, DoesNothingByItself) {
  EXPECT_EQ(maps_with("alignment=hold", first(crooked_pairs(), 2)),
            maps_with("alignment=off", first(crooked_pairs(), 2)));
}

TEST(AlignmentHold, FieldOfAnotherFrameSizeIsNotUsed) {
  StereoHarness harness(kRange + "alignment=hold alignment-field=6,0,0,0,0");
  const Pair small = noise_pair(128, 96, 4, 3);
  harness.caps(raw_caps("GRAY8", 128, 96));
  match_all(harness, {small});
  EXPECT_TRUE(flag_of(stats_structure(harness.element()).get(), "applied"));
  harness.caps(rendered_caps());
  match_all(harness, first(aligned_pairs(), 1), kFrame);
  EXPECT_FALSE(flag_of(stats_structure(harness.element()).get(), "applied"));
  g_object_set(harness.element(), "alignment-field", "5,0,0,0,0", nullptr);
  match_all(harness, first(aligned_pairs(), 1), 2 * kFrame);
  EXPECT_TRUE(flag_of(stats_structure(harness.element()).get(), "applied")) << "one of this size";
}

TEST(AlignmentField, NotifiesWhenItChanges) {
  StereoHarness harness(kRange);
  harness.caps(rendered_caps());
  int count = 0;
  const auto counter = +[](GObject*, GParamSpec*, gpointer data) { ++*static_cast<int*>(data); };
  g_signal_connect(harness.element(), "notify::alignment-field", G_CALLBACK(counter), &count);
  match_all(harness, {crooked_pairs()[0]});
  EXPECT_EQ(count, 1);
  match_all(harness, {crooked_pairs()[1]}, kFrame);
  EXPECT_EQ(count, 1) << "the second pair was not inspected";
}

TEST(AlignmentMessage, IsPostedWhenTheCorrectionChanges) {
  StereoHarness harness(kRange);
  harness.caps(rendered_caps());
  match_all(harness, {crooked_pairs()[0]});
  const StructurePointer message = harness.message("mtstereo-alignment");
  ASSERT_TRUE(message);
  EXPECT_NEAR(number_of(message.get(), "offset"), 1.5, 0.1);
  EXPECT_NEAR(number_of(message.get(), "roll"), -0.3, 0.05);
  EXPECT_GT(number_of(message.get(), "residual"), 0);
  EXPECT_TRUE(flag_of(message.get(), "trust"));
  EXPECT_FALSE(harness.message("mtstereo-alignment", 0.1));
}

TEST(AlignmentMessage, IsRateLimited) {
  StereoHarness harness(kRange);
  harness.caps(rendered_caps());
  for (GstClockTime i = 0; i < 6; ++i) {
    const std::string field = std::to_string(3 + i) + ",0,0,0,0";
    g_object_set(harness.element(), "alignment-field", field.c_str(), nullptr);
    match_all(harness, {aligned_pairs()[0]}, i * kFrame);
  }
  int count = 0;
  while (harness.message("mtstereo-alignment", 0.1)) ++count;
  EXPECT_GE(count, 1);
  EXPECT_LT(count, 6);
}

TEST(AlignmentMessage, IsNotPostedForAlignedPairs) {
  StereoHarness harness(kRange + "alignment-interval=1");
  harness.caps(rendered_caps());
  match_all(harness, aligned_pairs());
  EXPECT_FALSE(harness.message("mtstereo-alignment", 0.1));
}

// --- sharpness ---

Pair with_blurred_right(const Pair& pair, double sigma) {
  return {pair.left, blurred(pair.right, sigma)};
}

TEST(Sharpness, OfTheSharperViewIsMatched) {
  const Pair pair = with_blurred_right(aligned_pairs()[0], 2);
  StereoHarness harness(kRange);
  harness.caps(rendered_caps());
  const Maps matched = match_all(harness, {pair});
  const StructurePointer stats = stats_structure(harness.element());
  EXPECT_GT(number_of(stats.get(), "sharpness"), 1.25);
  EXPECT_NEAR(number_of(stats.get(), "left-blur"), 2, 0.3);
  EXPECT_EQ(number_of(stats.get(), "right-blur"), 0);
  const Maps kept = maps_with("sharpness=keep", {pair});
  EXPECT_GT(density_of(matched[0]), 1.1 * density_of(kept[0]));
}

TEST(Sharpness, OfAViewThatIsHeldIsThatWhichWasFound) {
  const Pair pair = with_blurred_right(aligned_pairs()[0], 2);
  StereoHarness harness(kRange);
  harness.caps(rendered_caps());
  const Maps matched = match_all(harness, {pair});
  const double blur = number_of(stats_structure(harness.element()).get(), "left-blur");
  const std::string held = "alignment=hold alignment-field=" + field_text(harness.element()) +
                           " left-blur=" + std::to_string(blur);
  StereoHarness next(kRange + held);
  next.caps(rendered_caps());
  const Maps again = match_all(next, {pair});
  EXPECT_NEAR(number_of(stats_structure(next.element()).get(), "left-blur"), blur, 1e-5);
  EXPECT_NEAR(density_of(again[0]), density_of(matched[0]), 1e-3);
}

TEST(Sharpness, IsKeptWithoutCorrection) {
  const Pair pair = with_blurred_right(aligned_pairs()[0], 1.2);
  EXPECT_EQ(maps_with("alignment=monitor", {pair}), maps_with("alignment=off", {pair}));
  EXPECT_EQ(maps_with("sharpness=keep", {pair}), maps_with("alignment=off", {pair}));
}

}  // namespace
}  // namespace mtstereo::test::alignment_test
