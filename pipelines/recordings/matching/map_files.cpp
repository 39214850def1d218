// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/map_files.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "lib/images/images.hpp"
#include "lib/outputs/pfm_bytes.hpp"
#include "lib/outputs/user_error.hpp"
#include "lib/outputs/write_file.hpp"
#include "mtstereo/geometry/point_cloud.hpp"
#include "shared/confidence_meta.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::run {
namespace {

constexpr std::size_t kValues = 65536;

// A frame that is mapped for reading.
class Frame {
 public:
  explicit Frame(GstSample* sample)
      : info_(info_of(sample)), mapped_(info_, gst_sample_get_buffer(sample), GST_MAP_READ) {
    if (!mapped_.mapped()) throw UserError("a frame cannot be read: " + mapped_.problem());
  }
  GrayView bytes() const { return mapped_.luma(); }
  ImageView<const std::uint16_t> values() const {
    const ImageView<std::uint16_t> view = mapped_.gray16();
    return {view.data, view.width, view.height, view.stride};
  }
  GstVideoFormat format() const { return GST_VIDEO_INFO_FORMAT(&info_); }

 private:
  static GstVideoInfo info_of(GstSample* sample) {
    GstVideoInfo info;
    if (gst_video_info_from_caps(&info, gst_sample_get_caps(sample)) != FALSE) return info;
    throw UserError("a frame has no valid caps");
  }
  GstVideoInfo info_;
  plugin::MappedFrame mapped_;
};

plugin::MapUnit unit_of(GstSample* map) {
  plugin::MapUnit unit{256, 0};
  const GstStructure* const fields = gst_caps_get_structure(gst_sample_get_caps(map), 0);
  gst_structure_get_int(fields, "disparity-scale", &unit.scale);
  gst_structure_get_int(fields, "disparity-offset", &unit.offset);
  return unit;
}

// The disparity of a value that is not 0 [px].
double disparity_of(std::size_t value, const plugin::MapUnit& unit) {
  return static_cast<double>(value) / unit.scale + unit.offset;
}

// How many pixels have each value, without those of less confidence.
std::vector<std::int64_t> count_values(GstSample* map, int least_confidence = 0) {
  const Frame frame(map);
  GstSample* const rating = plugin::confidence_of(gst_sample_get_buffer(map));
  std::optional<Frame> confidence;
  if (least_confidence > 0 && rating != nullptr) confidence.emplace(rating);
  std::vector<std::int64_t> counts(kValues);
  const ImageView<const std::uint16_t> values = frame.values();
  for (int y = 0; y < values.height; ++y) {
    const std::uint16_t* row = values.row(y);
    const std::uint8_t* ratings = confidence ? confidence->bytes().row(y) : nullptr;
    for (int x = 0; x < values.width; ++x) {
      if (ratings == nullptr || ratings[x] >= least_confidence) ++counts[row[x]];
    }
  }
  return counts;
}

void write_pfm(ImageView<const std::uint16_t> map, const std::vector<float>& table,
               const std::filesystem::path& file) {
  outputs::write_file(file, outputs::pfm_bytes(map.width, map.height,
                                               [&](int x, int y) { return table[map.row(y)[x]]; }));
}

// The smallest value that so many of the known ones do not exceed; 0 without any.
std::size_t value_below(const std::vector<std::int64_t>& counts, double share) {
  const std::int64_t known = std::accumulate(counts.begin() + 1, counts.end(), std::int64_t{0});
  if (known == 0) return 0;
  const auto wanted = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(known)));
  std::int64_t below = 0;
  std::size_t value = 0;
  while (below < wanted) below += counts[++value];
  return value;
}

}  // namespace

void measure_map(GstSample* map, FrameFigures& figures) {
  const std::vector<std::int64_t> counts = count_values(map);
  const std::int64_t pixels = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  figures.density = static_cast<double>(pixels - counts[0]) / static_cast<double>(pixels);
  const std::size_t value = value_below(counts, 0.5);
  figures.median_disparity = value == 0 ? 0 : disparity_of(value, unit_of(map));
}

double disparity_below(GstSample* map, double share, int least_confidence) {
  const std::size_t value = value_below(count_values(map, least_confidence), share);
  return value == 0 ? 0 : disparity_of(value, unit_of(map));
}

double share_from(GstSample* map, double disparity) {
  const std::vector<std::int64_t> counts = count_values(map);
  const plugin::MapUnit unit = unit_of(map);
  std::int64_t known = 0, beyond = 0;
  for (std::size_t value = 1; value < counts.size(); ++value) {
    known += counts[value];
    if (disparity_of(value, unit) >= disparity) beyond += counts[value];
  }
  return known > 0 ? static_cast<double>(beyond) / static_cast<double>(known) : 0;
}

std::optional<double> stated_errors(GstSample* map) {
  constexpr int kFirstMatched = 16;                  // smaller values mark inferred disparities
  constexpr double kEvenOdds = 64, kSteepness = 24;  // odds = e^((confidence - 64) / 24)
  GstSample* const sample = plugin::confidence_of(gst_sample_get_buffer(map));
  if (sample == nullptr) return std::nullopt;
  const Frame frame(sample);
  const GrayView confidence = frame.bytes();
  std::int64_t pixels = 0;
  double wrong = 0;
  for (int y = 0; y < confidence.height; ++y) {
    const std::uint8_t* row = confidence.row(y);
    for (int x = 0; x < confidence.width; ++x) {
      if (row[x] < kFirstMatched) continue;
      wrong += 1 / (1 + std::exp((row[x] - kEvenOdds) / kSteepness));
      ++pixels;
    }
  }
  if (pixels == 0) return std::nullopt;
  return wrong / static_cast<double>(pixels);
}

MapGeometry::MapGeometry(const Recording& recording) {
  if (recording.rectified) properties_.calibration = recording.calibration;
}

DepthGeometry MapGeometry::of(GstSample* map) {
  const GstStructure* const fields = gst_caps_get_structure(gst_sample_get_caps(map), 0);
  const Result<plugin::StereoGeometry> geometry = source_.geometry(fields, properties_);
  if (!geometry) throw UserError(geometry.error().message);
  return plugin::depth_geometry(*geometry, unit_of(map));
}

void write_png(GstSample* sample, const std::filesystem::path& file) {
  const Frame frame(sample);
  int type = CV_8UC1;
  if (frame.format() == GST_VIDEO_FORMAT_GRAY16_LE) type = CV_16UC1;
  if (frame.format() == GST_VIDEO_FORMAT_BGR) type = CV_8UC3;
  const GrayView view = frame.bytes();
  // The data is not written to.
  const cv::Mat image(view.height, view.width, type, const_cast<std::uint8_t*>(view.data),
                      static_cast<std::size_t>(view.stride));
  // Encoded in memory: OpenCV does not state why a file cannot be written.
  const std::string bytes = images::encode(".png", image);
  if (bytes.empty()) throw UserError(file.string() + ": cannot be encoded");
  outputs::write_file(file, bytes);
}

void write_disparity_pfm(GstSample* map, const std::filesystem::path& file) {
  const plugin::MapUnit unit = unit_of(map);
  std::vector<float> table(kValues, std::numeric_limits<float>::infinity());
  for (std::size_t value = 1; value < kValues; ++value) {
    table[value] = static_cast<float>(disparity_of(value, unit));
  }
  const Frame frame(map);
  write_pfm(frame.values(), table, file);
}

void write_depth_pfm(GstSample* map, const DepthGeometry& geometry, DepthLimits limits,
                     const std::filesystem::path& file) {
  std::vector<float> table(kValues);
  for (std::size_t value = 0; value < kValues; ++value) {
    const double depth = geometry.depth_of(static_cast<std::uint16_t>(value));
    table[value] = depth >= limits.near && depth <= limits.far
                       ? static_cast<float>(depth)
                       : std::numeric_limits<float>::infinity();
  }
  const Frame frame(map);
  write_pfm(frame.values(), table, file);
}

void write_points(GstSample* map, GstSample* view, const DepthGeometry& geometry,
                  DepthLimits limits, const std::filesystem::path& file) {
  const Frame disparity(map);
  const Frame color(view);
  CloudInput input;
  input.disparity = disparity.values();
  input.color = color.bytes();
  input.color_channels = 3;
  std::optional<Frame> confidence;
  if (GstSample* sample = plugin::confidence_of(gst_sample_get_buffer(map))) {
    confidence.emplace(sample);
    input.confidence = confidence->bytes();
  }
  std::vector<CloudPoint> points;
  CloudOptions options;
  options.near = limits.near;
  options.far = limits.far;
  Status status = make_cloud(input, geometry, options, points);
  if (!status) throw UserError(file.string() + ": " + status.error().message);
  status = write_cloud(points, CloudFormat::kPly, file.string());
  if (!status) throw WriteError(status.error().message);
}

}  // namespace mtstereo::run
