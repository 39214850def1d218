// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <optional>

#include "matcher/base/messages.hpp"
#include "matcher/engine/alignment.hpp"

namespace mtstereo::plugin {

/// Adds the fields on alignment to a structure, for the property `stats` and the message
/// `mtstereo-alignment`.
void add_alignment_fields(GstStructure* structure, const AlignmentReport& report);

/// The messages about the alignment of the views. Used by the task of the source pad.
class AlignmentReports {
 public:
  explicit AlignmentReports(Messages& messages) : messages_(messages) {}

  /// Posts a warning for each of these problems: a mask as in AlignmentReport.
  void warn(std::uint32_t problems, const AlignmentReport& report);
  /// Announces a change of the correction. A change soon after another one is announced later,
  /// unless it was undone.
  void announce(const AlignmentReport& report);
  void restart() { announced_ = {}, time_.reset(); }

 private:
  Messages& messages_;
  ViewCorrection announced_;    // in the last message
  std::optional<gint64> time_;  // of the last message, wall clock [us]
};

}  // namespace mtstereo::plugin
