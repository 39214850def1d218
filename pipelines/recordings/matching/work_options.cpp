// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/work_options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/products.hpp"

namespace mtstereo::run {
namespace {

constexpr const char* kScaleProperty = "disparity-scale";
// From the finest to the coarsest, as mtstereo chooses it; docs/elements/mtstereo.md.
constexpr std::array kScales{256, 128, 64, 32, 16, 8, 4, 2, 1};

// Properties of mtstereo that are not parameters of the matcher.
void check_property(const std::string& name, const std::string& value) {
  const auto one_of = [&](std::initializer_list<std::string_view> words) {
    if (std::find(words.begin(), words.end(), value) != words.end()) return;
    std::string list;
    for (const std::string_view word : words) {
      list += (list.empty() ? "" : ", ") + std::string(word);
    }
    throw UserError(name + " = " + value + " is not one of " + list);
  };
  if (name == "alignment") return one_of({"off", "correct"});
  if (name == "sharpness") return one_of({"keep", "match"});
  if (name != kScaleProperty) throw UserError("there is no parameter " + name);
  int scale = 0;
  const char* const end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, scale);
  if (error != std::errc() || stop != end || scale < 1 || scale > 65535) {
    throw UserError(name + " = " + value + " is not an integer of 1 to 65535");
  }
}

void check(const Status& status) {
  if (!status) throw UserError(status.error().message);
}

}  // namespace

bool is_range_to_find(const std::string& value) { return value == "auto" || value == "0"; }

Parameters matcher_parameters(const WorkOptions& options) {
  Parameters parameters;
  for (const auto& [name, value] : options.parameters) {
    if (name == parameter_info(Parameter::kMaxDisparity).name && is_range_to_find(value)) continue;
    if (find_parameter(name) == nullptr) {
      check_property(name, value);
    } else {
      check(parameters.set(name, value));
    }
  }
  if (parameters.text(Parameter::kResolution) == "auto") {
    throw UserError(
        "resolution = auto chooses by the frames before, but the pairs of a recording are matched "
        "side by side and in pieces: set full, or half-refined for a soft camera");
  }
  if (parameters.text(Parameter::kTemporal) != "off") {
    throw UserError(
        "temporal = " + std::string(parameters.text(Parameter::kTemporal)) +
        " compares each pair with those before, but the pairs of a recording are matched side by "
        "side and in pieces: use mtstereo in a pipeline");
  }
  if (options.threads > 0) check(parameters.set(Parameter::kThreads, options.threads));
  return parameters;
}

std::string property_of(const WorkOptions& options, const std::string& name) {
  for (const auto& [each, value] : options.parameters) {
    if (each == name) return value;
  }
  return {};
}

void check_products(const Recording& recording, const WorkOptions& options) {
  const std::string& name = recording.name;
  if (!recording.rectified && recording.calibration.empty()) {
    throw UserError(
        name +
        ": the views are not rectified, and there is no calibration; give one (--calibration)");
  }
  const bool meters = makes(options, Product::kDepth) || makes(options, Product::kCloud);
  if (!meters || !recording.calibration.empty()) return;
  const std::string needed = name + ": depths and clouds need a calibration";
  for (const std::string& remark : recording.remarks) {
    if (remark.starts_with(kNoCalibration)) throw UserError(needed + ". " + remark);
  }
  throw UserError(needed + ", and none lies beside the input; give one (--calibration)");
}

ViewSize view_size(const Work& work) {
  const Arrangement arrangement = work.recording.arrangement;
  return {work.left.width / (arrangement == Arrangement::kSideBySide ? 2 : 1),
          work.left.height / (arrangement == Arrangement::kTopBottom ? 2 : 1)};
}

void complete_options(Work& work) {
  WorkOptions& options = work.options;
  Parameters parameters = matcher_parameters(options);
  const std::optional<int> range = work.recording.max_disparity;
  if (range && !parameters.is_set(Parameter::kMaxDisparity)) {
    check(parameters.set(Parameter::kMaxDisparity, *range));
    options.parameters.emplace_back(parameter_info(Parameter::kMaxDisparity).name,
                                    std::to_string(*range));
  }
  const std::string scale = property_of(options, kScaleProperty);
  if (!scale.empty()) {
    check(parameters.check_scale16(std::stoi(scale)));
  } else if (!parameters.check_scale16(kScales.front())) {
    const auto fitting = std::find_if(kScales.begin(), kScales.end(), [&](int each) {
      return parameters.check_scale16(each).ok();
    });
    if (fitting == kScales.end()) check(parameters.check_scale16(kScales.back()));
    options.parameters.emplace_back(kScaleProperty, std::to_string(*fitting));
    work.remarks.push_back("The values of the maps count 1/" + std::to_string(*fitting) +
                           " px, so that the search range fits into 16 bits.");
  }
  // The rectification decides the size.
  const ViewSize size = work.geometry
                            ? ViewSize{work.geometry->views.width, work.geometry->views.height}
                            : view_size(work);
  check(parameters.check_frame(size.width, size.height));
}

}  // namespace mtstereo::run
