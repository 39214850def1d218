// SPDX-License-Identifier: LGPL-2.1-or-later
// The bytes of the files, and errors. read_clouds_test.py reads the files by other programs.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <filesystem>

#include "mtstereo/geometry/point_cloud.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::cloud_file_test {
namespace {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

const std::vector<CloudPoint> kTwo = {{1.5F, -2, 4, 10, 20, 30, 40}, {-0.25F, 0, 65, 1, 2, 3, 255}};

/// A value at a position of a file, as this processor reads it.
template <typename T>
T value_at(const std::string& bytes, std::size_t position) {
  T value{};
  if (position + sizeof value > bytes.size()) {
    ADD_FAILURE() << "the file ends before " << position;
    return value;
  }
  std::memcpy(&value, bytes.data() + position, sizeof value);
  return value;
}

std::string files_in(const TemporaryFolder& folder) {
  std::string names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names += entry.path().filename().string() + " ";
  }
  return names;
}

std::string error_of(const std::string& path, const std::vector<CloudPoint>& points = kTwo) {
  const Status status = write_cloud(points, CloudFormat::kPly, path);
  if (status.ok()) {
    ADD_FAILURE() << path << " was written";
    return "";
  }
  EXPECT_EQ(status.error().code, ErrorCode::kSystem);
  return status.error().message;
}

TEST(CloudFile, PlyHasUnitAxesAndPoints) {
  const TemporaryFolder folder;
  const std::string path = folder / "cloud.ply";
  ASSERT_TRUE(write_cloud(kTwo, CloudFormat::kPly, path).ok());
  const std::string text = read_text(path);
  for (const char* line : {"ply\nformat binary_little_endian 1.0\n", "\ncomment unit: meter\n",
                           "\ncomment axes of the left camera: x right, y down, z forward\n",
                           "\nelement vertex 2\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
  const std::size_t data = text.find("end_header\n") + 11;
  ASSERT_EQ(text.size(), data + 2 * 16);
  EXPECT_EQ(value_at<float>(text, data), 1.5F);
  EXPECT_EQ(value_at<float>(text, data + 4), -2);
  EXPECT_EQ(value_at<float>(text, data + 8), 4);
  EXPECT_EQ(value_at<std::uint32_t>(text, data + 12), 10U + (20U << 8) + (30U << 16) + (40U << 24));
  EXPECT_EQ(value_at<float>(text, data + 16), -0.25F);
}

TEST(CloudFile, PcdHasUnitAxesAndPoints) {
  const TemporaryFolder folder;
  const std::string path = folder / "cloud.pcd";
  ASSERT_TRUE(write_cloud(kTwo, CloudFormat::kPcd, path).ok());
  const std::string text = read_text(path);
  for (const char* line :
       {"\n# unit: meter\n", "\n# axes of the left camera: x right, y down, z forward\n",
        "\nWIDTH 2\nHEIGHT 1\n", "\nPOINTS 2\nDATA binary\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
  const std::size_t data = text.find("DATA binary\n") + 12;
  ASSERT_EQ(text.size(), data + 2 * 17);
  EXPECT_EQ(value_at<float>(text, data + 8), 4);
  EXPECT_EQ(value_at<std::uint32_t>(text, data + 12), (10U << 16) + (20U << 8) + 30U);
  EXPECT_EQ(value_at<std::uint8_t>(text, data + 16), 40);
  EXPECT_EQ(value_at<float>(text, data + 17), -0.25F);
}

TEST(CloudFile, OfNoPointsIsComplete) {
  const TemporaryFolder folder;
  for (const CloudFormat format : {CloudFormat::kPly, CloudFormat::kPcd}) {
    ASSERT_TRUE(write_cloud({}, format, folder / "empty").ok());
    const std::string text = read_text(folder / "empty");
    EXPECT_NE(text.find(format == CloudFormat::kPly ? "vertex 0\n" : "POINTS 0\n"),
              std::string::npos);
    EXPECT_EQ(text.back(), '\n');
  }
}

TEST(CloudFile, ReplacesItsOwnFilesAndLeavesNoOther) {
  const TemporaryFolder folder;
  write_text(folder / "cloud.ply", "");
  for (const CloudFormat format : {CloudFormat::kPly, CloudFormat::kPcd, CloudFormat::kPly}) {
    ASSERT_TRUE(write_cloud(kTwo, format, folder / "cloud.ply").ok());
  }
  EXPECT_EQ(read_text(folder / "cloud.ply").substr(0, 4), "ply\n");
  EXPECT_EQ(files_in(folder), "cloud.ply ");
}

TEST(CloudFile, ReplacesNoFileOfOthers) {
  const TemporaryFolder folder;
  const std::string path = folder / "scan.ply";
  for (const std::string text : {"x", "ply\nformat ascii 1.0\ncomment by another program\n"}) {
    write_text(path, text);
    const std::string message = error_of(path);
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_NE(message.find("did not write it"), std::string::npos) << message;
    EXPECT_EQ(read_text(path), text);
    EXPECT_EQ(files_in(folder), "scan.ply ");
  }
}

TEST(CloudFile, NamesAFolderThatDoesNotExist) {
  const std::string message = error_of("/no/such/folder/cloud.ply");
  EXPECT_NE(message.find("/no/such/folder/cloud.ply"), std::string::npos) << message;
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
}

TEST(CloudFile, ReplacesNeitherFoldersNorDevices) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "cloud.ply");
  test::make_pipe(folder / "pipe.ply");
  for (const std::string& path :
       {(folder / "cloud.ply").string(), (folder / "pipe.ply").string()}) {
    const std::string message = error_of(path);
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_NE(message.find("not a regular file"), std::string::npos) << message;
  }
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe.ply"));
}

/// Files of this process get no larger while this object lives; the next byte is an error.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(CloudFile, KeepsTheOlderFileIfThereIsNoSpace) {
  const TemporaryFolder folder;
  const std::string path = folder / "cloud.ply";
  ASSERT_TRUE(write_cloud(kTwo, CloudFormat::kPly, path).ok());
  const std::string older = read_text(path);
  const std::vector<CloudPoint> many(20000);
  for (const rlim_t bytes : {0, 100, 1000, 300000}) {
    std::string message;
    {
      const SizeLimit limit(bytes);
      message = error_of(path, many);
    }
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_NE(message.find("File too large"), std::string::npos) << message;
    EXPECT_EQ(read_text(path), older);
    EXPECT_EQ(files_in(folder), "cloud.ply ") << "the part must be removed";
  }
}

}  // namespace
}  // namespace mtstereo::cloud_file_test
