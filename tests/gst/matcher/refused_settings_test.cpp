// SPDX-License-Identifier: LGPL-2.1-or-later
// Values of properties that do not fit while the element runs: they are refused, and it continues.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "support/fixtures.hpp"

namespace mtstereo::test::refused_settings_test {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Running : public StreamsTest {
 protected:
  void start(const std::string& properties = "max-disparity=16", int width = kWidth,
             int height = kHeight) {
    pair = noise_pair(width, height, 4, 4);
    StreamsTest::start(properties);
    ASSERT_TRUE(next());
  }
  void expect_one_warning(std::initializer_list<const char*> parts) {
    const std::vector<Report> all = harness->warnings();
    ASSERT_EQ(all.size(), 1u);
    for (const char* part : parts) {
      EXPECT_TRUE(has(all[0].text + all[0].details, part)) << part << "\n"
                                                           << all[0].text << "\n"
                                                           << all[0].details;
    }
    EXPECT_EQ(all[0].domain, GST_LIBRARY_ERROR);
    EXPECT_EQ(all[0].code, GST_LIBRARY_ERROR_SETTINGS);
    EXPECT_EQ(harness->further_errors(0), 0);
  }
  void expect_no_message() {
    EXPECT_EQ(harness->warnings().size(), 0u);
    EXPECT_EQ(harness->further_errors(0), 0);
  }
  static Parameters range(int disparities) {
    Parameters parameters;
    EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, disparities).ok());
    return parameters;
  }
};

struct Value {
  const char* property;
  const char* value;
  const char* accepted;  ///< a part of the message
};

class RefusedValue : public Running, public testing::WithParamInterface<Value> {};

// Feature: wrong values are explained
TEST_P(RefusedValue, IsOneWarningAndTheLastValueStays) {
  const auto [name, value, accepted] = GetParam();
  start();
  const std::string before = get(name);
  set(name, value);
  expect_one_warning({name, value, accepted});
  EXPECT_EQ(get(name), before);
  expect_next(range(16), 256);
  expect_no_message();
}

INSTANTIATE_TEST_SUITE_P(All, RefusedValue,
                         testing::Values(Value{"census-kernel-size", "2", "odd"},
                                         Value{"cost-kernel-size", "4", "odd"},
                                         Value{"node-end-width", "2", "odd"},
                                         Value{"node-levels", "7", "0"},
                                         Value{"node-levels", "no levels", "0"},
                                         Value{"alignment-field", "1,2,3", "five numbers"},
                                         Value{"alignment-field", "1,2,3,4,1e9", "100"}));

TEST_F(Running, ARefusedValueDoesNotUndoOtherChanges) {
  start();
  g_object_set(harness->element(), "max-disparity", 8, "census-kernel-size", 2, nullptr);
  expect_one_warning({"census-kernel-size"});
  EXPECT_EQ(get("max-disparity"), "8");
  expect_next(range(8), 256);
}

TEST_F(Running, WarningsArePostedWithoutALock) {
  start();
  std::atomic<int> warnings{0};
  GstBus* bus = gst_element_get_bus(harness->element());
  gst_bus_set_sync_handler(
      bus,
      [](GstBus*, GstMessage* message, gpointer data) noexcept -> GstBusSyncReply {
        if (GST_MESSAGE_TYPE(message) != GST_MESSAGE_WARNING) return GST_BUS_PASS;
        int value = 0;  // an application that holds a lock would wait here forever
        g_object_get(GST_MESSAGE_SRC(message), "max-disparity", &value, nullptr);
        g_object_set(GST_MESSAGE_SRC(message), "qos", TRUE, nullptr);
        ++*static_cast<std::atomic<int>*>(data);
        return GST_BUS_PASS;
      },
      &warnings, nullptr);
  set("census-kernel-size", "2");
  EXPECT_EQ(warnings, 1);
  set("max-disparity", "300");
  EXPECT_TRUE(next());
  EXPECT_EQ(warnings, 2);
  gst_bus_set_sync_handler(bus, nullptr, nullptr, nullptr);
  gst_object_unref(bus);
}

// --- values that do not fit each other ---

// Feature: wrong values are explained
TEST_F(Running, ARefusedCombinationIsOneWarningAtTheNextPair) {
  start();
  set("max-disparity", "50");
  set("disparity-scale", "65535");
  expect_no_message();
  EXPECT_EQ(get("disparity-scale"), "65535");
  expect_next(range(16), 256);
  expect_one_warning({"disparity-scale = 65535", "set disparity-scale to 1 to 1310",
                      "refused: max-disparity=50 disparity-scale=65535",
                      "in use: max-disparity=16 disparity-scale=256"});
  EXPECT_EQ(get("disparity-scale"), "256");
  EXPECT_EQ(get("max-disparity"), "16");
  expect_next(range(16), 256);
  expect_no_message();
}

TEST_F(Running, ARefusedCombinationDoesNotUndoSettingsThatFitEverything) {
  start();
  set("timeout", "7");
  set("sync-mode", "first-pts");
  ASSERT_TRUE(next());
  set("sync-tolerance", "8000000");
  set("confidence-map", "false");
  set("alignment", "monitor");
  set("alignment-interval", "9");
  set("max-disparity", "300");
  const BufferPointer map = next();
  ASSERT_TRUE(map);
  expect_one_warning({"refused: max-disparity=300"});
  EXPECT_EQ(get("max-disparity"), "16");
  EXPECT_EQ(get("timeout"), "7");
  EXPECT_EQ(get("sync-mode"), "first-pts");
  EXPECT_EQ(get("sync-tolerance"), "8000000");
  EXPECT_EQ(get("confidence-map"), "false");
  EXPECT_EQ(get("alignment-interval"), "9");
  EXPECT_EQ(gst_buffer_get_custom_meta(map.get(), "MtStereoConfidenceMeta"), nullptr);
  // They are in effect, and a later change of the range is too.
  set("max-disparity", "8");
  expect_next(range(8), 256);
  expect_no_message();
}

TEST_F(Running, NotifiesOfPropertiesThatReturnToTheirLastValues) {
  start();
  std::atomic<int> notified{0};
  set("max-disparity", "100");
  g_signal_connect(
      harness->element(), "notify::max-disparity",
      G_CALLBACK(+[](GObject*, GParamSpec*, std::atomic<int>* number) noexcept { ++*number; }),
      &notified);
  expect_next(range(16), 256);
  EXPECT_EQ(notified, 1);
}

TEST_F(Running, TakesARefusedValueAfterItFits) {
  start();
  set("disparity-scale", "65535");
  expect_next(range(16), 256);
  expect_one_warning({"disparity-scale"});
  g_object_set(harness->element(), "max-disparity", 1, "disparity-scale", 65535, nullptr);
  expect_next(range(1), 65535);
  expect_no_message();
}

TEST_F(Running, RefusesASearchRangeWiderThanTheFrame) {
  start();
  set("max-disparity", "65");
  expect_next(range(16), 256);
  expect_one_warning({"max-disparity = 65", "64x48"});
  EXPECT_EQ(get("max-disparity"), "16");
}

TEST_F(Running, RefusesNodeWidthsThatExcludeEveryNode) {
  start();
  g_object_set(harness->element(), "min-node-width", 40, "max-node-width", 0.5, nullptr);
  expect_next(range(16), 256);
  expect_one_warning({"min-node-width = 40", "max-node-width"});
  EXPECT_EQ(get("min-node-width"), "5");
  expect_next(range(16), 256);
}

TEST_F(Running, RefusesAScaleThatDownstreamDoesNotAccept) {
  start();
  gst_harness_set_sink_caps_str(harness->output(), "video/x-raw,disparity-scale=256");
  ASSERT_TRUE(next());
  set("disparity-scale", "64");
  expect_next(range(16), 256);
  expect_one_warning({"downstream", "disparity-scale = 64", "disparity-scale=(int)256"});
  EXPECT_EQ(get("disparity-scale"), "256");
}

class Order : public Running, public testing::WithParamInterface<bool> {};

TEST_P(Order, OfChangesThatBelongTogetherDoesNotMatter) {
  start("max-disparity=64", 320, 40);
  if (GetParam()) {
    set("max-disparity", "300");
    set("disparity-scale", "64");
  } else {
    set("disparity-scale", "64");
    set("max-disparity", "300");
  }
  expect_next(range(300), 64);
  expect_no_message();
  EXPECT_EQ(get("max-disparity"), "300");
  EXPECT_EQ(get("disparity-scale"), "64");
}

INSTANTIATE_TEST_SUITE_P(Both, Order, testing::Bool());

TEST_F(Running, FrozenNotificationsKeepChangesTogetherAcrossPairs) {
  start("max-disparity=64", 320, 40);
  g_object_freeze_notify(G_OBJECT(harness->element()));
  set("max-disparity", "300");
  expect_next(range(64), 256);
  set("disparity-scale", "64");
  expect_next(range(64), 256);
  g_object_thaw_notify(G_OBJECT(harness->element()));
  expect_next(range(300), 64);
  expect_no_message();
}

// Feature: own properties change while playing
TEST_F(Running, OneCallThatSetsBothIsNeverSeenHalf) {
  start("max-disparity=64", 320, 40);
  std::atomic<bool> stop{false};
  std::thread changer([&] {
    for (int i = 0; !stop; ++i) {
      if (i % 2 == 0) {
        g_object_set(harness->element(), "max-disparity", 300, "disparity-scale", 64, nullptr);
      } else {
        g_object_set(harness->element(), "disparity-scale", 256, "max-disparity", 64, nullptr);
      }
    }
  });
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(next()) << i;
  stop = true;
  changer.join();
  expect_no_message();
}

// --- a new frame size ---

TEST_F(Running, SettingsThatDoNotFitANewFrameSizeAreAnError) {
  start("max-disparity=50");
  harness->caps(raw_caps("GRAY8", 40, 30));
  harness->push_pair(noise_pair(40, 30, 4, 4), count * kFrame);
  const Report error = harness->error();
  EXPECT_TRUE(has(error.text, "max-disparity = 50")) << error.text;
  EXPECT_EQ(harness->further_errors(), 0);
}

TEST_F(Running, ANewFrameSizeThatOnlyTheLastSettingsFitIsAWarning) {
  start();
  set("max-disparity", "50");
  pair = noise_pair(40, 30, 4, 4);
  harness->caps(raw_caps("GRAY8", 40, 30));
  expect_next(range(16), 256);
  expect_one_warning({"max-disparity = 50", "40x30"});
}

TEST_F(Running, ANewFrameSizeAndSettingsThatFitItAreTaken) {
  start("max-disparity=50");
  set("max-disparity", "20");
  pair = noise_pair(40, 30, 4, 4);
  harness->caps(raw_caps("GRAY8", 40, 30));
  expect_next(range(20), 256);
  expect_no_message();
}

// --- not running ---

TEST_F(Running, AfterAStopAnInvalidValueIsAgainAnErrorOfTheStart) {
  GstElement* element = make_element("max-disparity=16");
  GstBus* bus = gst_bus_new();
  gst_element_set_bus(element, bus);
  EXPECT_NE(gst_element_set_state(element, GST_STATE_PAUSED), GST_STATE_CHANGE_FAILURE);
  EXPECT_EQ(gst_element_set_state(element, GST_STATE_READY), GST_STATE_CHANGE_SUCCESS);
  g_object_set(element, "census-kernel-size", 2, nullptr);
  EXPECT_EQ(gst_bus_pop_filtered(bus, GST_MESSAGE_WARNING), nullptr);
  EXPECT_EQ(gst_element_set_state(element, GST_STATE_PAUSED), GST_STATE_CHANGE_FAILURE);
  EXPECT_TRUE(MessagePointer(gst_bus_pop_filtered(bus, GST_MESSAGE_ERROR)));
  gst_element_set_state(element, GST_STATE_NULL);
  gst_element_set_bus(element, nullptr);
  gst_object_unref(bus);
  gst_object_unref(element);
}

// --- extreme waits ---

struct Wait {
  const char* property;
  const char* value;
};

class ExtremeWait : public testing::TestWithParam<Wait> {};

TEST_P(ExtremeWait, IsLimitedAndDoesNotDelayTheEnd) {
  const auto [name, value] = GetParam();
  GstElement* pipeline = gst_parse_launch(
      "mtstereo name=m max-disparity=16 ! fakesink sync=false "
      "videotestsrc is-live=true ! video/x-raw,width=64,height=48,framerate=30/1 ! m.sink_left "
      "videotestsrc is-live=true ! video/x-raw,width=64,height=48,framerate=30/1 ! m.sink_right",
      nullptr);
  ASSERT_NE(pipeline, nullptr);
  GstElement* element = gst_bin_get_by_name(GST_BIN(pipeline), "m");
  gst_util_set_object_arg(G_OBJECT(element), name, value);
  EXPECT_EQ(property_text(element, name), "3600000000000");
  gst_element_set_state(pipeline, GST_STATE_PLAYING);
  EXPECT_NE(gst_element_get_state(pipeline, nullptr, nullptr, 10 * GST_SECOND),
            GST_STATE_CHANGE_ASYNC);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (stats_of(element).pairs < 2 && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(stats_of(element).pairs, 2u);
  const auto start = std::chrono::steady_clock::now();
  gst_element_set_state(pipeline, GST_STATE_NULL);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  gst_object_unref(element);
  gst_object_unref(pipeline);
}

INSTANTIATE_TEST_SUITE_P(All, ExtremeWait,
                         testing::Values(Wait{"sync-tolerance", "9223372036854775807"},
                                         Wait{"latency", "18446744073709551614"},
                                         Wait{"latency", "9223372036854775807"},
                                         Wait{"min-upstream-latency", "18446744073709551614"}));

}  // namespace
}  // namespace mtstereo::test::refused_settings_test
