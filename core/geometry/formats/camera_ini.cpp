// SPDX-License-Identifier: LGPL-2.1-or-later
// The INI files of ROS, also ost.txt of camera_calibration, which has both cameras. A name is
// followed by lines of numbers.
#include <array>
#include <string>
#include <utility>

#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

/// The name of an entry in the YAML files of ROS.
std::string yaml_name(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, const char*>, 6> kNames = {
      {{"width", "image_width"},
       {"height", "image_height"},
       {"camera matrix", "camera_matrix"},
       {"distortion", "distortion_coefficients"},
       {"rectification", "rectification_matrix"},
       {"projection", "projection_matrix"}}};
  for (const auto& [ini, yaml] : kNames) {
    if (name == ini) return yaml;
  }
  return std::string(name);
}

void add(Value& map, std::string name, std::string text) {
  map.names.push_back(std::move(name));
  map.items.emplace_back();
  map.items.back().text = std::move(text);
}

bool is_number_line(std::string_view line) {
  return line.front() == '-' || line.front() == '+' || line.front() == '.' ||
         (line.front() >= '0' && line.front() <= '9');
}

/// What the YAML files state and these do not.
void add_lens_model(Value& camera, const std::string& file) {
  for (std::size_t i = 0; i < camera.names.size(); ++i) {
    if (camera.names[i] != "distortion_coefficients") continue;
    constexpr std::size_t kFisheyeCount = 4;
    if (Entry(camera.items[i], file, camera.names[i]).numbers().size() == kFisheyeCount) {
      throw FileError(file +
                      ": distortion has 4 values, as fisheye lenses have, but the file states no "
                      "lens model; give the YAML files of the same calibration");
    }
  }
  add(camera, "distortion_model", "plumb_bob");
}

}  // namespace

Value parse_camera_ini(std::string_view text, const std::string& file) {
  Value cameras;
  cameras.kind = Value::Kind::kList;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#' || line.front() == ';') continue;
    if (line == "[image]") {
      cameras.items.emplace_back();
      cameras.items.back().kind = Value::Kind::kMap;
      continue;
    }
    if (cameras.items.empty() || static_cast<std::size_t>(number) > kMostValues) {
      throw FileError(file + ": line " + std::to_string(number) + " is not in a section [image]");
    }
    Value& camera = cameras.items.back();
    if (line.front() == '[') continue;  // the name of the camera
    if (!is_number_line(line)) {
      add(camera, yaml_name(line), "");
    } else if (camera.items.empty()) {
      throw FileError(file + ": line " + std::to_string(number) + " is '" + printable(line) +
                      "', a name such as width is needed before it");
    } else {
      camera.items.back().text.append(" ").append(line);
    }
  }
  for (Value& camera : cameras.items) add_lens_model(camera, file);
  if (cameras.items.size() == 1) return Value(std::move(cameras.items.front()));
  return cameras;
}

}  // namespace mtstereo::formats
