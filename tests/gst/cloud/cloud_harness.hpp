// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "support/map_harness.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::test {

/// A point of a PLY file.
struct PlyPoint {
  float x = 0;
  float y = 0;
  float z = 0;
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t confidence = 0;
};

/// The points of a PLY file of mtcloud; a failure if it is not one.
std::vector<PlyPoint> read_ply(const std::filesystem::path& file);

/// The number of the red component of the first point of a PLY file; -1 without a point.
int first_red(const std::filesystem::path& file);

/// A folder for the files of one test.
class CloudFolder : public TemporaryFolder {
 public:
  /// The names of the files, in order, separated by spaces.
  std::string files() const;
};

/// The property location for a pattern in this folder.
std::string location(const CloudFolder& folder, const std::string& name = "cloud-%05d.ply");

/// Size of the maps of CloudHarness [px].
inline constexpr int kCloudWidth = 6;
inline constexpr int kCloudHeight = 4;

/// A map whose pixels all have the disparity 10 px, except the first one, which has none.
Map16 cloud_map();

/// An mtcloud in PLAYING, with a harness for each pad.
class CloudHarness {
 public:
  /// `properties` as on a command line. The geometry of the maps is in their caps.
  explicit CloudHarness(const std::string& properties, bool left = true);
  ~CloudHarness();
  CloudHarness(const CloudHarness&) = delete;
  CloudHarness& operator=(const CloudHarness&) = delete;

  GstElement* element() const { return element_; }
  GstBus* bus() const { return bus_; }
  GstHarness* maps() const { return maps_; }
  GstHarness* left() const { return left_; }

  GstFlowReturn push_map(GstClockTime pts) { return push_map(map_buffer(cloud_map(), pts)); }
  GstFlowReturn push_map(GstBuffer* buffer) { return gst_harness_push(maps_, buffer); }
  /// Pushes an RGB frame of one color: red, 2 * red, 3 * red.
  GstFlowReturn push_left(GstClockTime pts, int red);
  /// Pushes left frames in a thread of its own: their red is their index.
  std::thread push_left_later(std::vector<GstClockTime> times);

 private:
  GstElement* element_ = nullptr;
  GstBus* bus_ = nullptr;
  GstHarness* maps_ = nullptr;
  GstHarness* left_ = nullptr;
};

}  // namespace mtstereo::test
