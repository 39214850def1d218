// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <bit>
#include <span>
#include <string_view>

#include "base/guard.hpp"
#include "geometry/new_file.hpp"
#include "mtstereo/geometry/point_cloud.hpp"

namespace mtstereo {
namespace {

constexpr std::size_t kPointsPerBlock = 4096;
constexpr std::size_t kPlyPoint = 3 * 4 + 4;  // [bytes]
constexpr std::size_t kPcdPoint = 3 * 4 + 5;  // [bytes]

/// In the header of each file: NewFile replaces only files with it.
constexpr std::string_view kWritten = "written by mtstereo";

std::string ply_header(std::size_t points) {
  return "ply\n"
         "format binary_little_endian 1.0\n"
         "comment " +
         std::string(kWritten) +
         "\n"
         "comment unit: meter\n"
         "comment axes of the left camera: x right, y down, z forward\n"
         "element vertex " +
         std::to_string(points) +
         "\n"
         "property float x\n"
         "property float y\n"
         "property float z\n"
         "property uchar red\n"
         "property uchar green\n"
         "property uchar blue\n"
         "property uchar confidence\n"
         "end_header\n";
}

std::string pcd_header(std::size_t points) {
  const std::string count = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\n"
         "# " +
         std::string(kWritten) +
         "\n"
         "# unit: meter\n"
         "# axes of the left camera: x right, y down, z forward\n"
         "VERSION 0.7\n"
         "FIELDS x y z rgb confidence\n"
         "SIZE 4 4 4 4 1\n"
         "TYPE F F F F U\n"
         "COUNT 1 1 1 1 1\n"
         "WIDTH " +
         count +
         "\n"
         "HEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\n"
         "POINTS " +
         count +
         "\n"
         "DATA binary\n";
}

/// Writes the bytes of a value, the least significant one first.
std::uint8_t* put(std::uint8_t* to, std::uint32_t value) {
  for (int byte = 0; byte < 4; ++byte) *to++ = static_cast<std::uint8_t>(value >> 8 * byte);
  return to;
}

std::uint8_t* put_position(std::uint8_t* to, const CloudPoint& point) {
  to = put(to, std::bit_cast<std::uint32_t>(point.x));
  to = put(to, std::bit_cast<std::uint32_t>(point.y));
  return put(to, std::bit_cast<std::uint32_t>(point.z));
}

std::uint8_t* put_ply(std::uint8_t* to, const CloudPoint& point) {
  to = put_position(to, point);
  for (const std::uint8_t value : {point.red, point.green, point.blue, point.confidence}) {
    *to++ = value;
  }
  return to;
}

std::uint8_t* put_pcd(std::uint8_t* to, const CloudPoint& point) {
  to = put_position(to, point);
  for (const std::uint8_t value :
       {point.blue, point.green, point.red, std::uint8_t{0}, point.confidence}) {
    *to++ = value;
  }
  return to;
}

Status write_points(NewFile& file, std::span<const CloudPoint> points, CloudFormat format) {
  const bool ply = format == CloudFormat::kPly;
  std::vector<std::uint8_t> block(kPointsPerBlock * (ply ? kPlyPoint : kPcdPoint));
  while (!points.empty()) {
    const auto part = points.first(std::min(points.size(), kPointsPerBlock));
    points = points.subspan(part.size());
    std::uint8_t* end = block.data();
    for (const CloudPoint& point : part) end = ply ? put_ply(end, point) : put_pcd(end, point);
    const auto bytes = static_cast<std::size_t>(end - block.data());
    if (Status status = file.write(block.data(), bytes); !status) return status;
  }
  return {};
}

}  // namespace

Status write_cloud(const std::vector<CloudPoint>& points, CloudFormat format,
                   const std::string& path) noexcept {
  return guarded([&]() -> Status {
    NewFile file(path);
    if (Status status = file.open(kWritten); !status) return status;
    const std::string header =
        format == CloudFormat::kPly ? ply_header(points.size()) : pcd_header(points.size());
    if (Status status = file.write(header.data(), header.size()); !status) return status;
    if (Status status = write_points(file, points, format); !status) return status;
    return file.finish();
  });
}

}  // namespace mtstereo
