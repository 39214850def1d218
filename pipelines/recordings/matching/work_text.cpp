// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/work_text.hpp"

#include "lib/outputs/texts.hpp"
#include "recordings/matching/json_files.hpp"
#include "recordings/matching/products.hpp"
#include "recordings/matching/work_facts.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

std::string input_text(const Work& work) {
  const ViewSize size = view_size(work);
  const std::string text =
      outputs::format("%dx%d px, %s, %.4g per second", size.width, size.height,
                      outputs::counted(work.pairs.pairs.size(), "pair").c_str(), frame_rate(work));
  std::string arrangement;
  if (work.recording.arrangement != Arrangement::kTwoSources) {
    arrangement = std::string(" (") + arrangement_name(work.recording.arrangement) +
                  (work.recording.swapped ? ", the first half is the right view)" : ")");
  }
  return "Input: " + work.recording.kind + arrangement + ", " + text + ".";
}

std::string views_text(const Work& work) {
  const Recording& recording = work.recording;
  if (!recording.rectified) return "Views: rectified by the calibration.";
  if (work.geometry) return "Views: taken as rectified; the calibration gives the meters.";
  return recording.calibration.empty()
             ? "Views: taken as rectified, without a calibration: no distances."
             : "Views: taken as rectified; the calibration gives no distances.";
}

std::string matching_text(const Work& work) {
  const Parameters parameters = matcher_parameters(work.options);
  const int first = parameters.integer(Parameter::kMinDisparity);
  const int last = parameters.integer(Parameter::kMaxDisparity) - 1;
  const bool plain = parameters.preset() == Preset::kDefault;
  return "Matching: " +
         (plain ? std::string() : "preset " + parameters.text(Parameter::kPreset) + ", ") +
         "mode " + parameters.text(Parameter::kMode) + ", disparities " + std::to_string(first) +
         " to " + std::to_string(last) + " px.";
}

std::string results_text(const Work& work) {
  std::string names;
  for (const Product product : work.options.products) {
    names += (names.empty() ? "" : ", ") + std::string(product_name(product));
  }
  if (names.empty()) return "Results: figures only.";
  return "Results: " + names + " (" + format_name(work.options.format) + ").";
}

}  // namespace

std::vector<std::string> recognized(const Work& work) {
  return {input_text(work), views_text(work), matching_text(work), results_text(work)};
}

}  // namespace mtstereo::run
