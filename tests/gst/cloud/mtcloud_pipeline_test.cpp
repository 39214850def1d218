// SPDX-License-Identifier: LGPL-2.1-or-later
// mtcloud downstream of mtstereo, with a branch for the left view.
#include <gtest/gtest.h>

#include <atomic>

#include "cloud/cloud_harness.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::mtcloud_pipeline_test {
namespace {

/// A launch line with a tee for both branches of the left view. The mtcloud is named c.
std::string launch(const std::string& properties, int frames, const std::string& size = "160x120") {
  const std::size_t x = size.find('x');
  return "videotestsrc pattern=smpte num-buffers=" + std::to_string(frames) +
         " ! video/x-raw,format=GRAY8,framerate=30/1,width=" + size.substr(0, x) +
         ",height=" + size.substr(x + 1) +
         " ! tee name=t t. ! queue ! videobox left=4 right=-4 ! m.sink_right "
         "t. ! queue ! tee name=l l. ! queue ! m.sink_left l. ! queue ! c.sink_left "
         "mtstereo name=m max-disparity=16 preset=fast alignment=off ! "
         "mtcloud name=c focal-length=100 baseline=0.1 " +
         properties;
}

/// Collects the messages about files.
class FileMessages {
 public:
  explicit FileMessages(const Pipeline& pipeline) {
    GstBus* bus = gst_element_get_bus(pipeline.element());
    gst_bus_set_sync_handler(bus, take, this, nullptr);
    gst_object_unref(bus);
  }
  int files() const { return files_; }
  int colored() const { return colored_; }
  /// Waits until so many more files are written; false if they are not.
  bool wait_for_more(int count) const {
    const int end = files_ + count;
    for (int i = 0; i < 20'000 && files_ < end; ++i) g_usleep(1000);
    return files_ >= end;
  }

 private:
  static GstBusSyncReply take(GstBus*, GstMessage* message, gpointer self) {
    const GstStructure* fields = gst_message_get_structure(message);
    if (fields != nullptr && gst_structure_has_name(fields, "mtstereo-cloud")) {
      gboolean colored = FALSE;
      gst_structure_get_boolean(fields, "colored", &colored);
      ++static_cast<FileMessages*>(self)->files_;
      if (colored == TRUE) ++static_cast<FileMessages*>(self)->colored_;
    }
    return GST_BUS_PASS;
  }

  std::atomic<int> files_{0};
  std::atomic<int> colored_{0};
};

int count_files(const CloudFolder& folder) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    count += entry.is_regular_file() ? 1 : 0;
  }
  return count;
}

TEST(CloudPipeline, WritesEveryMapWithItsLeftFrame) {
  const CloudFolder folder;
  {
    Pipeline pipeline(launch("location=" + (folder / "%03d.ply").string(), 40));
    EXPECT_EQ(pipeline.run(), "");
  }
  EXPECT_EQ(count_files(folder), 40);
  for (int i : {0, 17, 39}) {
    char name[16];
    std::snprintf(name, sizeof name, "%03d.ply", i);
    const auto points = read_ply(folder / name);
    EXPECT_GT(points.size(), 1000u);
    for (const PlyPoint& point : points) ASSERT_EQ(point.red, point.green);
  }
}

TEST(CloudPipeline, CanBePausedAndSeeked) {
  const CloudFolder folder;
  // The source counts its frames over all seeks, so that a small number would end it.
  Pipeline pipeline(launch("location=" + (folder / "%04d.ply").string(), 100000));
  const FileMessages messages(pipeline);
  pipeline.set_state(GST_STATE_PAUSED);
  ASSERT_TRUE(pipeline.wait_until_settled());
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(pipeline.seek(static_cast<GstClockTime>(i) * GST_SECOND / 4,
                              static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH)));
    ASSERT_TRUE(pipeline.wait_until_settled());
    pipeline.set_state(GST_STATE_PLAYING);
    ASSERT_TRUE(pipeline.wait_until_settled());
    ASSERT_TRUE(messages.wait_for_more(3));
    pipeline.set_state(GST_STATE_PAUSED);
    ASSERT_TRUE(pipeline.wait_until_settled());
  }
  pipeline.set_state(GST_STATE_NULL);
  EXPECT_EQ(messages.files(), messages.colored());
  EXPECT_EQ(messages.files(), count_files(folder)) << "the numbers continue after a seek";
}

TEST(CloudPipeline, CanBeStoppedAtAnyTime) {
  const CloudFolder folder;
  for (const int wait : {0, 1, 5, 20, 60}) {
    Pipeline pipeline(launch("location=" + (folder / "%04d.ply").string(), 1000));
    pipeline.set_state(GST_STATE_PLAYING);
    g_usleep(static_cast<gulong>(wait) * 1000);
    pipeline.set_state(GST_STATE_NULL);
  }
}

TEST(CloudPipeline, PlaysTwice) {
  const CloudFolder folder;
  Pipeline pipeline(launch("location=" + (folder / "%04d.ply").string(), 5));
  EXPECT_EQ(pipeline.run(), "");
  pipeline.set_state(GST_STATE_READY);
  std::filesystem::remove(folder / "0003.ply");
  EXPECT_EQ(pipeline.run(), "");
  EXPECT_EQ(count_files(folder), 5) << "the numbers start again";
}

TEST(CloudPipeline, ALeftViewWithoutQueueFailsByTimeoutsOnly) {
  // Without a queue the tee blocks the matcher while the left view waits for it.
  const CloudFolder folder;
  Pipeline pipeline(
      "videotestsrc num-buffers=30 ! video/x-raw,format=GRAY8,width=160,height=120 ! tee name=t "
      "t. ! c.sink_left t. ! queue ! m.sink_left t. ! queue ! videobox left=4 right=-4 ! "
      "m.sink_right mtstereo name=m max-disparity=16 preset=fast alignment=off ! "
      "mtcloud name=c focal-length=100 baseline=0.1 timeout=50000000 location=" +
      (folder / "%04d.ply").string());
  EXPECT_EQ(pipeline.run(), "");
  EXPECT_EQ(count_files(folder), 30);
}

}  // namespace
}  // namespace mtstereo::test::mtcloud_pipeline_test
