// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <memory>

namespace mtstereo::run {

class DecoderReports;

/// Passes the errors that libav reports about frames of a decoder on, from whichever thread, until
/// the receiver ends. The log of GStreamer shows what it showed before.
void receive_errors_of_libav(GstElement* decoder, const std::shared_ptr<DecoderReports>& receiver);

}  // namespace mtstereo::run
