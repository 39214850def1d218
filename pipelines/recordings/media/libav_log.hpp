// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <cstdint>
#include <memory>
#include <string>

namespace mtstereo::run {

/// Receives the errors of a decoder.
class LibavErrors {
 public:
  LibavErrors() = default;
  virtual ~LibavErrors() = default;
  LibavErrors(const LibavErrors&) = delete;
  LibavErrors& operator=(const LibavErrors&) = delete;

  /// An error about a frame by its number: frames count from 0 as they are begun.
  virtual void add_of(std::int64_t number, const std::string& reason) = 0;
};

/// Passes the errors that libav reports about frames of a decoder on, from whichever thread, until
/// the receiver ends. The log of GStreamer shows what it showed before.
void receive_errors_of_libav(GstElement* decoder, const std::shared_ptr<LibavErrors>& receiver);

}  // namespace mtstereo::run
