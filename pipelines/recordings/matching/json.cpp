// SPDX-License-Identifier: LGPL-2.1-or-later

// The reports of pieces and runs.

#include "recordings/matching/json.hpp"

#include <gst/gst.h>

#include <algorithm>

#include "lib/outputs/printable.hpp"
#include "lib/outputs/texts.hpp"
#include "recordings/matching/json_files.hpp"
#include "recordings/matching/matching_line.hpp"
#include "recordings/matching/products.hpp"
#include "recordings/matching/view_geometry.hpp"
#include "recordings/matching/work_facts.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

constexpr const char* kPieceKind = "piece of mtstereo-run";
constexpr const char* kRunKind = "report of mtstereo-run";

Json source_summary(const Source& source, const FrameIndex& index) {
  const bool video = !source.video.empty();
  Json summary{{"file", video ? outputs::escaped(source.video.string()) : ""},
               {"pictures", source.images.size()},
               {"first_picture", video ? "" : outputs::escaped(source.images.front().string())},
               {"codec", index.codec},
               {"width", index.width},
               {"height", index.height},
               {"frames", index.times.size()},
               {"damage", index.damage}};
  if (video) {
    summary.erase("pictures");
    summary.erase("first_picture");
  } else {
    summary.erase("file");
  }
  return summary;
}

Json object_of(const NamedTexts& values) {
  Json object = Json::object();
  for (const auto& [name, value] : values) object[name] = value;
  return object;
}

// The disparities that are searched, and what the values of the maps count.
Json disparity_json(const WorkOptions& options) {
  const Parameters parameters = matcher_parameters(options);
  const MapUnits units = map_units(options);
  return {{"smallest_px", parameters.integer(Parameter::kMinDisparity)},
          {"largest_px", parameters.integer(Parameter::kMaxDisparity) - 1},
          {"scale", units.scale},
          {"offset_px", units.offset}};
}

// The depths of maps and clouds; 0 = no limit.
Json limits_json(const Work& work) {
  const std::optional<double>& far = work.options.far;
  const double of_clouds =
      work.geometry ? default_far(work.geometry->views.focal_length, work.geometry->views.baseline)
                    : 0;
  return {{"near_m", work.options.near},
          {"far_m", far.value_or(0)},
          {"far_of_clouds_m", far.value_or(of_clouds)}};
}

Json inputs_json(const Work& work) {
  const Recording& recording = work.recording;
  Json inputs{
      {"kind", recording.kind},           {"arrangement", arrangement_name(recording.arrangement)},
      {"swapped", recording.swapped},     {"calibration", outputs::escaped(recording.calibration)},
      {"rectified", recording.rectified}, {"alpha", recording.shape.alpha}};
  if (recording.arrangement == Arrangement::kTwoSources) {
    inputs["left"] = source_summary(recording.left, work.left);
    inputs["right"] = source_summary(recording.right, work.right);
  } else {
    inputs["both"] = source_summary(recording.left, work.left);
  }
  return inputs;
}

Json run_json(const Work& work, const PieceReport& report, double seconds) {
  const FrameFigures means = mean_of(report.frames);
  Json products = Json::array();
  for (const Product product : work.options.products) products.push_back(product_name(product));
  const auto pairs = static_cast<double>(report.frames.size());
  g_autofree gchar* gstreamer = gst_version_string();
  return {
      {"kind", kRunKind},
      {"version", kJsonVersion},
      {"fingerprint", fingerprint(work)},
      {"programs", {{"mtstereo", MTSTEREO_VERSION}, {"gstreamer", gstreamer}}},
      {"recording", work.recording.name},
      {"inputs", inputs_json(work)},
      {"products", std::move(products)},
      {"format", format_name(work.options.format)},
      {"parameters", object_of(effective_parameters(work.options))},
      {"threads", work.options.threads},
      {"limits", limits_json(work)},
      {"disparity", disparity_json(work.options)},
      {"geometry", geometry_json(work.geometry)},
      {"correction", object_of(work.correction)},
      {"clocks", clocks_json(work.clocks)},
      {"period_ns", work.period},
      {"frame_rate", frame_rate(work)},
      {"pairs", work.pairs.pairs.size()},
      {"processed_pairs", report.frames.size()},
      {"dropped_frames", {{"left", work.pairs.dropped_left}, {"right", work.pairs.dropped_right}}},
      {"damage", report.damage},
      {"remarks", work.remarks},
      {"doubt", verdict(work, report)},
      {"seconds", seconds},
      {"pairs_per_second", seconds > 0 ? pairs / seconds : 0.0},
      {"means",
       {{"density", means.density},
        {"median_disparity_px", means.median_disparity},
        {"matching_ms", means.matching_ms}}},
      {"files", report.files},
      {"file_bytes", report.file_bytes}};
}

Json read_report(const std::filesystem::path& file) {
  std::error_code error;  // a pipe would be read without an end
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error))) return {};
  std::ifstream in(file, std::ios::binary);
  return Json::parse(in, nullptr, false);
}

// A text in the report of a run; empty if there is none.
std::string text_in(const std::filesystem::path& file, const char* name) {
  const Json json = read_report(file);
  const bool ours = json.is_object() && json.value("kind", Json()) == kRunKind;
  return ours ? json.value(name, "") : "";
}

}  // namespace

void write_piece(const PieceReport& report, Range range, const std::filesystem::path& file) {
  const Json head{{"kind", kPieceKind},
                  {"version", kJsonVersion},
                  {"first", range.first},
                  {"count", range.count},
                  {"damage", report.damage},
                  {"files", report.files},
                  {"file_bytes", report.file_bytes}};
  write_whole(file, [&](std::ostream& out) { write_frames(out, head, report.frames); });
}

PieceReport read_piece(const std::filesystem::path& file, Range& range) {
  PieceReport report;
  const Json json = read_json(file, kPieceKind);
  read_fields(file, [&] {
    range.first = json.at("first").get<std::int64_t>();
    range.count = json.at("count").get<std::int64_t>();
    report.damage = json.at("damage").get<std::string>();
    report.files = json.at("files").get<std::vector<std::string>>();
    report.file_bytes = json.value("file_bytes", report.file_bytes);
    report.frames = read_frames(json);
  });
  return report;
}

void write_run_report(const Work& work, const PieceReport& report, double seconds,
                      const std::filesystem::path& file) {
  const Json head = run_json(work, report, seconds);
  write_whole(file, [&](std::ostream& out) { write_frames(out, head, report.frames); });
}

FrameFigures mean_of(const std::vector<FrameFigures>& frames) {
  FrameFigures mean;
  for (const FrameFigures& frame : frames) {
    mean.density += frame.density;
    mean.median_disparity += frame.median_disparity;
    mean.matching_ms += frame.matching_ms;
  }
  const double count = std::max<double>(static_cast<double>(frames.size()), 1);
  mean.density /= count;
  mean.median_disparity /= count;
  mean.matching_ms /= count;
  return mean;
}

std::string verdict(const Work& work, const PieceReport& report) {
  constexpr double kLeastDensity = 0.05;
  const double density = mean_of(report.frames).density;
  if (!work.doubt.empty() || report.frames.empty() || density >= kLeastDensity) return work.doubt;
  return outputs::format(
      "Only %.1f %% of the pixels have a disparity. Check the order of the views (--swap), "
      "their times (--sync auto), the search range (--max-disparity N) and the "
      "rectification (--calibration FILE).",
      100 * density);
}

std::optional<outputs::WrittenFiles> files_listed_in(const std::filesystem::path& file) {
  const Json json = read_report(file);
  const bool ours = json.is_object() && (json.value("kind", Json()) == kRunKind ||
                                         json.value("kind", Json()) == kPieceKind);
  if (!ours) return std::nullopt;
  outputs::WrittenFiles listed;
  try {
    const auto names = json.value("files", std::vector<std::string>());
    const auto bytes = json.value("file_bytes", std::vector<std::uintmax_t>());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool known = bytes.size() == names.size();
      listed.add(names[i], known ? std::optional(bytes[i]) : std::nullopt);
    }
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return listed;
}

std::string fingerprint_in(const std::filesystem::path& file) {
  return text_in(file, "fingerprint");
}

std::string verdict_in(const std::filesystem::path& file) { return text_in(file, "doubt"); }

}  // namespace mtstereo::run
