// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/app/gstappsink.h>
#include <gst/gst.h>

#include <memory>
#include <string>

#include "shared/ownership.hpp"

namespace mtstereo::run {

using plugin::BufferPointer;
using plugin::CapsPointer;
using plugin::SamplePointer;

/// Initializes GStreamer; further calls have no effect. Throws UserError.
void start_gstreamer();

/// Stops a pipeline and releases it, or releases an element.
struct StopElement {
  void operator()(GstElement* element) const;
};
using Pipeline = std::unique_ptr<GstElement, StopElement>;
/// A reference of an element in a pipeline.
struct UnrefElement {
  void operator()(GstElement* element) const { gst_object_unref(element); }
};
using ElementPointer = std::unique_ptr<GstElement, UnrefElement>;

/// The pipeline of a gst-launch line. Throws UserError, for example if an element is not installed.
Pipeline parse_pipeline(const std::string& line);
/// An element of the pipeline by its name; null if there is none.
ElementPointer element_of(const Pipeline& pipeline, const std::string& name);

/// The next error that an element has posted; empty if there is none.
std::string posted_error(const Pipeline& pipeline);

/// Whether a thread of the pipeline reads or processes data. Errors of a demultiplexer that starts
/// are not always reported by parsebin and decodebin: then nothing runs, and nothing is posted.
bool is_running(GstElement* pipeline);

/// One attempt to take a frame from a sink.
enum class Taken { kFrame, kNothingYet, kEnd };
/// Waits for a frame for a part of a second.
Taken take_sample(GstElement* sink, SamplePointer& sample);

}  // namespace mtstereo::run
