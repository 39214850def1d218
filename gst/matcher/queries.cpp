// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/queries.hpp"

#include <algorithm>
#include <optional>

#include "matcher/negotiation.hpp"
#include "shared/caps_check.hpp"
#include "shared/ownership.hpp"

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

/// A seek is sent to both streams, so both must be seekable.
void answer_seeking(const ElementState& state, GstQuery* query) {
  GstFormat format = GST_FORMAT_UNDEFINED;
  gst_query_parse_seeking(query, &format, nullptr, nullptr, nullptr);
  const Seekable left = ask_seekable(GST_PAD_CAST(state.pairing.pad(Side::kLeft)), format);
  const Seekable right = ask_seekable(GST_PAD_CAST(state.pairing.pad(Side::kRight)), format);
  if (format != GST_FORMAT_TIME || !left.known || !right.known) {
    gst_query_set_seeking(query, format, FALSE, 0, -1);
    return;
  }
  const gint64 stop = left.stop < 0    ? right.stop
                      : right.stop < 0 ? left.stop
                                       : std::min(left.stop, right.stop);
  gst_query_set_seeking(query, format, left.seekable && right.seekable,
                        std::max(left.start, right.start), stop);
}

/// The duration of a stream; std::nullopt if it is not known.
std::optional<gint64> ask_duration(GstPad* sink, GstFormat format) {
  gint64 duration = -1;
  if (!gst_pad_peer_query_duration(sink, format, &duration) || duration < 0) return std::nullopt;
  return duration;
}

/// The output ends with the shorter stream.
bool answer_duration(const ElementState& state, GstQuery* query) {
  GstFormat format = GST_FORMAT_UNDEFINED;
  gst_query_parse_duration(query, &format, nullptr);
  auto duration = ask_duration(GST_PAD_CAST(state.pairing.pad(Side::kLeft)), format);
  if (format == GST_FORMAT_TIME) {
    const auto right = ask_duration(GST_PAD_CAST(state.pairing.pad(Side::kRight)), format);
    if (right) duration = std::min(*right, duration.value_or(*right));
  }
  if (!duration) return false;
  gst_query_set_duration(query, format, *duration);
  return true;
}

/// The position of the last map, or of the left stream before the first map.
bool answer_position(const ElementState& state, GstQuery* query) {
  GstFormat format = GST_FORMAT_UNDEFINED;
  gst_query_parse_position(query, &format, nullptr);
  if (format == GST_FORMAT_TIME) {
    const ObjectLock lock(state.element);
    const GstSegment& segment = GST_AGGREGATOR_PAD(state.output.pad())->segment;
    if (segment.format == GST_FORMAT_TIME && GST_CLOCK_TIME_IS_VALID(segment.position)) {
      const guint64 time = gst_segment_to_stream_time(&segment, GST_FORMAT_TIME, segment.position);
      if (GST_CLOCK_TIME_IS_VALID(time)) {
        gst_query_set_position(query, format, static_cast<gint64>(time));
        return true;
      }
    }
  }
  return gst_pad_peer_query(GST_PAD_CAST(state.pairing.pad(Side::kLeft)), query) != FALSE;
}

/// Adds the matching time to the latency that the base class reports.
void add_processing_latency(const ElementState& state, GstQuery* query) {
  gboolean live = FALSE;
  GstClockTime minimum = 0;
  GstClockTime maximum = GST_CLOCK_TIME_NONE;
  gst_query_parse_latency(query, &live, &minimum, &maximum);
  if (!live) return;
  const GstClockTime processing = state.output.punctuality.processing_time();
  minimum += processing;
  if (GST_CLOCK_TIME_IS_VALID(maximum)) maximum += processing;
  gst_query_set_latency(query, live, minimum, maximum);
}

}  // namespace

bool answer_sink_query(ElementState& state, GstAggregatorPad* pad, GstQuery* query) {
  if (accepts_all_caps(query)) return true;
  if (GST_QUERY_TYPE(query) != GST_QUERY_CAPS) {
    return state.base_class->sink_query(state.element, pad, query) != FALSE;
  }
  GstCaps* filter = nullptr;
  gst_query_parse_caps(query, &filter);
  gst_query_set_caps_result(query, sink_caps(state, state.pairing.side_of(pad), filter).get());
  return true;
}

bool answer_source_query(ElementState& state, GstQuery* query) {
  switch (GST_QUERY_TYPE(query)) {
    case GST_QUERY_SEEKING:
      answer_seeking(state, query);
      return true;
    case GST_QUERY_POSITION:
      return answer_position(state, query);
    case GST_QUERY_DURATION:
      return answer_duration(state, query);
    default:
      break;
  }
  if (!state.base_class->src_query(state.element, query)) return false;
  if (GST_QUERY_TYPE(query) == GST_QUERY_LATENCY) add_processing_latency(state, query);
  return true;
}

}  // namespace mtstereo::plugin
