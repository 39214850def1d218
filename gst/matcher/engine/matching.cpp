// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/matching.hpp"

#include <algorithm>
#include <bit>

#include "matcher/alignment_reports.hpp"
#include "matcher/engine/confidence.hpp"
#include "matcher/output/allocation.hpp"
#include "matcher/output/skipping.hpp"
#include "matcher/settings.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/frame_views.hpp"
#include "shared/stereo_geometry.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

OutputTimes output_times(const ElementState& state, GstBuffer* left) {
  OutputTimes times;
  if (!GST_BUFFER_PTS_IS_VALID(left)) return times;
  const ObjectLock lock(state.element);
  const GstSegment& segment = GST_AGGREGATOR_PAD(state.source_pad())->segment;
  if (segment.format != GST_FORMAT_TIME) return times;
  times.running = gst_segment_to_running_time(&segment, GST_FORMAT_TIME, GST_BUFFER_PTS(left));
  times.stream = gst_segment_to_stream_time(&segment, GST_FORMAT_TIME, GST_BUFFER_PTS(left));
  return times;
}

/// A warning if the caps of the streams state two rectifications: once for each change of the caps.
void compare_geometry(ElementState& state) {
  if (state.geometry_compared) return;
  state.geometry_compared = true;
  std::array<std::optional<StereoGeometry>, 2> sides;
  for (const Side side : kSides) {
    const auto& fields = state.input(side).geometry;
    if (fields) sides[static_cast<std::size_t>(side)] = read_geometry(fields.get());
  }
  if (!sides[0] || !sides[1] || same_rectification(*sides[0], *sides[1])) return;
  const auto text = [](const StereoGeometry& geometry) {
    return "focal length " + std::to_string(geometry.focal_length) + " px, baseline " +
           std::to_string(geometry.baseline) + " m, principal offset " +
           std::to_string(geometry.principal_offset) + " px";
  };
  post_warning(
      state,
      "The two streams are not rectified as a pair: their caps state different focal "
      "lengths, baselines or principal offsets. Give both mtrectify the same calibration "
      "and the same alpha, size and zero-disparity. The values of the left stream are "
      "used.",
      "left: " + text(*sides[0]) + "; right: " + text(*sides[1]) + "; " + state.streams_text());
}

bool check_streams(ElementState& state) {
  const Input& left = state.input(Side::kLeft);
  const Input& right = state.input(Side::kRight);
  if (!left.has_caps || !right.has_caps) {
    post_error(state, GST_CORE_ERROR, GST_CORE_ERROR_NEGOTIATION,
               std::string("Frames arrived on ") +
                   pad_name(left.has_caps ? Side::kRight : Side::kLeft) +
                   " before any caps. Put a capsfilter upstream of it.",
               state.streams_text());
    return false;
  }
  if (left.info.width == right.info.width && left.info.height == right.info.height) {
    compare_geometry(state);
    return true;
  }
  const auto size = [](const GstVideoInfo& info) {
    return std::to_string(info.width) + "x" + std::to_string(info.height);
  };
  post_error(state, GST_STREAM_ERROR, GST_STREAM_ERROR_WRONG_TYPE,
             "The two streams have different sizes: left " + size(left.info) + ", right " +
                 size(right.info) +
                 ". Both frames of a rectified pair must have the same size: set both cameras to "
                 "the same size, or put videoscale and a capsfilter upstream of one pad.",
             state.streams_text());
  return false;
}

/// The caps of the left stream have changed since the base class has called.
bool renegotiate(ElementState& state) {
  return !gst_pad_check_reconfigure(state.source_pad()) || gst_aggregator_negotiate(state.element);
}

/// Applies settings that have changed since the last pair. Some of them are part of the caps.
bool refresh_settings(ElementState& state) {
  const DisparityUnit last = unit_of(state.active);
  if (!apply_settings(state)) return false;
  if (unit_of(state.active) == last && gst_pad_has_current_caps(state.source_pad())) return true;
  return gst_aggregator_negotiate(state.element);
}

GstFlowReturn refuse_frame(ElementState& state, const char* source, const std::string& problem) {
  post_error(state, GST_STREAM_ERROR, GST_STREAM_ERROR_FAILED,
             std::string("A frame from ") + source + " does not match its caps: " + problem +
                 ". The fault is in the element that allocated the frame.",
             state.streams_text());
  return GST_FLOW_ERROR;
}

void to_little_endian(ImageView<std::uint16_t> map) {
  if constexpr (std::endian::native == std::endian::big) {
    for (int y = 0; y < map.height; ++y) {
      std::uint16_t* row = map.row(y);
      for (int x = 0; x < map.width; ++x) row[x] = GUINT16_SWAP_LE_BE(row[x]);
    }
  }
}

/// Inspects, corrects and matches a pair.
Status match_views(ElementState& state, const MappedFrame& left_frame,
                   const MappedFrame& right_frame, ImageView<std::uint16_t> map) {
  const gint64 start = g_get_monotonic_time();
  const GrayView left = state.luma[0].read(left_frame);
  const GrayView right = state.luma[1].read(right_frame);
  const Status prepared =
      state.alignment.prepare(state.active.alignment, left, right, *state.matcher);
  if (!prepared) return prepared;
  state.inspection_ms = static_cast<double>(g_get_monotonic_time() - start) / 1000;
  publish_alignment(state);
  const Result<DisparityView> disparity = state.matcher->compute(left, right);
  if (!disparity) return disparity.error();
  return write_disparity16(*disparity, state.active.disparity_scale, map);
}

/// Computes the output from the two frames. Posts an error if it does not return GST_FLOW_OK.
GstFlowReturn compute(ElementState& state, GstBuffer* left, GstBuffer* right, GstBuffer* output) {
  const MappedFrame left_frame(state.input(Side::kLeft).info, left, GST_MAP_READ);
  if (!left_frame.mapped()) return refuse_frame(state, "sink_left", left_frame.problem());
  const MappedFrame right_frame(state.input(Side::kRight).info, right, GST_MAP_READ);
  if (!right_frame.mapped()) return refuse_frame(state, "sink_right", right_frame.problem());
  const MappedFrame map(state.output, output, GST_MAP_WRITE);
  if (!map.mapped()) return refuse_frame(state, "the buffer pool of downstream", map.problem());

  const Status status = match_views(state, left_frame, right_frame, map.gray16());
  if (!status) {
    const bool memory = status.error().code == ErrorCode::kOutOfMemory;
    post_error(state, memory ? GST_RESOURCE_ERROR : GST_LIBRARY_ERROR,
               memory ? static_cast<gint>(GST_RESOURCE_ERROR_NO_SPACE_LEFT)
                      : static_cast<gint>(GST_LIBRARY_ERROR_FAILED),
               status.error().message, state.streams_text());
    return GST_FLOW_ERROR;
  }
  state.borders.take(
      left, right,
      {state.output.width, state.output.height, border_margin(state.active.parameters.preset())});
  state.border_pixels =
      state.borders.any() ? state.borders.remove(map.gray16(), unit_of(state.active)) : 0;
  to_little_endian(map.gray16());
  return GST_FLOW_OK;
}

/// Logs which resolution the matcher has chosen if it is another one than that of the last pair.
void log_resolution(ElementState& state, const FrameStatistics& frame) {
  const bool chosen = state.active.parameters.text(Parameter::kResolution) == "auto";
  const bool half = chosen && frame.half_resolution;
  if (half == state.logged_half_resolution) return;
  state.logged_half_resolution = half;
  GST_INFO_OBJECT(state.element, "matched at %s resolution from this pair on: fine detail %.3f",
                  half ? "half" : "full", frame.fine_detail);
}

void count_pair(ElementState& state) {
  const FrameStatistics frame = state.matcher->statistics();
  log_resolution(state, frame);
  const double milliseconds = state.inspection_ms + frame.milliseconds;
  const double pixels = static_cast<double>(state.output.width) * state.output.height;
  const ObjectLock lock(state.element);
  ++state.statistics.pairs;
  state.statistics.last_ms = milliseconds;
  state.statistics.total_ms += milliseconds;
  state.statistics.half_resolution = frame.half_resolution;
  state.statistics.fine_detail = frame.fine_detail;
  state.statistics.density =
      std::max(frame.density - static_cast<double>(state.border_pixels) / pixels, 0.0);
}

void advance_position(const ElementState& state, GstBuffer* left) {
  if (!GST_BUFFER_PTS_IS_VALID(left)) return;
  const ObjectLock lock(state.element);
  GstSegment& segment = GST_AGGREGATOR_PAD(state.source_pad())->segment;
  segment.position = GST_BUFFER_PTS(left);
  if (segment.rate > 0 && GST_BUFFER_DURATION_IS_VALID(left)) {
    segment.position += GST_BUFFER_DURATION(left);
  }
}

}  // namespace

GstFlowReturn match_pair(ElementState& state, GstBuffer* left, GstBuffer* right) {
  const OutputTimes times = output_times(state, left);
  if (GST_CLOCK_TIME_IS_VALID(times.stream)) {
    gst_object_sync_values(GST_OBJECT_CAST(state.element), times.stream);
  }
  if (!check_streams(state)) return GST_FLOW_ERROR;
  if (!renegotiate(state) || !refresh_settings(state)) {
    // A flush in the meantime is not a failure; the base class handles it.
    return GST_PAD_IS_FLUSHING(state.source_pad()) ? GST_FLOW_FLUSHING : GST_FLOW_ERROR;
  }
  // No gap is sent: a sink would wait until the time of the gap, and more pairs would be late.
  if (skip_late_pair(state, left, times)) return GST_FLOW_OK;
  const gint64 start = g_get_monotonic_time();
  gst_aggregator_selected_samples(state.element, GST_BUFFER_PTS(left), GST_CLOCK_TIME_NONE,
                                  GST_BUFFER_DURATION(left), nullptr);

  BufferPointer output;
  GstFlowReturn flow = acquire_output(state, output);
  if (flow == GST_FLOW_ERROR) {
    post_error(state, GST_RESOURCE_ERROR, GST_RESOURCE_ERROR_NO_SPACE_LEFT,
               "There is not enough memory for a disparity map of " +
                   std::to_string(state.output.size) + " bytes.",
               state.streams_text());
  }
  if (flow != GST_FLOW_OK) return flow;
  flow = compute(state, left, right, output.get());
  if (flow != GST_FLOW_OK) return flow;
  copy_frame_properties(left, right, output.get());
  set_disparity_unit(output.get(), unit_of(state.active));
  if (state.active.confidence_map && !attach_confidence(state, output.get())) return GST_FLOW_ERROR;
  count_pair(state);
  advance_position(state, left);
  state.segment = OutputSegment::kSent;  // by the base class, before the buffer
  note_sent_map(state, times, static_cast<double>(g_get_monotonic_time() - start) / 1000);
  GST_LOG_OBJECT(state.element, "matched %" GST_PTR_FORMAT, static_cast<void*>(output.get()));
  return gst_aggregator_finish_buffer(state.element, output.release());
}

}  // namespace mtstereo::plugin
