// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/product_files.hpp"

#include <cinttypes>
#include <limits>
#include <utility>

#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/products.hpp"
#include "recordings/matching/view_geometry.hpp"
#include "recordings/matching/work_facts.hpp"

namespace mtstereo::run {
namespace {

std::string codec_private(GstSample* sample) {
  const GstStructure* const fields = gst_caps_get_structure(gst_sample_get_caps(sample), 0);
  const GValue* const value = gst_structure_get_value(fields, "codec_data");
  if (value == nullptr) return {};
  GstMapInfo map;
  GstBuffer* const buffer = gst_value_get_buffer(value);
  if (gst_buffer_map(buffer, &map, GST_MAP_READ) == FALSE) return {};
  std::string bytes(reinterpret_cast<const char*>(map.data), map.size);
  gst_buffer_unmap(buffer, &map);
  return bytes;
}

MatroskaTrack track_of(GstSample* sample, const Work& work, Product product) {
  const GstStructure* const fields = gst_caps_get_structure(gst_sample_get_caps(sample), 0);
  MatroskaTrack track;
  gst_structure_get_int(fields, "width", &track.width);
  gst_structure_get_int(fields, "height", &track.height);
  track.period = work.period;
  track.codec_private = codec_private(sample);
  track.tags = matroska_tags(work, product);
  return track;
}

// `far` = 0: no limit.
DepthLimits limits_of(double near, double far) {
  return {near, far > 0 ? far : std::numeric_limits<double>::infinity()};
}

}  // namespace

bool in_one_file(const WorkOptions& options, Product product) {
  return product != Product::kCloud && options.format == MapFormat::kMatroska;
}

std::string product_path(const WorkOptions& options, Product product) {
  if (product == Product::kCloud) return "clouds";
  return std::string(product_name(product)) + (in_one_file(options, product) ? ".mkv" : "");
}

std::vector<std::string> product_paths() {
  std::vector<std::string> paths;
  for (const MapFormat format : {MapFormat::kMatroska, MapFormat::kPng}) {
    WorkOptions options;
    options.format = format;
    for (const Product product : kAllProducts) paths.push_back(product_path(options, product));
  }
  return paths;
}

std::string pair_file(const WorkOptions& options, Product product, std::int64_t pair) {
  // Confidences and colors have no format of floating-point numbers.
  const bool pfm = options.format == MapFormat::kPfm &&
                   (product == Product::kDisparity || product == Product::kDepth);
  const char* const extension = product == Product::kCloud ? ".ply" : pfm ? ".pfm" : ".png";
  return outputs::format("%06" PRId64 "%s", pair, extension);
}

ProductFiles::ProductFiles(const Work& work, std::filesystem::path folder, std::int64_t done)
    : work_(work), folder_(std::move(folder)), geometry_(work.recording) {
  for (const Product product : work.options.products) {
    const std::filesystem::path path = folder_ / product_path(work.options, product);
    if (!in_one_file(work.options, product)) {
      std::filesystem::create_directories(path);
    } else if (done > 0) {
      videos_[product] = std::make_unique<MatroskaWriter>(path, done);
    }
  }
}

ProductFiles::~ProductFiles() = default;

void ProductFiles::write_video(Product product, GstSample* sample, std::int64_t pair) {
  std::unique_ptr<MatroskaWriter>& video = videos_[product];
  if (!video) {
    video = std::make_unique<MatroskaWriter>(folder_ / product_path(work_.options, product),
                                             track_of(sample, work_, product));
  }
  GstMapInfo map;
  GstBuffer* const buffer = gst_sample_get_buffer(sample);
  if (gst_buffer_map(buffer, &map, GST_MAP_READ) == FALSE) throw UserError("no memory for a frame");
  try {
    video->append(pair * work_.period, {reinterpret_cast<const char*>(map.data), map.size});
    video->flush();
  } catch (...) {
    gst_buffer_unmap(buffer, &map);
    throw;
  }
  gst_buffer_unmap(buffer, &map);
}

void ProductFiles::write_file(Product product, const PairResult& result) {
  const WorkOptions& options = work_.options;
  const std::filesystem::path file =
      folder_ / product_path(options, product) / pair_file(options, product, result.pair);
  GstSample* const map = result.map.get();
  if (product == Product::kCloud) {
    const DepthGeometry geometry = geometry_.of(map);
    const double far = options.far.value_or(default_far(geometry.focal_length, geometry.baseline));
    write_points(map, result.view.get(), geometry, limits_of(options.near, far), file);
  } else if (file.extension() == ".png") {
    const auto found = result.products.find(product);
    write_png(found != result.products.end() ? found->second.get() : map, file);
  } else if (product == Product::kDisparity) {
    write_disparity_pfm(map, file);
  } else {
    write_depth_pfm(map, geometry_.of(map), limits_of(options.near, options.far.value_or(0)), file);
  }
}

FrameFigures ProductFiles::write(const PairResult& result) {
  FrameFigures figures;
  figures.pair = result.pair;
  figures.frames = work_.pairs.pairs[static_cast<std::size_t>(result.pair)];
  figures.matching_ms = result.matching_ms;
  measure_map(result.map.get(), figures);
  for (const Product product : work_.options.products) {
    if (in_one_file(work_.options, product)) {
      write_video(product, result.products.at(product).get(), result.pair);
    } else {
      write_file(product, result);
    }
  }
  return figures;
}

void ProductFiles::finish() {
  for (auto& [product, video] : videos_) {
    if (video) video->finish();
  }
}

}  // namespace mtstereo::run
