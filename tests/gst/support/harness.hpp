// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/check/gstharness.h>
#include <gst/gst.h>

#include <memory>

namespace mtstereo::test {

/// The deleter of the owning pointers below.
struct Unref {
  void operator()(GstBuffer* buffer) const { gst_buffer_unref(buffer); }
  void operator()(GstCaps* caps) const { gst_caps_unref(caps); }
  void operator()(GstEvent* event) const { gst_event_unref(event); }
  void operator()(GstStructure* structure) const { gst_structure_free(structure); }
  void operator()(GstMessage* message) const { gst_message_unref(message); }
};
using BufferPointer = std::unique_ptr<GstBuffer, Unref>;
using CapsPointer = std::unique_ptr<GstCaps, Unref>;
using EventPointer = std::unique_ptr<GstEvent, Unref>;
using StructurePointer = std::unique_ptr<GstStructure, Unref>;
using MessagePointer = std::unique_ptr<GstMessage, Unref>;

/// As gst_harness_new_with_element(), but of a stream that is live, or not, from the start: the
/// element asks for it in its own thread as soon as it plays, and remembers the answer.
inline GstHarness* new_harness(GstElement* element, const char* sink, const char* source,
                               bool live) {
  static GstStaticPadTemplate frames =
      GST_STATIC_PAD_TEMPLATE("src", GST_PAD_SRC, GST_PAD_ALWAYS, GST_STATIC_CAPS_ANY);
  static GstStaticPadTemplate maps =
      GST_STATIC_PAD_TEMPLATE("sink", GST_PAD_SINK, GST_PAD_ALWAYS, GST_STATIC_CAPS_ANY);
  GstHarness* harness = gst_harness_new_empty();
  gst_harness_set_live(harness, live);
  gst_harness_add_element_full(harness, element, &frames, sink, &maps, source);
  return harness;
}

}  // namespace mtstereo::test
