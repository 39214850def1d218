// SPDX-License-Identifier: LGPL-2.1-or-later
#include "products.hpp"

#include <cstring>

namespace mtstereo::run {

namespace fs = std::filesystem;
using testing::bytes_of;
using testing::frames_of;
using testing::kStereoHeight;
using testing::kStereoWidth;
using testing::View;
using testing::write_view;

testing::TemporaryFolder* Products::folder_ = nullptr;
std::map<std::string, std::vector<std::string>> Products::expected_;

void Products::SetUpTestSuite() {
  folder_ = new testing::TemporaryFolder;
  const std::string coding = testing::kBFrames + std::string(" ! matroskamux");
  write_view(*folder_ / "left.mkv", View::kLeft, coding, testing::constant_times(kFrames));
  write_view(*folder_ / "right.mkv", View::kRight, coding, testing::constant_times(kFrames));
  testing::write_stereo_calibration(folder_->path());
}

void Products::TearDownTestSuite() {
  expected_.clear();
  delete folder_;
}

fs::path Products::make(const std::vector<Product>& products, MapFormat format) {
  WorkOptions options;
  options.products = products;
  options.format = format;
  Work work = testing::work_of(file("left.mkv"), file("right.mkv"), options);
  work.recording.calibration = file("calib.txt").string();
  const fs::path results = file("results");
  process(work, testing::whole(work), results, kNoProgress, Existing::kReplace);
  return results;
}

const std::vector<std::string>& Products::expected(const std::string& downstream) {
  std::vector<std::string>& frames = expected_[downstream];
  if (frames.empty()) {
    frames = frames_of(testing::matcher_line(file("left.mkv"), file("right.mkv"), "") + " ! " +
                       downstream + " ! appsink name=out sync=false");
  }
  return frames;
}

std::string joined(const std::vector<std::string>& frames) {
  std::string all;
  for (const std::string& frame : frames) all += frame;
  return all;
}

std::string by_gstreamer(const fs::path& video, const std::string& format) {
  return joined(
      frames_of("filesrc location=\"" + video.string() + "\" ! matroskademux ! avdec_ffv1 ! " +
                (format.empty() ? "" : "videoconvert ! video/x-raw,format=" + format + " ! ") +
                "appsink name=out sync=false"));
}

std::vector<float> read_pfm(const fs::path& file) {
  const std::string bytes = bytes_of(file), head = "Pf\n160 96\n-1.0\n";
  EXPECT_EQ(bytes.substr(0, head.size()), head);
  EXPECT_EQ(bytes.size(), head.size() + 4 * kPixels);
  std::vector<float> values(kPixels);
  for (std::size_t y = 0; y < kStereoHeight; ++y) {
    const std::size_t from = head.size() + 4 * kStereoWidth * (kStereoHeight - 1 - y);
    std::memcpy(values.data() + y * kStereoWidth, bytes.data() + from, 4 * kStereoWidth);
  }
  return values;
}

}  // namespace mtstereo::run
