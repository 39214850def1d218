// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/work_facts.hpp"

#include <glib.h>

#include <array>
#include <charconv>
#include <filesystem>

#include "geometry/calibration_path.hpp"
#include "lib/outputs/printable.hpp"
#include "recordings/matching/products.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

constexpr const char* kDepthUnit = "0.001";  // of mtdepth [m]

// The names of a calibration's files without the folders, which differ from machine to machine.
std::string names_of(const std::string& calibration) {
  const CalibrationPath path = split_calibration_path(calibration);
  std::string names;
  for (const std::string& file : path.files) {
    names += (names.empty() ? "" : ",") + std::filesystem::path(file).filename().string();
  }
  if (!path.selection.empty()) names += "#" + path.selection;
  return outputs::printable(names);
}

std::string utf8(const std::string& text) {
  g_autofree gchar* valid = g_utf8_make_valid(text.data(), static_cast<gssize>(text.size()));
  return valid;
}

// As in "mode=dense max-disparity=96".
std::string joined(const NamedTexts& values) {
  std::string text;
  for (const auto& [name, value] : values) {
    text += (text.empty() ? "" : " ") + name + "=" + (value.empty() ? "\"\"" : value);
  }
  return text;
}

void add_geometry(const ViewGeometry& geometry, NamedTexts& tags) {
  const Rectification& views = geometry.views;
  const auto add = [&tags](const char* name, double value) {
    tags.emplace_back(name, number_text(value));
  };
  add("FOCAL_LENGTH_PX", views.focal_length);
  add("BASELINE_M", views.baseline);
  add("PRINCIPAL_X_PX", views.left_center_x);
  add("PRINCIPAL_Y_PX", views.center_y);
  add("PRINCIPAL_OFFSET_PX", views.principal_offset());
  tags.emplace_back("CALIBRATION_FORMAT", geometry.format);
}

}  // namespace

std::string number_text(double number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

NamedTexts effective_parameters(const WorkOptions& options) {
  const Parameters parameters = matcher_parameters(options);
  NamedTexts values;
  for (const ParameterInfo& info : parameter_table()) {
    if (info.id != Parameter::kThreads) values.emplace_back(info.name, parameters.text(info.id));
  }
  values.emplace_back("disparity-scale", std::to_string(map_units(options).scale));
  const std::string sharpness = property_of(options, "sharpness");
  const bool published = parameters.preset() == Preset::kPaper;
  values.emplace_back("sharpness", !sharpness.empty() ? sharpness : published ? "keep" : "match");
  return values;
}

MapUnits map_units(const WorkOptions& options) {
  const std::string scale = property_of(options, "disparity-scale");
  return {scale.empty() ? MapUnits{}.scale : std::stoi(scale),
          matcher_parameters(options).disparity_offset()};
}

double frame_rate(const Work& work) {
  return work.period > 0 ? 1e9 / static_cast<double>(work.period) : 0;
}

NamedTexts matroska_tags(const Work& work, Product product) {
  const Recording& recording = work.recording;
  const WorkOptions& options = work.options;
  NamedTexts tags{{"PRODUCT", product_name(product)},
                  {"VERSION", MTSTEREO_VERSION},
                  {"INPUT_KIND", recording.kind},
                  {"FRAME_RATE", number_text(frame_rate(work))}};
  const MapUnits units = map_units(options);
  tags.emplace_back("DISPARITY_SCALE", std::to_string(units.scale));
  tags.emplace_back("DISPARITY_OFFSET_PX", std::to_string(units.offset));
  if (product == Product::kDepth) tags.emplace_back("DEPTH_UNIT_M", kDepthUnit);
  if (work.geometry) add_geometry(*work.geometry, tags);
  if (!recording.calibration.empty()) {
    tags.emplace_back("CALIBRATION", names_of(recording.calibration));
  }
  tags.emplace_back("INPUT_RECTIFIED", recording.rectified ? "yes" : "no");
  NamedTexts properties = effective_parameters(options);
  properties.insert(properties.end(), work.correction.begin(), work.correction.end());
  tags.emplace_back("PARAMETERS", joined(properties));
  for (auto& [name, value] : tags) {
    name.insert(0, "MTSTEREO_");
    value = utf8(value);
  }
  return tags;
}

}  // namespace mtstereo::run
