// SPDX-License-Identifier: LGPL-2.1-or-later

// The JSON of a work.

#include <array>
#include <cinttypes>
#include <string_view>

#include "lib/outputs/json_text.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/matching/json_files.hpp"
#include "recordings/matching/matching_line.hpp"
#include "recordings/matching/products.hpp"

namespace mtstereo::run {
namespace {

constexpr const char* kKind = "work of mtstereo-run";
constexpr double kMillion = 1e6;

constexpr std::array kArrangements{Arrangement::kTwoSources, Arrangement::kSideBySide,
                                   Arrangement::kTopBottom};
constexpr std::array kFormats{MapFormat::kMatroska, MapFormat::kPng, MapFormat::kPfm};

// The enumerator with a name.
template <typename Choices, typename Name>
auto choice_of(const Choices& choices, Name name, const std::string& text) {
  for (const auto choice : choices) {
    if (name(choice) == std::string_view(text)) return choice;
  }
  throw UserError("a work has the unknown word " + text);
}

// Numbers that increase as their first one and the differences.
Json differences(const std::vector<Nanoseconds>& times) {
  Json list = Json::array();
  Nanoseconds last = 0;
  for (const Nanoseconds time : times) {
    list.push_back(time - last);
    last = time;
  }
  return list;
}

std::vector<Nanoseconds> sums(const Json& list) {
  std::vector<Nanoseconds> times;
  times.reserve(list.size());
  Nanoseconds time = 0;
  for (const Json& each : list) {
    time += each.get<Nanoseconds>();
    times.push_back(time);
  }
  return times;
}

Json source_json(const Source& source) {
  Json images = Json::array();
  for (const auto& image : source.images) images.push_back(outputs::escaped(image.string()));
  return {{"video", outputs::escaped(source.video.string())},
          {"pictures", std::move(images)},
          {"times", differences(source.times)},
          {"unused_bits", source.unused_bits}};
}

Source read_source(const Json& json) {
  Source source;
  source.video = outputs::unescaped(json.at("video").get<std::string>());
  for (const Json& image : json.at("pictures")) {
    source.images.emplace_back(outputs::unescaped(image.get<std::string>()));
  }
  source.times = sums(json.at("times"));
  source.unused_bits = json.value("unused_bits", 0);
  return source;
}

Json index_json(const FrameIndex& index) {
  return {{"width", index.width}, {"height", index.height},           {"period", index.period},
          {"codec", index.codec}, {"damage", index.damage},           {"by_order", index.by_order},
          {"bytes", index.bytes}, {"times", differences(index.times)}};
}

FrameIndex read_index(const Json& json) {
  FrameIndex index;
  index.width = json.at("width").get<int>();
  index.height = json.at("height").get<int>();
  index.period = json.at("period").get<Nanoseconds>();
  index.codec = json.at("codec").get<std::string>();
  index.damage = json.at("damage").get<std::string>();
  index.by_order = json.at("by_order").get<bool>();
  index.bytes = json.value("bytes", std::uintmax_t{0});
  index.times = sums(json.at("times"));
  return index;
}

Recording read_recording(const Json& json) {
  Recording recording;
  recording.name = json.at("name").get<std::string>();
  recording.kind = json.at("kind").get<std::string>();
  recording.arrangement =
      choice_of(kArrangements, arrangement_name, json.at("arrangement").get<std::string>());
  recording.swapped = json.at("swapped").get<bool>();
  recording.left = read_source(json.at("left"));
  recording.right = read_source(json.at("right"));
  recording.calibration = outputs::unescaped(json.at("calibration").get<std::string>());
  recording.rectified = json.at("rectified").get<bool>();
  recording.shape.alpha = json.at("alpha").get<double>();
  recording.shape.width = json.at("rectified_size").at(0).get<int>();
  recording.shape.height = json.at("rectified_size").at(1).get<int>();
  recording.frame_rate = json.at("frame_rate").get<double>();
  const int max_disparity = json.at("max_disparity").get<int>();
  if (max_disparity > 0) recording.max_disparity = max_disparity;
  recording.remarks = json.at("remarks").get<std::vector<std::string>>();
  return recording;
}

std::optional<ClockEstimate> read_clocks(const Json& json) {
  if (json.is_null()) return std::nullopt;
  ClockEstimate clocks;
  clocks.relation.offset = json.at("offset_s").get<double>();
  clocks.relation.drift = json.at("drift_ppm").get<double>() / kMillion;
  clocks.given = json.at("given").get<bool>();
  clocks.explanation = json.at("explanation").get<std::string>();
  if (clocks.given) return clocks;
  clocks.time = json.at("measured_at_s").get<double>();
  clocks.uncertainty = json.at("offset_deviation_s").get<double>();
  const Json& drift = json.at("drift_deviation_ppm");
  if (!drift.is_null()) clocks.drift_uncertainty = drift.get<double>() / kMillion;
  clocks.confirmed = json.at("confirmed").get<bool>();
  return clocks;
}

// Pairs as runs of successive ones: left, right, count.
Json pairs_json(const PairList& list) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < list.pairs.size();) {
    const FramePair first = list.pairs[i];
    std::int64_t count = 0;
    while (i < list.pairs.size() &&
           list.pairs[i] == FramePair{first.left + count, first.right + count}) {
      ++count;
      ++i;
    }
    runs.push_back({first.left, first.right, count});
  }
  return {{"runs", std::move(runs)},
          {"dropped_left", list.dropped_left},
          {"dropped_right", list.dropped_right}};
}

PairList read_pairs(const Json& json, const Work& work) {
  PairList list;
  const bool two = work.recording.arrangement == Arrangement::kTwoSources;
  const auto lefts = static_cast<std::int64_t>(work.left.times.size());
  const auto rights = two ? static_cast<std::int64_t>(work.right.times.size()) : lefts;
  for (const Json& run : json.at("runs")) {
    const auto left = run.at(0).get<std::int64_t>(), right = run.at(1).get<std::int64_t>(),
               count = run.at(2).get<std::int64_t>();
    if (left < 0 || right < 0 || count < 0 || count > lefts - left || count > rights - right) {
      throw UserError("the pairs of a work are beyond its frames");
    }
    for (std::int64_t i = 0; i < count; ++i) list.pairs.push_back({left + i, right + i});
  }
  list.dropped_left = json.at("dropped_left").get<std::int64_t>();
  list.dropped_right = json.at("dropped_right").get<std::int64_t>();
  return list;
}

std::optional<ViewGeometry> read_geometry(const Json& json) {
  if (json.is_null()) return std::nullopt;
  ViewGeometry geometry;
  Rectification& views = geometry.views;
  views.width = json.at("width").get<int>();
  views.height = json.at("height").get<int>();
  views.focal_length = json.at("focal_length_px").get<double>();
  views.baseline = json.at("baseline_m").get<double>();
  views.left_center_x = json.at("principal_x_px").get<double>();
  views.right_center_x = json.at("right_principal_x_px").get<double>();
  views.center_y = json.at("principal_y_px").get<double>();
  geometry.format = json.at("calibration_format").get<std::string>();
  return geometry;
}

WorkOptions read_options(const Json& json) {
  WorkOptions options;
  options.products.clear();
  for (const Json& product : json.at("products")) {
    options.products.push_back(choice_of(kAllProducts, product_name, product.get<std::string>()));
  }
  options.format = choice_of(kFormats, format_name, json.at("format").get<std::string>());
  options.parameters = json.at("parameters").get<decltype(options.parameters)>();
  options.near = json.at("near_m").get<double>();
  if (!json.at("far_m").is_null()) options.far = json.at("far_m").get<double>();
  options.threads = json.at("threads").get<int>();
  return options;
}

Work work_of(const Json& json) {
  Work work;
  work.recording = read_recording(json.at("recording"));
  work.left = read_index(json.at("left"));
  work.right = read_index(json.at("right"));
  work.clocks = read_clocks(json.at("clocks"));
  work.pairs = read_pairs(json.at("pairs"), work);
  work.options = read_options(json.at("options"));
  work.period = json.at("period").get<Nanoseconds>();
  work.geometry = read_geometry(json.at("geometry"));
  work.correction = json.at("correction").get<decltype(work.correction)>();
  work.remarks = json.at("remarks").get<std::vector<std::string>>();
  work.doubt = json.at("doubt").get<std::string>();
  return work;
}

}  // namespace

const char* arrangement_name(Arrangement arrangement) {
  switch (arrangement) {
    case Arrangement::kSideBySide:
      return "side-by-side";
    case Arrangement::kTopBottom:
      return "top-bottom";
    case Arrangement::kTwoSources:
      break;
  }
  return "two sources";
}

const char* format_name(MapFormat format) {
  switch (format) {
    case MapFormat::kPng:
      return "png";
    case MapFormat::kPfm:
      return "pfm";
    case MapFormat::kMatroska:
      break;
  }
  return "mkv";
}

Json recording_json(const Recording& recording) {
  return {{"name", recording.name},
          {"kind", recording.kind},
          {"arrangement", arrangement_name(recording.arrangement)},
          {"swapped", recording.swapped},
          {"left", source_json(recording.left)},
          {"right", source_json(recording.right)},
          {"calibration", outputs::escaped(recording.calibration)},
          {"rectified", recording.rectified},
          {"alpha", recording.shape.alpha},
          {"rectified_size", {recording.shape.width, recording.shape.height}},
          {"frame_rate", recording.frame_rate},
          {"max_disparity", recording.max_disparity.value_or(0)},
          {"remarks", recording.remarks}};
}

Json options_json(const WorkOptions& options) {
  Json products = Json::array();
  for (const Product product : options.products) products.push_back(product_name(product));
  return {{"products", std::move(products)},
          {"format", format_name(options.format)},
          {"parameters", options.parameters},
          {"near_m", options.near},
          {"far_m", options.far ? Json(*options.far) : Json(nullptr)},
          {"threads", options.threads}};
}

Json geometry_json(const std::optional<ViewGeometry>& geometry) {
  if (!geometry) return nullptr;
  const Rectification& views = geometry->views;
  return {{"width", views.width},
          {"height", views.height},
          {"focal_length_px", views.focal_length},
          {"baseline_m", views.baseline},
          {"principal_x_px", views.left_center_x},
          {"principal_y_px", views.center_y},
          {"right_principal_x_px", views.right_center_x},
          {"principal_offset_px", views.principal_offset()},
          {"calibration_format", geometry->format}};
}

Json clocks_json(const std::optional<ClockEstimate>& clocks) {
  if (!clocks) return nullptr;
  Json json{{"offset_s", clocks->relation.offset},
            {"drift_ppm", kMillion * clocks->relation.drift},
            {"given", clocks->given}};
  if (!clocks->given) {
    json["measured_at_s"] = clocks->time;
    json["offset_deviation_s"] = clocks->uncertainty;
    json["drift_deviation_ppm"] =
        clocks->drift_uncertainty ? Json(kMillion * *clocks->drift_uncertainty) : Json(nullptr);
    json["confirmed"] = clocks->confirmed;
  }
  json["explanation"] = clocks->explanation;
  return json;
}

Json work_json(const Work& work) {
  return {{"kind", kKind},
          {"version", kJsonVersion},
          {"recording", recording_json(work.recording)},
          {"left", index_json(work.left)},
          {"right", index_json(work.right)},
          {"clocks", clocks_json(work.clocks)},
          {"pairs", pairs_json(work.pairs)},
          {"options", options_json(work.options)},
          {"period", work.period},
          {"geometry", geometry_json(work.geometry)},
          {"correction", work.correction},
          {"remarks", work.remarks},
          {"doubt", work.doubt}};
}

void write_work(const Work& work, const std::filesystem::path& file) {
  write_whole(file,
              [&work](std::ostream& out) { out << outputs::text_of(work_json(work)) << '\n'; });
}

Work read_work(const std::filesystem::path& file) {
  Work work;
  const Json json = read_json(file, kKind);
  read_fields(file, [&] { work = work_of(json); });
  return work;
}

std::string fingerprint(const Work& work) {
  constexpr std::uint64_t kStart = 0xcbf29ce484222325, kFactor = 0x100000001b3;  // FNV-1a
  Json json = work_json(work);
  // None of them changes the results; the pairs contain what the clocks decide.
  json.erase("remarks");
  json.erase("doubt");
  json.erase("clocks");
  json.at("options").erase("threads");
  std::uint64_t sum = kStart;
  for (const char each : outputs::text_of(std::move(json)))
    sum = (sum ^ static_cast<unsigned char>(each)) * kFactor;
  return outputs::format("%016" PRIx64, sum);
}

}  // namespace mtstereo::run
