// SPDX-License-Identifier: LGPL-2.1-or-later
// Writes a cloud as PLY and PCD, and its points as text, for read_clouds_test.py.
//
// usage: write-clouds FOLDER POINTS
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "mtstereo/geometry/point_cloud.hpp"
#include "support/random.hpp"

namespace mtstereo {
namespace {

std::vector<CloudPoint> random_points(int count) {
  test::Random random(20);
  const auto coordinate = [&] { return static_cast<float>(random.share() * 200 - 100); };
  const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
  std::vector<CloudPoint> points;
  for (int i = 0; i < count; ++i) {
    CloudPoint& point = points.emplace_back();
    point.x = coordinate();
    point.y = coordinate();
    point.z = coordinate();
    point.red = byte();
    point.green = byte();
    point.blue = byte();
    point.confidence = byte();
  }
  return points;
}

bool write_text(const std::vector<CloudPoint>& points, const std::string& path) {
  std::ofstream out(path);
  out.precision(9);
  for (const CloudPoint& point : points) {
    out << point.x << ' ' << point.y << ' ' << point.z << ' ' << +point.red << ' ' << +point.green
        << ' ' << +point.blue << ' ' << +point.confidence << '\n';
  }
  out.close();
  return out.good();
}

int write_all(const std::string& folder, int count) {
  const std::vector<CloudPoint> points = random_points(count);
  for (const auto& [format, name] :
       {std::pair{CloudFormat::kPly, "/cloud.ply"}, std::pair{CloudFormat::kPcd, "/cloud.pcd"}}) {
    const Status status = write_cloud(points, format, folder + name);
    if (status.ok()) continue;
    std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return 1;
  }
  return write_text(points, folder + "/points.txt") ? 0 : 1;
}

}  // namespace
}  // namespace mtstereo

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  return mtstereo::write_all(argv[1], std::atoi(argv[2]));
}
