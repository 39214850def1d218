// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/engine.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "shared/frame_views.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

using Lock = std::lock_guard<std::mutex>;

void to_little_endian(ImageView<std::uint16_t> map) {
  if constexpr (std::endian::native == std::endian::big) {
    for (int y = 0; y < map.height; ++y) {
      std::uint16_t* row = map.row(y);
      for (int x = 0; x < map.width; ++x) row[x] = GUINT16_SWAP_LE_BE(row[x]);
    }
  }
}

/// A pair is compared with the last one if it follows within this number of frames or within this
/// time, in which a slow computer skips many.
constexpr guint64 kLongestGap = 5;
constexpr GstClockTime kShortestGap = GST_SECOND / 2;

}  // namespace

Status Engine::fit(const MatchSettings& settings) {
  if (has_revision(settings.revision)) return {};
  if (matcher_) {
    Status status = matcher_->set_parameters(settings.parameters);
    if (!status) return status;
  } else {
    Result<Matcher> made = Matcher::create(settings.parameters);
    if (!made) return made.error();
    matcher_.emplace(std::move(made.value()));
  }
  revision_ = settings.revision;
  return {};
}

void Engine::use(const MatchSettings& settings) {
  settings_ = settings;
  revision_ = settings.revision;
  if (logged_revision_ == settings.revision) return;
  logged_revision_ = settings.revision;
  GST_DEBUG_OBJECT(messages_.element(), "settings in effect:%s", settings.text().c_str());
  if (!settings.has_other_scale()) return;
  GST_INFO_OBJECT(
      messages_.element(), "disparity-scale=%d, with which max-disparity=%s fits in 16 bits",
      settings.disparity_scale, settings.parameters.text(Parameter::kMaxDisparity).c_str());
}

/// Publishes what is known about the alignment after a pair: the property `alignment-field`, the
/// fields of `stats`, the message, and a warning for each new problem.
void Engine::publish_alignment() {
  const AlignmentReport& report = alignment_.report();
  bool field_changed = false;
  {
    const Lock lock(mutex_);
    field_changed = alignment_report_.current_field(settings_.alignment) != report.field;
    alignment_report_ = report;
  }
  if (field_changed) g_object_notify(G_OBJECT(messages_.element()), "alignment-field");
  reports_.warn(alignment_.new_problems(), report);
  reports_.announce(report);
}

/// Warns once if the maps are nearly black, or the views too dark for better ones.
void Engine::warn_of_black_maps(GrayView left, GrayView right) {
  const auto density =
      black_maps_.mean(result_.statistics.density, alignment_.report().problems != 0);
  if (!density) return;
  const bool sparse = settings_.parameters.text(Parameter::kMode) == "sparse";
  const std::string text = black_maps_text(*density, sparse, left, right);
  if (text.empty()) return;
  messages_.warning(text);
  black_maps_.report();
}

/// Inspects, corrects and matches a pair.
Status Engine::match_views(const MappedFrame& left_frame, const MappedFrame& right_frame,
                           ImageView<std::uint16_t> map) {
  const gint64 start = g_get_monotonic_time();
  const GrayView left = luma_[0].read(left_frame);
  const GrayView right = luma_[1].read(right_frame);
  const Status prepared = alignment_.prepare(settings_.alignment, left, right, *matcher_);
  if (!prepared) return prepared;
  inspection_ms_ = static_cast<double>(g_get_monotonic_time() - start) / 1000;
  publish_alignment();
  const Result<FrameResult> result = matcher_->compute(left, right);
  if (!result) return result.error();
  result_ = *result;
  warn_of_black_maps(left, right);
  return write_disparity16(result_.disparity, settings_.disparity_scale, map);
}

GstFlowReturn Engine::refuse_frame(const char* source, const MappedFrame& frame) {
  messages_.error(GST_STREAM_ERROR, GST_STREAM_ERROR_FAILED,
                  std::string("A frame from ") + source + " does not match its caps: " +
                      frame.problem() + ". The fault is in the element that allocated the frame.");
  return GST_FLOW_ERROR;
}

GstFlowReturn Engine::compute(GstBuffer* left, GstBuffer* right, GstBuffer* map,
                              const GstVideoInfo& map_info) {
  const MappedFrame left_frame(formats_[Side::kLeft].video, left, GST_MAP_READ);
  if (!left_frame.mapped()) return refuse_frame("sink_left", left_frame);
  const MappedFrame right_frame(formats_[Side::kRight].video, right, GST_MAP_READ);
  if (!right_frame.mapped()) return refuse_frame("sink_right", right_frame);
  const MappedFrame output(map_info, map, GST_MAP_WRITE);
  if (!output.mapped()) return refuse_frame("the buffer pool of downstream", output);

  const Status status = match_views(left_frame, right_frame, output.gray16());
  if (!status) {
    const bool memory = status.error().code == ErrorCode::kOutOfMemory;
    messages_.error(memory ? GST_RESOURCE_ERROR : GST_LIBRARY_ERROR,
                    memory ? static_cast<gint>(GST_RESOURCE_ERROR_NO_SPACE_LEFT)
                           : static_cast<gint>(GST_LIBRARY_ERROR_FAILED),
                    status.error().message);
    return GST_FLOW_ERROR;
  }
  borders_.take(left, right,
                {map_info.width, map_info.height, border_margin(settings_.parameters.preset())});
  border_pixels_ = borders_.any() ? borders_.remove(output.gray16(), settings_.unit()) : 0;
  to_little_endian(output.gray16());
  return GST_FLOW_OK;
}

/// True if the pair may be compared with the last one.
bool Engine::continues(GstBuffer* left, GstBuffer* right) const {
  if (GST_BUFFER_IS_DISCONT(left) || GST_BUFFER_IS_DISCONT(right)) return false;
  const GstClockTime time = GST_BUFFER_PTS(left);
  if (!GST_CLOCK_TIME_IS_VALID(time) || !GST_CLOCK_TIME_IS_VALID(last_time_)) return true;
  const GstClockTime gap = time > last_time_ ? time - last_time_ : last_time_ - time;
  const GstVideoInfo& video = formats_[Side::kLeft].video;
  const bool constant = GST_VIDEO_INFO_FPS_N(&video) > 0;
  const GstClockTime frames =
      constant ? gst_util_uint64_scale(kLongestGap * GST_SECOND, GST_VIDEO_INFO_FPS_D(&video),
                                       GST_VIDEO_INFO_FPS_N(&video))
               : 0;
  return gap <= std::max(kShortestGap, frames);
}

void Engine::count_pair(const GstVideoInfo& map_info) {
  const FrameStatistics& frame = result_.statistics;
  const bool chosen = settings_.parameters.text(Parameter::kResolution) == "auto";
  const bool half = chosen && frame.half_resolution;
  if (std::exchange(logged_half_, half) != half) {
    GST_INFO_OBJECT(messages_.element(),
                    "matched at %s resolution from this pair on: fine detail %.3f",
                    half ? "half" : "full", frame.fine_detail);
  }
  const double milliseconds = inspection_ms_ + frame.milliseconds;
  const double pixels = static_cast<double>(map_info.width) * map_info.height;
  const Lock lock(mutex_);
  ++statistics_.pairs;
  statistics_.last_ms = milliseconds;
  statistics_.total_ms += milliseconds;
  statistics_.half_resolution = frame.half_resolution;
  statistics_.fine_detail = frame.fine_detail;
  statistics_.density = std::max(frame.density - static_cast<double>(border_pixels_) / pixels, 0.0);
}

GstFlowReturn Engine::match(GstBuffer* left, GstBuffer* right, GstBuffer* map,
                            const GstVideoInfo& map_info) {
  if (!continues(left, right)) forget();
  last_time_ = GST_BUFFER_PTS(left);
  const GstFlowReturn flow = compute(left, right, map, map_info);
  if (flow != GST_FLOW_OK) return flow;
  set_disparity_unit(map, settings_.unit());
  if (settings_.confidence_map &&
      !confidence_.attach(result_.confidence, map, map_info, border_pixels_ > 0)) {
    messages_.error(GST_RESOURCE_ERROR, GST_RESOURCE_ERROR_NO_SPACE_LEFT,
                    "There is not enough memory for a confidence map of " +
                        std::to_string(map_info.width) + "x" + std::to_string(map_info.height) +
                        " px. Set confidence-map=false if it is not needed.");
    return GST_FLOW_ERROR;
  }
  count_pair(map_info);
  return GST_FLOW_OK;
}

void Engine::restart() {
  alignment_.restart();
  if (matcher_) matcher_->restart();
}

void Engine::forget() {
  if (matcher_) matcher_->forget();
}

void Engine::start() {
  alignment_ = PairAlignment();
  reports_.restart();
  black_maps_ = {};
  logged_half_ = false;
  const Lock lock(mutex_);
  statistics_ = {};
  alignment_report_ = {};
}

void Engine::stop() {
  matcher_.reset();
  result_ = {};
  logged_revision_.reset();
  alignment_ = PairAlignment();
  confidence_.clear();
  for (LumaReader& luma : luma_) luma.clear();
  borders_ = {};
}

MatchStatistics Engine::statistics() const {
  const Lock lock(mutex_);
  return statistics_;
}

AlignmentReport Engine::alignment() const {
  const Lock lock(mutex_);
  return alignment_report_;
}

}  // namespace mtstereo::plugin
