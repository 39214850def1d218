// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/cloud_harness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

namespace mtstereo::test {

std::vector<PlyPoint> read_ply(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t header = text.find("end_header\n");
  const std::size_t count = text.find("element vertex ");
  std::vector<PlyPoint> points;
  if (header == std::string::npos || count == std::string::npos) {
    ADD_FAILURE() << file << " is no PLY file";
    return points;
  }
  points.resize(std::stoul(text.substr(count + 15)));
  static_assert(sizeof(PlyPoint) == 16);
  const std::size_t begin = header + 11;
  if (text.size() != begin + points.size() * sizeof(PlyPoint)) {
    ADD_FAILURE() << file << " has " << text.size() << " bytes";
    return points;
  }
  if (!points.empty()) std::memcpy(points.data(), text.data() + begin, text.size() - begin);
  return points;
}

int first_red(const std::filesystem::path& file) {
  const std::vector<PlyPoint> points = read_ply(file);
  return points.empty() ? -1 : points.front().red;
}

std::string CloudFolder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path())) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::string location(const CloudFolder& folder, const std::string& name) {
  return "location=" + (folder / name).string();
}

Map16 cloud_map() {
  Map16 map = {kCloudWidth, kCloudHeight,
               std::vector<std::uint16_t>(std::size_t{kCloudWidth} * kCloudHeight, 2560)};
  map.values[0] = 0;
  return map;
}

CloudHarness::CloudHarness(const std::string& properties, bool left) {
  element_ = make_element(properties, "mtcloud");
  bus_ = gst_bus_new();
  gst_element_set_bus(element_, bus_);
  maps_ = gst_harness_new_with_element(element_, "sink", nullptr);
  gst_harness_set_src_caps_str(
      maps_, (raw_caps("GRAY16_LE", kCloudWidth, kCloudHeight) +
              ",disparity-scale=256,max-disparity=64,focal-length=(double)100,baseline=(double)0.5")
                 .c_str());
  if (!left) return;
  left_ = gst_harness_new_with_element(element_, "sink_left", nullptr);
  gst_harness_set_src_caps_str(left_, raw_caps("RGB", kCloudWidth, kCloudHeight).c_str());
}

CloudHarness::~CloudHarness() {
  gst_element_set_bus(element_, nullptr);
  gst_element_set_state(element_, GST_STATE_NULL);
  if (left_ != nullptr) gst_harness_teardown(left_);
  gst_harness_teardown(maps_);
  gst_object_unref(element_);
  gst_object_unref(bus_);
}

GstFlowReturn CloudHarness::push_left(GstClockTime pts, int red) {
  constexpr int kStride = GST_ROUND_UP_4(3 * kCloudWidth);
  std::vector<std::uint8_t> bytes(std::size_t{kStride} * kCloudHeight);
  for (int y = 0; y < kCloudHeight; ++y) {
    for (int i = 0; i < 3 * kCloudWidth; ++i) {
      bytes[static_cast<std::size_t>(y * kStride + i)] =
          static_cast<std::uint8_t>(red * (i % 3 + 1));
    }
  }
  GstBuffer* buffer = gst_buffer_new_memdup(bytes.data(), bytes.size());
  GST_BUFFER_PTS(buffer) = pts;
  return gst_harness_push(left_, buffer);
}

std::thread CloudHarness::push_left_later(std::vector<GstClockTime> times) {
  return std::thread([this, times = std::move(times)] {
    int red = 0;
    for (const GstClockTime time : times) {
      if (push_left(time, red++) != GST_FLOW_OK) return;
    }
  });
}

}  // namespace mtstereo::test
