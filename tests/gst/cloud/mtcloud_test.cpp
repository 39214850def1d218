// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>
#include <chrono>

#include "cloud/cloud_harness.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::mtcloud_test {
namespace {

constexpr std::size_t kPoints = std::size_t{kCloudWidth} * kCloudHeight - 1;

/// Seconds since an earlier time.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Feature: point cloud
TEST(Cloud, HasThePointsOfTheMapInMeters) {
  const CloudFolder folder;
  CloudHarness harness(location(folder), false);
  ASSERT_EQ(harness.push_map(GstClockTime{0}), GST_FLOW_OK);
  EXPECT_EQ(folder.files(), "cloud-00000.ply");
  const std::vector<PlyPoint> points = read_ply(folder / "cloud-00000.ply");
  ASSERT_EQ(points.size(), kPoints);
  // Depth 100 px * 0.5 m / 10 px = 5 m; the principal point is the center, (2.5, 1.5).
  EXPECT_FLOAT_EQ(points.front().x, (1 - 2.5F) * 5 / 100);
  EXPECT_FLOAT_EQ(points.front().y, -1.5F * 5 / 100);
  EXPECT_FLOAT_EQ(points.front().z, 5);
  EXPECT_FLOAT_EQ(points.back().x, 2.5F * 5 / 100);
  EXPECT_FLOAT_EQ(points.back().y, 1.5F * 5 / 100);
  EXPECT_EQ(points.front().red, 255) << "white without a left view";
  EXPECT_EQ(points.front().confidence, 255);
  EXPECT_FALSE(next_message(harness.bus(), GST_MESSAGE_WARNING));
}

TEST(Cloud, HasTheColorsOfTheLeftFrameOfTheSameTime) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(harness.push_left(static_cast<GstClockTime>(i) * kFrame, 10 + i), GST_FLOW_OK);
  }
  ASSERT_EQ(harness.push_map(1 * kFrame), GST_FLOW_OK);
  ASSERT_EQ(harness.push_map(3 * kFrame), GST_FLOW_OK);
  EXPECT_EQ(folder.files(), "cloud-00000.ply cloud-00001.ply");
  EXPECT_EQ(first_red(folder / "cloud-00000.ply"), 11);
  EXPECT_EQ(first_red(folder / "cloud-00001.ply"), 13);
  const PlyPoint point = read_ply(folder / "cloud-00001.ply").front();
  EXPECT_EQ(point.green, 26);
  EXPECT_EQ(point.blue, 39);
}

TEST(Cloud, AFrameThatBeginsBeforeItsSegmentIsPairedByItsTimeToo) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  segment.start = segment.time = segment.position = 5 * kFrame + kFrame / 2;
  gst_harness_push_event(harness.left(), gst_event_new_segment(&segment));
  gst_harness_push_event(harness.maps(), gst_event_new_segment(&segment));
  for (int i = 4; i < 8; ++i) harness.push_left(static_cast<GstClockTime>(i) * kFrame, i);
  for (int i = 5; i < 8; ++i) {
    EXPECT_EQ(harness.push_map(static_cast<GstClockTime>(i) * kFrame), GST_FLOW_OK);
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(first_red(folder / ("cloud-0000" + std::to_string(i) + ".ply")), 5 + i);
  }
}

/// Pushes a left frame while its map waits.
std::thread push_left_soon(CloudHarness& harness, GstClockTime pts, int red) {
  return std::thread([&harness, pts, red] {
    g_usleep(100'000);
    harness.push_left(pts, red);
  });
}

TEST(Cloud, WaitsForALeftFrameThatIsLate) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  std::thread later = push_left_soon(harness, 0, 77);
  EXPECT_EQ(harness.push_map(GstClockTime{0}), GST_FLOW_OK);
  later.join();
  EXPECT_EQ(first_red(folder / "cloud-00000.ply"), 77);
}

TEST(Cloud, AMissingLeftFrameCostsItsColorsOnly) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  harness.push_left(0, 1);
  harness.push_left(2 * kFrame, 2);
  const Stopwatch time;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(harness.push_map(static_cast<GstClockTime>(i) * kFrame), GST_FLOW_OK);
  }
  EXPECT_LT(time.seconds(), 3) << "a later frame shows that there is none";
  EXPECT_EQ(first_red(folder / "cloud-00000.ply"), 1);
  EXPECT_EQ(first_red(folder / "cloud-00001.ply"), 255);
  EXPECT_EQ(first_red(folder / "cloud-00002.ply"), 2);
  const std::string warning = text_of(next_message(harness.bus(), GST_MESSAGE_WARNING));
  EXPECT_NE(warning.find("sink_left"), std::string::npos) << warning;
}

TEST(Cloud, ASilentLeftViewCostsOneTimeout) {
  const CloudFolder folder;
  CloudHarness harness(location(folder) + " timeout=200000000");
  const Stopwatch time;
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(harness.push_map(static_cast<GstClockTime>(i) * kFrame), GST_FLOW_OK);
  }
  EXPECT_GT(time.seconds(), 0.19);
  EXPECT_LT(time.seconds(), 0.9);
  EXPECT_EQ(first_red(folder / "cloud-00004.ply"), 255);
  harness.push_left(5 * kFrame, 9);
  EXPECT_EQ(harness.push_map(5 * kFrame), GST_FLOW_OK);
  EXPECT_EQ(first_red(folder / "cloud-00005.ply"), 9);
  std::thread later = push_left_soon(harness, 6 * kFrame, 10);
  EXPECT_EQ(harness.push_map(6 * kFrame), GST_FLOW_OK) << "it waits again";
  later.join();
  EXPECT_EQ(first_red(folder / "cloud-00006.ply"), 10);
}

TEST(Cloud, TheEndAndGapsOfTheLeftViewDoNotBlock) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  const Stopwatch time;
  gst_harness_push_event(harness.left(), gst_event_new_gap(0, 2 * kFrame));
  EXPECT_EQ(harness.push_map(GstClockTime{0}), GST_FLOW_OK);
  std::thread later([&harness] {
    g_usleep(50'000);
    gst_harness_push_event(harness.left(), gst_event_new_eos());
  });
  EXPECT_EQ(harness.push_map(5 * kFrame), GST_FLOW_OK);
  later.join();
  EXPECT_EQ(harness.push_map(6 * kFrame), GST_FLOW_OK);
  EXPECT_LT(time.seconds(), 3);
  EXPECT_EQ(folder.files(), "cloud-00000.ply cloud-00001.ply cloud-00002.ply");
}

TEST(Cloud, AGapWithoutAnEndDoesNotBlock) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  const Stopwatch time;
  constexpr GstClockTime kLast = GST_CLOCK_TIME_NONE - 1;
  gst_harness_push_event(harness.left(), gst_event_new_gap(kFrame, kLast));
  constexpr std::array<GstClockTime, 3> kMaps = {0, kFrame, 3600 * GST_SECOND};
  for (const GstClockTime map : kMaps) EXPECT_EQ(harness.push_map(map), GST_FLOW_OK);
  EXPECT_LT(time.seconds(), 3);
  EXPECT_EQ(folder.files(), "cloud-00000.ply cloud-00001.ply cloud-00002.ply");
}

TEST(Cloud, TheLeftViewWaitsForTheMaps) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  std::vector<GstClockTime> times;
  for (int i = 0; i < 40; ++i) times.push_back(static_cast<GstClockTime>(i) * kFrame);
  std::thread left = harness.push_left_later(times);
  for (int i = 0; i < 40; ++i) {
    g_usleep(2'000);
    ASSERT_EQ(harness.push_map(times[static_cast<std::size_t>(i)]), GST_FLOW_OK);
  }
  left.join();
  for (int i = 0; i < 40; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "cloud-%05d.ply", i);
    EXPECT_EQ(first_red(folder / name), i);
  }
}

TEST(Cloud, TheLeftViewDoesNotWaitForEverWithoutMaps) {
  const CloudFolder folder;
  CloudHarness harness(location(folder) + " timeout=300000000");
  ASSERT_EQ(harness.push_map(GstClockTime{0}), GST_FLOW_OK);  // prerolls without a left frame
  const Stopwatch time;
  for (int i = 1; i < 100; ++i) {
    ASSERT_EQ(harness.push_left(static_cast<GstClockTime>(i) * kFrame, i), GST_FLOW_OK);
  }
  EXPECT_LT(time.seconds(), 2);
  EXPECT_EQ(harness.push_map(99 * kFrame), GST_FLOW_OK);
  EXPECT_EQ(first_red(folder / "cloud-00001.ply"), 99) << "the newest frames are kept";
  std::vector<GstClockTime> times;
  for (GstClockTime i = 100; i < 120; ++i) times.push_back(i * kFrame);
  std::thread left = harness.push_left_later(times);
  g_usleep(20'000);
  EXPECT_EQ(harness.push_map(times[0]), GST_FLOW_OK);
  EXPECT_EQ(first_red(folder / "cloud-00002.ply"), 0) << "it waits again";
  gst_harness_push_event(harness.maps(), gst_event_new_eos());
  left.join();
}

TEST(Cloud, TheEndOfTheMapsReleasesTheLeftView) {
  const CloudFolder folder;
  CloudHarness harness(location(folder) + " timeout=60000000000");
  std::thread left = harness.push_left_later(std::vector<GstClockTime>(100, kFrame));
  g_usleep(50'000);
  gst_harness_push_event(harness.maps(), gst_event_new_eos());
  left.join();  // the watchdog of the tests would stop it
  EXPECT_TRUE(next_message(harness.bus(), GST_MESSAGE_EOS, 5));
}

void begin_segment(GstHarness* harness) {
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  gst_harness_push_event(harness, gst_event_new_segment(&segment));
}

TEST(Cloud, FlushesAndStopsReleaseTheLeftView) {
  const CloudFolder folder;
  CloudHarness harness(location(folder) + " timeout=60000000000");
  std::thread left = harness.push_left_later(std::vector<GstClockTime>(100, kFrame));
  g_usleep(50'000);
  gst_harness_push_event(harness.left(), gst_event_new_flush_start());
  left.join();
  gst_harness_push_event(harness.left(), gst_event_new_flush_stop(TRUE));
  begin_segment(harness.left());
  left = harness.push_left_later(std::vector<GstClockTime>(100, kFrame));
  g_usleep(50'000);
  gst_element_set_state(harness.element(), GST_STATE_READY);
  left.join();
}

TEST(Cloud, ASeekAfterTheEndBeginsAnew) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  for (const int last : {1, 2}) {
    std::thread later = push_left_soon(harness, 0, last);
    EXPECT_EQ(harness.push_map(GstClockTime{0}), GST_FLOW_OK);
    later.join();
    if (last == 1) {
      gst_harness_push_event(harness.left(), gst_event_new_gap(kFrame, 9 * kFrame));
    } else {
      gst_harness_push_event(harness.left(), gst_event_new_eos());
    }
    gst_harness_push_event(harness.maps(), gst_event_new_eos());
    for (GstHarness* each : {harness.left(), harness.maps()}) {
      gst_harness_push_event(each, gst_event_new_flush_start());
      gst_harness_push_event(each, gst_event_new_flush_stop(TRUE));
      begin_segment(each);
    }
  }
  std::thread later = push_left_soon(harness, 0, 3);
  EXPECT_EQ(harness.push_map(GstClockTime{0}), GST_FLOW_OK);
  later.join();
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(first_red(folder / ("cloud-0000" + std::to_string(i) + ".ply")), 1 + i);
  }
}

TEST(Cloud, AFlushInterruptsTheWaitForALeftFrame) {
  const CloudFolder folder;
  CloudHarness harness(location(folder) + " timeout=60000000000");
  GstFlowReturn flow = GST_FLOW_OK;
  std::thread maps([&] { flow = harness.push_map(GstClockTime{0}); });
  g_usleep(50'000);
  gst_harness_push_event(harness.maps(), gst_event_new_flush_start());
  maps.join();
  EXPECT_EQ(flow, GST_FLOW_FLUSHING);
  EXPECT_EQ(folder.files(), "");
}

TEST(Cloud, WritesEveryNthMap) {
  const CloudFolder folder;
  CloudHarness harness(location(folder) + " every-nth=3", false);
  for (int i = 0; i < 7; ++i) harness.push_map(static_cast<GstClockTime>(i) * kFrame);
  EXPECT_EQ(folder.files(), "cloud-00000.ply cloud-00003.ply cloud-00006.ply");
}

TEST(Cloud, WithoutANumberTheLastFileRemains) {
  const CloudFolder folder;
  CloudHarness harness(location(folder, "cloud.ply"));
  for (int i = 0; i < 3; ++i) {
    harness.push_left(static_cast<GstClockTime>(i) * kFrame, i);
    EXPECT_EQ(harness.push_map(static_cast<GstClockTime>(i) * kFrame), GST_FLOW_OK);
  }
  EXPECT_EQ(folder.files(), "cloud.ply");
  EXPECT_EQ(first_red(folder / "cloud.ply"), 2);
}

TEST(Cloud, LeavesOutPointsByTheProperties) {
  const CloudFolder folder;
  const auto count = [&](const std::string& properties, bool confidence) {
    CloudHarness harness(location(folder, "cloud.ply") + " " + properties, false);
    Map16 map = cloud_map();
    map.values[1] = 256;  // 50 m
    GstBuffer* buffer = map_buffer(map);
    std::vector<std::uint8_t> sure(map.values.size(), 200);
    sure[2] = 20;
    if (confidence) attach_confidence(buffer, kCloudWidth, kCloudHeight, sure);
    EXPECT_EQ(harness.push_map(buffer), GST_FLOW_OK);
    return read_ply(folder / "cloud.ply").size();
  };
  EXPECT_EQ(count("", true), kPoints);
  EXPECT_EQ(count("far=20", true), kPoints - 1);
  EXPECT_EQ(count("near=6", true), 1u);
  EXPECT_EQ(count("min-confidence=100", true), kPoints - 1);
  EXPECT_EQ(count("step=2", false), 3u * 2 - 1);
  EXPECT_EQ(count("focal-length=10 far=1", false), kPoints - 1) << "5 m become 0.5 m, 50 m 5 m";
}

TEST(Cloud, TheFormatIsThatOfTheExtensionOrOfTheProperty) {
  const CloudFolder folder;
  const auto begin_of = [&](const std::string& name, const std::string& properties) {
    CloudHarness harness(location(folder, name) + properties, false);
    EXPECT_EQ(harness.push_map(GstClockTime{0}), GST_FLOW_OK);
    std::string word(4, ' ');
    gchar* text = nullptr;
    EXPECT_TRUE(g_file_get_contents((folder / name).c_str(), &text, nullptr, nullptr));
    if (text != nullptr) word.assign(text, 4);
    g_free(text);
    return word;
  };
  EXPECT_EQ(begin_of("a.ply", ""), "ply\n");
  EXPECT_EQ(begin_of("a.PCD", ""), "# .P");
  EXPECT_EQ(begin_of("a.points", " format=pcd"), "# .P");
  EXPECT_EQ(begin_of("b.pcd", " format=ply"), "ply\n");
}

TEST(Cloud, PostsAMessageForEachFile) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  harness.push_left(0, 3);
  harness.push_map(GstClockTime{0});
  harness.push_left(2 * kFrame, 3);
  harness.push_map(2 * kFrame);
  for (guint64 i = 0; i < 2; ++i) {
    const MessagePointer message = next_message(harness.bus(), GST_MESSAGE_ELEMENT);
    ASSERT_TRUE(message);
    const GstStructure* fields = gst_message_get_structure(message.get());
    EXPECT_STREQ(gst_structure_get_name(fields), "mtstereo-cloud");
    const std::string name = gst_structure_get_string(fields, "filename");
    EXPECT_EQ(name, (folder / ("cloud-0000" + std::to_string(i) + ".ply")).string());
    guint64 points = 0;
    guint64 frame = 0;
    guint64 time = 0;
    gboolean colored = FALSE;
    EXPECT_TRUE(gst_structure_get(fields, "points", G_TYPE_UINT64, &points, "frame", G_TYPE_UINT64,
                                  &frame, "running-time", G_TYPE_UINT64, &time, "colored",
                                  G_TYPE_BOOLEAN, &colored, nullptr));
    EXPECT_EQ(points, kPoints);
    EXPECT_EQ(frame, i);
    EXPECT_EQ(time, 2 * i * kFrame);
    EXPECT_TRUE(colored);
  }
}

TEST(Cloud, NamesAFileThatIsNotUtf8) {
  const CloudFolder folder;
  std::filesystem::create_directory(folder / "bad\xff");
  Pipeline pipeline("videotestsrc num-buffers=1 ! " + raw_caps("GRAY16_LE", 64, 48) +
                    " ! mtcloud name=c focal-length=100 baseline=0.1");
  g_object_set(pipeline.named("c"), "location", (folder / "bad\xff/a-%d.ply").c_str(), nullptr);
  GstBus* bus = gst_element_get_bus(pipeline.element());
  pipeline.set_state(GST_STATE_PLAYING);
  const MessagePointer message = next_message(bus, GST_MESSAGE_ELEMENT, 20);
  gst_object_unref(bus);
  ASSERT_TRUE(message);
  const GstStructure* fields = gst_message_get_structure(message.get());
  const char* name = gst_structure_get_string(fields, "filename");
  ASSERT_NE(name, nullptr);
  EXPECT_EQ(name, (folder / "bad\\xff/a-0.ply").string());
}

TEST(Cloud, ReadsMapsAtOddAddresses) {
  const CloudFolder folder;
  CloudHarness harness(location(folder), false);
  ASSERT_EQ(harness.push_map(map_buffer(cloud_map(), 0, 3, 1)), GST_FLOW_OK);
  const std::vector<PlyPoint> points = read_ply(folder / "cloud-00000.ply");
  ASSERT_EQ(points.size(), kPoints);
  for (const PlyPoint& point : points) EXPECT_EQ(point.z, 5);
}

}  // namespace
}  // namespace mtstereo::test::mtcloud_test
