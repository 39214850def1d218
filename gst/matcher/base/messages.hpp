// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <atomic>
#include <string>

#include "matcher/base/stream_formats.hpp"

namespace mtstereo::plugin {

/// The debug category of the element.
GST_DEBUG_CATEGORY_EXTERN(mtstereo_debug);

/// What to do about a pad that is not linked, as a sentence.
std::string how_to_link(Side side);

/// The errors and warnings of the element. `text` is for the user: what is wrong and how to correct
/// it; `facts` are details. Call it without locks.
class Messages {
 public:
  Messages(GstElement* element, const StreamFormats& formats)
      : element_(element), formats_(formats) {}

  // In the task of the source pad: the details end with the formats of both streams.

  /// Posts an error, unless one was posted since the start or the last flush: a second one would
  /// hide it.
  void error(GQuark domain, gint code, const std::string& text, const std::string& facts = {});
  void warning(const std::string& text, const std::string& facts = {});
  /// The same for a value of a property, or several, that is refused.
  void settings_warning(const std::string& text, const std::string& facts = {});

  // Any thread.

  void error_of_pad(const std::string& text, const std::string& details);
  void warning_of_pad(const std::string& text, const std::string& details);
  void warning_of_property(const std::string& text, const std::string& details);

  /// True if the element has failed since the start or the last flush: no frame is matched.
  bool failed() const { return failed_; }
  /// An exception was reported.
  void fail() { failed_ = true; }
  /// The start, or a flush.
  void clear() { failed_ = false; }

  GstElement* element() const { return element_; }

 private:
  void post_error(GQuark domain, gint code, const std::string& text, const std::string& details);
  void post(GstMessageType type, GQuark domain, gint code, const std::string& text,
            const std::string& details) const;
  std::string with_formats(const std::string& facts) const;

  GstElement* const element_;
  const StreamFormats& formats_;
  std::atomic<bool> failed_ = false;
};

}  // namespace mtstereo::plugin
