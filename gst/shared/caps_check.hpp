// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstbasetransform.h>

#include <string>

#include "shared/exception_guard.hpp"

// Caps that a pad refuses in a query end the stream with an error of the source, which does not
// know why. Sink pads therefore accept all caps in the query, and refuse them when their event
// arrives, with an error that says why.

namespace mtstereo::plugin {

/// What the frames of a stream are: which element is missing upstream depends on it.
enum class FrameKind {
  kView,  ///< pictures of a camera
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

/// The accept_caps() that goes with it.
gboolean accept_all_caps(GstBaseTransform* transform, GstPadDirection direction, GstCaps* caps);

/// Lets a filter check the caps of its sink pad.
template <FrameKind kKind>
void check_sink_caps(GstBaseTransformClass* transform_class) {
  transform_class->sink_event = guarded<checked_sink_event<kKind>, FALSE>;
  transform_class->accept_caps = guarded<accept_all_caps, FALSE>;
}

}  // namespace mtstereo::plugin
