// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <string_view>
#include <thread>

#include "support/fixtures.hpp"

namespace mtstereo::test::properties_test {
namespace {

class Properties : public ElementTest {};

TEST_F(Properties, SayWhichAreForExpertsAndWhatTheDefaultsAre) {
  const auto blurb = [this](const char* name) {
    return std::string(g_param_spec_get_blurb(find(name)));
  };
  EXPECT_EQ(0U, blurb("mode").find("Density of the map"));
  EXPECT_EQ(0U, blurb("max-disparity").find("The disparities min-disparity"));
  EXPECT_EQ(0U, blurb("census-kernel-size").find("Expert: side of the window"));
  EXPECT_EQ(0U, blurb("cost-volume").find("Expert: resolution of"));
  EXPECT_NE(
      std::string::npos,
      blurb("min-confidence")
          .find(". Default: 134 (sparse 210, dense 107, full 0); preset fast: 134 (sparse 184, "
                "dense 97, full 0); preset paper: 0"));
  EXPECT_NE(std::string::npos,
            blurb("census-kernel-size").find(". Unit: px. Default: 5 (dense 3, full 3)"));
  EXPECT_EQ(std::string::npos, blurb("subpixel").find("Default:"));  // the same everywhere
}

TEST_F(Properties, IncludeEveryRowOfTheParameterTable) {
  for (const ParameterInfo& info : parameter_table()) {
    GParamSpec* spec = find(info.name);
    ASSERT_NE(spec, nullptr) << info.name;
    EXPECT_TRUE((spec->flags & G_PARAM_READWRITE) == G_PARAM_READWRITE) << info.name;
    EXPECT_TRUE(spec->flags & GST_PARAM_MUTABLE_PLAYING) << info.name;
    // The first letter is a capital.
    EXPECT_NE(std::string(g_param_spec_get_blurb(spec)).find(info.help + 1), std::string::npos);
    switch (info.type) {
      case ParameterType::kInteger:
        ASSERT_EQ(G_PARAM_SPEC_VALUE_TYPE(spec), G_TYPE_INT) << info.name;
        EXPECT_EQ(G_PARAM_SPEC_INT(spec)->minimum, static_cast<int>(info.minimum)) << info.name;
        EXPECT_EQ(G_PARAM_SPEC_INT(spec)->maximum, static_cast<int>(info.maximum)) << info.name;
        break;
      case ParameterType::kNumber:
        ASSERT_EQ(G_PARAM_SPEC_VALUE_TYPE(spec), G_TYPE_DOUBLE) << info.name;
        EXPECT_EQ(G_PARAM_SPEC_DOUBLE(spec)->minimum, info.minimum) << info.name;
        EXPECT_EQ(G_PARAM_SPEC_DOUBLE(spec)->maximum, info.maximum) << info.name;
        break;
      case ParameterType::kBoolean:
        EXPECT_EQ(G_PARAM_SPEC_VALUE_TYPE(spec), G_TYPE_BOOLEAN) << info.name;
        break;
      case ParameterType::kChoice:
        EXPECT_TRUE(G_IS_PARAM_SPEC_ENUM(spec)) << info.name;
        break;
      case ParameterType::kLevels:
        EXPECT_EQ(G_PARAM_SPEC_VALUE_TYPE(spec), G_TYPE_STRING) << info.name;
        break;
    }
  }
}

TEST_F(Properties, HaveTheDefaultsOfTheLibrary) {
  const Parameters defaults;
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type == ParameterType::kNumber || info.type == ParameterType::kBoolean) continue;
    EXPECT_EQ(text(info.name), defaults.text(info.id)) << info.name;
  }
  EXPECT_EQ(text("disparity-scale"), "256");
  EXPECT_EQ(text("sync-tolerance"), "-1");
  EXPECT_EQ(text("qos"), "true");
  EXPECT_EQ(text("confidence-map"), "true");
}

// Feature: presets
TEST_F(Properties, FollowPresetAndModeUnlessSet) {
  for (const char* const preset : {"paper", "fast", "default"}) {
    for (const char* const mode : {"sparse", "dense", "full", "semi-dense"}) {
      Parameters expected;
      ASSERT_TRUE(expected.set(Parameter::kPreset, std::string_view(preset)).ok());
      ASSERT_TRUE(expected.set(Parameter::kMode, std::string_view(mode)).ok());
      set("preset", preset);
      set("mode", mode);
      for (const ParameterInfo& info : parameter_table()) {
        if (info.type == ParameterType::kNumber) continue;  // formatted differently
        EXPECT_EQ(text(info.name), expected.text(info.id)) << info.name;
      }
      double confidence = 0;
      g_object_get(element, "pixel-confidence", &confidence, nullptr);
      EXPECT_EQ(confidence, expected.get(Parameter::kPixelConfidence));
    }
  }
}

TEST_F(Properties, DoNotFollowTheModeIfSet) {
  g_object_set(element, "gray-levels", 11, nullptr);
  set("mode", "sparse");
  EXPECT_EQ(text("gray-levels"), "11");
}

TEST_F(Properties, TakeChoicesByWord) {
  for (const char* word : {"sparse", "semi-dense", "dense", "full"}) {
    set("mode", word);
    EXPECT_EQ(text("mode"), word);
  }
}

TEST_F(Properties, TakeNodeLevelsAsText) {
  g_object_set(element, "node-levels", "3,1,0", nullptr);
  EXPECT_EQ(text("node-levels"), "3,1,0");
  g_object_set(element, "node-levels", "no levels", nullptr);
  EXPECT_EQ(text("node-levels"), "3,1,0") << "a rejected value must not change the property";
}

// Feature: statistics
TEST_F(Properties, HaveReadOnlyStatisticsThatStartAtZero) {
  const Stats stats = stats_of(element);
  EXPECT_EQ(stats.pairs + stats.dropped_left + stats.dropped_right + stats.skipped, 0u);
  EXPECT_EQ(stats.mean_ms, 0.0);
  EXPECT_FALSE(find("stats")->flags & G_PARAM_WRITABLE);
}

// Feature: correction of a constant skew
TEST_F(Properties, OfThePadsAreAvailableByChildProxy) {
  for (const char* name : {"sink_left", "sink_right", "src"}) {
    GObject* child = gst_child_proxy_get_child_by_name(GST_CHILD_PROXY(element), name);
    ASSERT_NE(child, nullptr) << name;
    EXPECT_TRUE(GST_IS_PAD(child));
    g_object_unref(child);
  }
  EXPECT_EQ(gst_child_proxy_get_children_count(GST_CHILD_PROXY(element)), 3u);
  EXPECT_EQ(gst_child_proxy_get_child_by_index(GST_CHILD_PROXY(element), 3), nullptr);
}

// --- while playing ---

struct Change {
  const char* property;
  const char* value;
};

class ChangeWhilePlaying : public testing::TestWithParam<Change> {};

// Feature: own properties change while playing
// Feature: sparse and dense modes
TEST_P(ChangeWhilePlaying, AppliesFromTheNextPair) {
  const auto [property, value] = GetParam();
  const Pair pair = noise_pair(128, 96, 5, 3);
  Parameters before;
  ASSERT_TRUE(before.set(Parameter::kMaxDisparity, 16).ok());
  Parameters after = before;
  ASSERT_TRUE(after.set(std::string_view(property), std::string_view(value)).ok());

  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 128, 96));
  harness.push_pair(pair, 0);
  BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  EXPECT_EQ(first_difference(library_map(pair, before, 256), map_of(map.get(), 128, 96), 128), "");
  gst_util_set_object_arg(G_OBJECT(harness.element()), property, value);
  harness.push_pair(pair, kFrame);
  map = harness.pull();
  ASSERT_TRUE(map) << harness.error(1).text;
  EXPECT_EQ(first_difference(library_map(pair, after, 256), map_of(map.get(), 128, 96), 128), "");
}

INSTANTIATE_TEST_SUITE_P(
    Some, ChangeWhilePlaying,
    testing::Values(Change{"mode", "sparse"}, Change{"max-disparity", "32"},
                    Change{"max-disparity", "8"}, Change{"gray-levels", "24"},
                    Change{"threads", "3"}, Change{"node-levels", "2,1,0"},
                    Change{"cost-kernel-size", "5"}, Change{"cost-volume", "full"},
                    Change{"pixel-confidence", "20"}, Change{"subpixel", "false"},
                    Change{"outlier-radius", "0"}),
    [](const auto& info) {
      std::string name = std::string(info.param.property) + "_" + info.param.value;
      for (char& c : name) {
        if (c == '-' || c == ',') c = '_';
      }
      return name;
    });

// Feature: own properties change while playing
TEST(WhilePlaying, ChangesFromAnotherThreadLoseNoPair) {
  StereoHarness harness;
  const Pair pair = noise_pair(64, 48, 4, 5);
  harness.caps(raw_caps("GRAY8", 64, 48));
  std::atomic<bool> stop{false};
  std::thread changer([&] {
    for (int i = 0; !stop; ++i) {
      g_object_set(harness.element(), "max-disparity", 8 + i % 3 * 8, "gray-levels", 8 + i % 9,
                   "disparity-scale", 16 + i % 2, "alignment", i % 4, "sharpness", i % 2,
                   "alignment-interval", 1 + i % 3, "alignment-field",
                   i % 2 == 0 ? "0.5,0,0,0,0" : "", nullptr);
    }
  });
  for (GstClockTime i = 0; i < 40; ++i) {
    harness.push_pair(pair, i * kFrame);
    EXPECT_TRUE(harness.pull()) << i;
  }
  stop = true;
  changer.join();
  EXPECT_EQ(harness.further_errors(), 0);
  EXPECT_EQ(harness.stats().pairs, 40u);
}

// Feature: statistics
TEST(WhilePlaying, StatisticsHavePairsTimeAndDensity) {
  StereoHarness harness("max-disparity=16 mode=semi-dense");
  const Pair pair = noise_pair(128, 96, 5, 6);
  harness.caps(raw_caps("GRAY8", 128, 96));
  for (GstClockTime i = 0; i < 3; ++i) {
    harness.push_pair(pair, i * kFrame);
    ASSERT_TRUE(harness.pull());
  }
  const Stats stats = harness.stats();
  EXPECT_EQ(stats.pairs, 3u);
  EXPECT_GT(stats.last_ms, 0.0);
  EXPECT_GT(stats.mean_ms, 0.0);
  EXPECT_GT(stats.density, 0.0);
  EXPECT_LE(stats.density, 1.0);
  gst_element_set_state(harness.element(), GST_STATE_READY);
  gst_element_set_state(harness.element(), GST_STATE_PAUSED);
  EXPECT_EQ(harness.stats().pairs, 0u) << "when it starts again";
}

}  // namespace
}  // namespace mtstereo::test::properties_test
