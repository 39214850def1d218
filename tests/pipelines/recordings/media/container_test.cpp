// SPDX-License-Identifier: LGPL-2.1-or-later
// Damage that the containers of videos show, and none in whole files.
#include "recordings/media/container.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "recordings/media/frame_index.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::container_test {
namespace {

namespace fs = std::filesystem;
using testing::constant_times;
using ::testing::HasSubstr;
using testing::kBFrames;
using testing::run_command;
using testing::TemporaryFolder;
using testing::write_text;
using testing::write_video;

constexpr int kFrames = 90;
constexpr std::size_t kPacket = 188;

std::string bytes_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Muxer {
  const char* file;
  std::string coding;
  int noticed;  // of eight erased blocks, at least
};

void PrintTo(const Muxer& muxer, std::ostream* out) { *out << muxer.file; }

class ContainerChecks : public ::testing::TestWithParam<Muxer> {
 protected:
  void SetUp() override {
    write_video(file_, GetParam().coding, constant_times(kFrames));
    bytes_ = bytes_of_file(file_);
    ASSERT_GT(bytes_.size(), 20 * kPacket);
  }
  std::string damage_with(const std::string& bytes) {
    write_text(file_, bytes);
    return damaged_parts(file_);
  }

  TemporaryFolder folder_;
  const fs::path file_ = folder_ / GetParam().file;
  std::string bytes_;
};

TEST_P(ContainerChecks, WholeFileShowsNothing) {
  EXPECT_EQ(damaged_parts(file_), "");
  EXPECT_EQ(missing_end(file_), "");
}

// FLV has no checksums: what hits the data of a frame alone is not noticed.
TEST_P(ContainerChecks, ErasedBytesAreNoticed) {
  constexpr std::size_t kBlock = 1024;  // longer than most frames
  int noticed = 0;
  for (std::size_t i = 1; i < 9; ++i) {
    std::string bytes = bytes_;
    bytes.replace(bytes_.size() * i / 10, kBlock, kBlock, '\0');
    const std::string damage = damage_with(bytes);
    noticed += !damage.empty();
    EXPECT_TRUE(damage.empty() || damage.starts_with("the file is damaged in ")) << damage;
  }
  EXPECT_GE(noticed, GetParam().noticed);
}

TEST_P(ContainerChecks, MissingBytesAreNoticed) {
  std::string bytes = bytes_;
  bytes.erase(bytes.size() / 2 / kPacket * kPacket, 3 * kPacket);
  const std::string damage = damage_with(bytes);
  EXPECT_NE(damage + missing_end(file_), "");
}

TEST_P(ContainerChecks, CutFileIsNoticed) {
  write_text(file_, bytes_.substr(0, bytes_.size() / 3 * 2 + 1));
  EXPECT_NE(missing_end(file_), "");
}

TEST_P(ContainerChecks, AnythingElseEndsTheCheck) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{4}, std::size_t{9}, kPacket * 4}) {
    for (const char fill : {'\0', '\xff', 'G'}) {
      damage_with(bytes_.substr(0, length) + std::string(3'000, fill));
      missing_end(file_);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Muxers, ContainerChecks,
                         ::testing::Values(Muxer{"a.mkv", std::string(kBFrames) + " ! matroskamux",
                                                 8},
                                           Muxer{"a.ts", std::string(kBFrames) + " ! mpegtsmux", 8},
                                           Muxer{"a.ogv", "theoraenc ! oggmux max-page-delay=0", 8},
                                           Muxer{"a.flv", std::string(kBFrames) + " ! flvmux", 2}),
                         [](const auto& info) { return std::string(info.param.file).substr(2); });

TEST(MatroskaChecksum, ShowsASingleBit) {
  if (!testing::have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder folder;
  const fs::path file = folder / "a.mkv";
  run_command(
      "ffmpeg -v error -f lavfi -i testsrc=size=64x48:rate=30:duration=2,noise=alls=40:allf=t "
      "-c:v ffv1 -level 1 '" +
      file.string() + "'");
  EXPECT_EQ(damaged_parts(file), "");
  std::string bytes = bytes_of_file(file);
  bytes[bytes.size() / 2] ^= 1;
  write_text(file, bytes);
  EXPECT_THAT(damaged_parts(file), HasSubstr("1 place, the first one at byte "));
  EXPECT_THAT(index_frames({file, {}, {}}, 0).damage, HasSubstr("does not have the checksum"));
}

// The size of a frame is in a table of the file, which no decoder sees.
TEST(Mp4Table, ShowsFramesThatAreTooLarge) {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.mp4";
  write_video(file, std::string(kBFrames) + " ! mp4mux", constant_times(kFrames));
  EXPECT_EQ(damaged_parts(file), "");
  const std::string bytes = bytes_of_file(file);
  const std::size_t table = bytes.find("stsz");
  ASSERT_NE(table, std::string::npos);
  constexpr std::size_t kTenth = 16 + 10 * 4;  // version, common size, number, sizes
  std::string damaged = bytes;
  damaged[table + kTenth + 1] ^= 0x08;
  write_text(file, damaged);
  EXPECT_THAT(damaged_parts(file), HasSubstr("frames have more bytes than the file"));
  EXPECT_LT(index_frames({file, {}, {}}, 0).times.size(), std::size_t{kFrames} / 2);
  for (const std::size_t end : {table, table + 4, table + 20, bytes.size() - 1}) {
    write_text(file, bytes.substr(0, end));
    EXPECT_EQ(damaged_parts(file), "");  // missing_end() states it
    EXPECT_NE(missing_end(file), "");
  }
}

// Two recordings in one file, as cat writes them.
TEST(TransportStream, JoinedFilesAreNotDamaged) {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.ts";
  for (const int frames : {10, 23, 47}) {
    write_video(file, std::string(kBFrames) + " ! mpegtsmux", constant_times(frames));
    const std::string bytes = bytes_of_file(file);
    write_text(file, bytes + bytes + bytes);
    EXPECT_EQ(damaged_parts(file), "") << frames;
  }
}

TEST(TransportStream, MissingPacketsOfTheVideoAreNoticed) {
  constexpr int kVideo = 65;  // its PID
  const TemporaryFolder folder;
  const fs::path file = folder / "a.ts";
  write_video(file, std::string(kBFrames) + " ! mpegtsmux", constant_times(kFrames));
  const std::string bytes = bytes_of_file(file);
  int noticed = 0, video = 0;
  for (std::size_t at = 4 * kPacket; at < bytes.size() - 3 * kPacket; at += kPacket) {
    if (bytes[at + 2] != kVideo) continue;
    ++video;
    std::string less = bytes;
    write_text(file, less.erase(at, kPacket));
    noticed += !damaged_parts(file).empty();
  }
  EXPECT_GT(video, kFrames);
  EXPECT_GE(noticed, video * 9 / 10);  // some counters are those of a file that starts
}

}  // namespace
}  // namespace mtstereo::run::container_test
