// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstbasetransform.h>

#include <string>

#include "shared/exception_guard.hpp"

// Why sink pads accept all caps when they are asked (ACCEPT_CAPS), and refuse some when their event
// arrives: GStreamer 1.22 asks the pad itself before it delivers a caps event, and an element whose
// answer is no never sees the event. The stream then ends with "not negotiated" in the source,
// which does not know why. A pad function cannot distinguish this question from one of another
// element, and answering a query must not post a message. So all questions are answered with yes,
// here only, and the event gets an error that says what to change. Caps queries are answered
// truthfully: where elements negotiate, they choose supported caps. Only interlaced video is
// offered as well, so that it gets the error that names deinterlace.

namespace mtstereo::plugin {

/// What the frames of a stream are: which element is missing upstream depends on it.
enum class FrameKind {
  kView,  ///< images of a camera
  kMap,   ///< disparity maps
};

/// Why frames with these caps cannot enter a pad that accepts `accepted`, and how to correct it, as
/// a clause: "it is audio/x-raw, but ..."; "" if they can. Only fields that are there are compared:
/// a framerate, for example, may be missing.
std::string caps_problem(const GstCaps* caps, const GstCaps* accepted, FrameKind kind);

/// To be called for each event of a sink pad, before it is handled. False if it brings caps that
/// the template of the pad does not accept: an error was posted then, one for each stream.
bool allows_caps(gpointer element, GstPad* pad, GstEvent* event, FrameKind kind);

/// The sink_event() of a filter that checks the caps.
template <FrameKind kKind>
gboolean checked_sink_event(GstBaseTransform* transform, GstEvent* event) {
  if (!allows_caps(transform, GST_BASE_TRANSFORM_SINK_PAD(transform), event, kKind)) {
    gst_event_unref(event);
    return FALSE;
  }
  const gpointer parent = g_type_class_peek_parent(GST_BASE_TRANSFORM_GET_CLASS(transform));
  return GST_BASE_TRANSFORM_CLASS(parent)->sink_event(transform, event);
}

/// Answers an ACCEPT_CAPS query of a sink pad. True: the query was one.
bool accepts_all_caps(GstQuery* query);

/// The accept_caps() of a filter that goes with it.
gboolean accept_all_caps(GstBaseTransform* transform, GstPadDirection direction, GstCaps* caps);

/// Lets a filter check the caps of its sink pad.
template <FrameKind kKind>
void check_sink_caps(GstBaseTransformClass* transform_class) {
  transform_class->sink_event = guarded<checked_sink_event<kKind>, FALSE>;
  transform_class->accept_caps = guarded<accept_all_caps, FALSE>;
}

}  // namespace mtstereo::plugin
