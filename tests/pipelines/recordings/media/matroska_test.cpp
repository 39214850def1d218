// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/matroska.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "lib/outputs/user_error.hpp"
#include "recordings/media/gst_objects.hpp"
#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::matroska_test {
namespace {

namespace fs = std::filesystem;
using testing::bytes_of;
using testing::TemporaryFolder;

constexpr Nanoseconds kPeriod = 40'000'000;

MatroskaTrack track() {
  return {160,
          96,
          kPeriod,
          std::string(200, 'c'),
          {{"MTSTEREO_A", "1"}, {"MTSTEREO_B", std::string(300, 'b')}}};
}

std::string frame(int number) {
  return std::string(1000 + static_cast<std::size_t>(number), static_cast<char>('a' + number % 26));
}

// The frames first .. end - 1.
void append(MatroskaWriter& writer, int first, int end) {
  for (int i = first; i < end; ++i) writer.append(i * kPeriod, frame(i));
}

fs::path write(const fs::path& file, int first, int end) {
  MatroskaWriter writer(file, track());
  append(writer, first, end);
  writer.finish();
  return file;
}

TEST(Matroska, DependsOnItsFramesOnly) {
  const TemporaryFolder folder;
  EXPECT_EQ(bytes_of(write(folder / "a.mkv", 0, 100)), bytes_of(write(folder / "b.mkv", 0, 100)));
}

TEST(Matroska, IsReadBack) {
  const TemporaryFolder folder;
  MatroskaReader reader(write(folder / "a.mkv", 5, 75));
  EXPECT_EQ(reader.track(), track());
  for (int i = 5; i < 75; ++i) {
    const std::optional<MatroskaReader::Cluster> cluster = reader.next();
    ASSERT_TRUE(cluster) << i;
    EXPECT_EQ(cluster->time, i * kPeriod);
    EXPECT_EQ(cluster->bytes.substr(28), frame(i));
  }
  EXPECT_FALSE(reader.next());
}

TEST(Matroska, OfJoinedClustersIsThatOfAllFrames) {
  const TemporaryFolder folder;
  const fs::path pieces[] = {write(folder / "1.mkv", 0, 40), write(folder / "2.mkv", 40, 41),
                             write(folder / "3.mkv", 41, 100)};
  MatroskaWriter writer(folder / "joined.mkv", track());
  for (const fs::path& piece : pieces) {
    MatroskaReader reader(piece);
    while (const auto cluster = reader.next()) writer.append_cluster(cluster->time, cluster->bytes);
  }
  writer.finish();
  EXPECT_EQ(bytes_of(folder / "joined.mkv"), bytes_of(write(folder / "whole.mkv", 0, 100)));
}

TEST(Matroska, IsContinuedAfterItsWholeFrames) {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.mkv";
  {
    MatroskaWriter writer(file, track());
    append(writer, 0, 50);
    writer.flush();
  }
  std::ofstream(file, std::ios::app) << "a part of a frame";
  MatroskaWriter writer(file, 48);
  append(writer, 48, 100);
  writer.finish();
  EXPECT_EQ(bytes_of(file), bytes_of(write(folder / "whole.mkv", 0, 100)));
}

TEST(Matroska, WithTooFewFramesIsNotContinued) {
  const TemporaryFolder folder;
  write(folder / "a.mkv", 0, 10);
  EXPECT_THROW(MatroskaWriter(folder / "a.mkv", 11), UserError);
}

TEST(Matroska, WithoutTagsIsReadBack) {
  const TemporaryFolder folder;
  MatroskaTrack plain = track();
  plain.tags.clear();
  {
    MatroskaWriter writer(folder / "a.mkv", plain);
    append(writer, 0, 3);
    writer.finish();
  }
  MatroskaReader reader(folder / "a.mkv");
  EXPECT_EQ(reader.track(), plain);
  EXPECT_TRUE(reader.next());
}

TEST(Matroska, ThatEndsInItsHeadIsRefused) {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(write(folder / "a.mkv", 0, 1));
  const std::size_t head = bytes.find("\x1f\x43\xb6\x75");
  ASSERT_NE(head, std::string::npos);
  testing::write_text(folder / "cut.mkv", bytes.substr(0, head));
  EXPECT_FALSE(MatroskaReader(folder / "cut.mkv").next());
  for (const std::size_t length : {head - 1, head - 150, head - 400, std::size_t{60}}) {
    testing::write_text(folder / "cut.mkv", bytes.substr(0, length));
    EXPECT_THROW(MatroskaReader(folder / "cut.mkv"), UserError) << length;
  }
}

TEST(Matroska, OfAnotherProgramIsRefused) {
  const TemporaryFolder folder;
  testing::write_view(folder / "other.mkv", testing::View::kLeft, "avenc_ffv1 ! matroskamux",
                      testing::constant_times(3));
  testing::write_text(folder / "text.mkv", "no video");
  testing::write_text(folder / "empty.mkv", "");
  for (const char* const name : {"other.mkv", "text.mkv", "empty.mkv", "missing.mkv"}) {
    EXPECT_THROW(MatroskaReader(folder / name), UserError) << name;
  }
}

TEST(Matroska, ThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(MatroskaWriter("/proc/no/such/file.mkv", track()), UserError);
  if (fs::exists("/dev/full")) {
    EXPECT_THROW(
        {
          MatroskaWriter writer("/dev/full", track());
          append(writer, 0, 100);
          writer.flush();
        },
        UserError);
  }
}

TEST(Matroska, IsIndexedForSeeks) {
  const TemporaryFolder folder;
  const fs::path file = write(folder / "a.mkv", 0, 100);
  const Pipeline pipeline = parse_pipeline("filesrc location=" + file.string() +
                                           " ! matroskademux ! appsink name=out sync=false");
  const ElementPointer sink = element_of(pipeline, "out");
  gst_element_set_state(pipeline.get(), GST_STATE_PAUSED);
  ASSERT_EQ(gst_element_get_state(pipeline.get(), nullptr, nullptr, 10 * GST_SECOND),
            GST_STATE_CHANGE_SUCCESS);
  gint64 duration = 0;
  ASSERT_TRUE(gst_element_query_duration(pipeline.get(), GST_FORMAT_TIME, &duration));
  EXPECT_EQ(duration, 100 * kPeriod);
  ASSERT_TRUE(gst_element_seek_simple(
      pipeline.get(), GST_FORMAT_TIME,
      static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH | GST_SEEK_FLAG_KEY_UNIT), 67 * kPeriod));
  gst_element_set_state(pipeline.get(), GST_STATE_PLAYING);
  const SamplePointer sample(
      gst_app_sink_try_pull_sample(GST_APP_SINK(sink.get()), 10 * GST_SECOND));
  ASSERT_TRUE(sample);
  // That of the last entry of the index before.
  EXPECT_EQ(GST_BUFFER_PTS(gst_sample_get_buffer(sample.get())),
            static_cast<GstClockTime>(64 * kPeriod));
}

}  // namespace
}  // namespace mtstereo::run::matroska_test
