// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {
namespace {

struct Seekable {
  bool known = false;
  bool seekable = false;
  gint64 start = 0;
  gint64 stop = -1;
};

Seekable ask_seekable(GstPad* sink, GstFormat format) {
  Seekable answer;
  const QueryPointer query(gst_query_new_seeking(format));
  if (!gst_pad_peer_query(sink, query.get())) return answer;
  gboolean seekable = FALSE;
  gst_query_parse_seeking(query.get(), nullptr, &seekable, &answer.start, &answer.stop);
  answer.known = true;
  answer.seekable = seekable != FALSE;
  return answer;
}

/// A seek goes to both streams, so both have to be able to do it.
bool answer_seeking(const ElementState& state, GstQuery* query) {
  GstFormat format = GST_FORMAT_UNDEFINED;
  gst_query_parse_seeking(query, &format, nullptr, nullptr, nullptr);
  const Seekable left = ask_seekable(GST_PAD_CAST(state.input(Side::kLeft).pad), format);
  const Seekable right = ask_seekable(GST_PAD_CAST(state.input(Side::kRight).pad), format);
  if (format != GST_FORMAT_TIME || !left.known || !right.known) {
    gst_query_set_seeking(query, format, FALSE, 0, -1);
    return true;
  }
  const gint64 stop = left.stop < 0    ? right.stop
                      : right.stop < 0 ? left.stop
                                       : std::min(left.stop, right.stop);
  gst_query_set_seeking(query, format, left.seekable && right.seekable,
                        std::max(left.start, right.start), stop);
  return true;
}

std::optional<bool> answer_position(const ElementState& state, GstQuery* query) {
  GstFormat format = GST_FORMAT_UNDEFINED;
  gst_query_parse_position(query, &format, nullptr);
  if (format == GST_FORMAT_TIME) {
    const ObjectLock lock(state.element);
    const GstSegment& segment = GST_AGGREGATOR_PAD(state.source_pad())->segment;
    if (segment.format == GST_FORMAT_TIME && GST_CLOCK_TIME_IS_VALID(segment.position)) {
      const guint64 time = gst_segment_to_stream_time(&segment, GST_FORMAT_TIME, segment.position);
      if (GST_CLOCK_TIME_IS_VALID(time)) {
        gst_query_set_position(query, format, static_cast<gint64>(time));
        return true;
      }
    }
  }
  return gst_pad_peer_query(GST_PAD_CAST(state.input(Side::kLeft).pad), query) != FALSE;
}

}  // namespace

std::optional<bool> answer_source_query(ElementState& state, GstQuery* query) {
  switch (GST_QUERY_TYPE(query)) {
    case GST_QUERY_SEEKING:
      return answer_seeking(state, query);
    case GST_QUERY_POSITION:
      return answer_position(state, query);
    case GST_QUERY_DURATION:
      return gst_pad_peer_query(GST_PAD_CAST(state.input(Side::kLeft).pad), query) != FALSE;
    default:
      return std::nullopt;
  }
}

void add_processing_latency(ElementState& state, GstQuery* query) {
  gboolean live = FALSE;
  GstClockTime minimum = 0;
  GstClockTime maximum = GST_CLOCK_TIME_NONE;
  gst_query_parse_latency(query, &live, &minimum, &maximum);
  if (!live) return;
  GstClockTime processing = 0;
  {
    const ObjectLock lock(state.element);
    processing = static_cast<GstClockTime>(state.processing.reported_ms() * GST_MSECOND);
  }
  minimum += processing;
  if (GST_CLOCK_TIME_IS_VALID(maximum)) maximum += processing;
  gst_query_set_latency(query, live, minimum, maximum);
}

bool take_qos_event(ElementState& state, GstEvent* event) {
  gdouble proportion = 1;
  GstClockTimeDiff late = 0;
  GstClockTime time = GST_CLOCK_TIME_NONE;
  gst_event_parse_qos(event, nullptr, &proportion, &late, &time);
  const ObjectLock lock(state.element);
  state.qos_proportion = proportion;
  if (!GST_CLOCK_TIME_IS_VALID(time)) {
    state.qos_earliest = GST_CLOCK_TIME_NONE;
    return state.settings.qos;
  }
  const auto earliest = static_cast<GstClockTimeDiff>(time) + late;
  state.qos_earliest = earliest > 0 ? static_cast<GstClockTime>(earliest) : 0;
  return state.settings.qos;
}

}  // namespace mtstereo::plugin
