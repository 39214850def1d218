// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <mutex>
#include <optional>

#include "matcher/base/messages.hpp"
#include "matcher/engine/alignment_reports.hpp"
#include "matcher/engine/black_maps.hpp"
#include "matcher/engine/confidence.hpp"
#include "matcher/engine/match_settings.hpp"
#include "matcher/engine/view_borders.hpp"
#include "shared/luma.hpp"

namespace mtstereo::plugin {

/// The part of the property `stats` on matching.
struct MatchStatistics {
  guint64 pairs = 0;
  double last_ms = 0;            ///< time for the last pair: conversion, inspection and matching
  double total_ms = 0;           ///< of all pairs
  double density = 0;            ///< of the last pair
  bool half_resolution = false;  ///< the last pair was matched at half resolution
  double fine_detail = 0;        ///< of the last pair
};

/// Computes the disparity maps: the second station of a frame. Used by the task of the source pad,
/// and by start, stop and flush while the task does not run, except where a comment says otherwise.
class Engine {
 public:
  Engine(Messages& messages, const StreamFormats& formats)
      : messages_(messages), formats_(formats), reports_(messages) {}

  /// The settings in use.
  const MatchSettings& settings() const { return settings_; }
  /// True if the settings of this revision are in the matcher.
  bool has_revision(guint64 revision) const { return matcher_ && revision_ == revision; }
  /// Creates the matcher, or sets its parameters.
  Status fit(const MatchSettings& settings);
  /// Uses settings for which fit() has succeeded.
  void use(const MatchSettings& settings);

  /// Matches a pair. `map` has the size of the views, and times and metas of the output; it gets
  /// pixels, unit and confidence. Posts an error if it does not return GST_FLOW_OK.
  GstFlowReturn match(GstBuffer* left, GstBuffer* right, GstBuffer* map,
                      const GstVideoInfo& map_info);

  /// The output of a segment does not depend on earlier ones.
  void restart();
  /// The next map does not depend on the last one.
  void forget();
  void start();
  void stop();

  // Any thread.
  MatchStatistics statistics() const;
  AlignmentReport alignment() const;

 private:
  GstFlowReturn compute(GstBuffer* left, GstBuffer* right, GstBuffer* map,
                        const GstVideoInfo& map_info);
  Status match_views(const MappedFrame& left, const MappedFrame& right,
                     ImageView<std::uint16_t> map);
  GstFlowReturn refuse_frame(const char* source, const MappedFrame& frame);
  bool continues(GstBuffer* left, GstBuffer* right) const;
  void publish_alignment();
  void warn_of_black_maps(GrayView left, GrayView right);
  void count_pair(const GstVideoInfo& map_info);

  Messages& messages_;
  const StreamFormats& formats_;
  MatchSettings settings_;
  guint64 revision_ = 0;                    // of the matcher's parameters
  std::optional<guint64> logged_revision_;  // of the settings in the log
  std::optional<Matcher> matcher_;
  FrameResult result_;                            // of the last pair, in the memory of the matcher
  GstClockTime last_time_ = GST_CLOCK_TIME_NONE;  // of the last left frame
  std::array<LumaReader, 2> luma_;                // by side
  PairAlignment alignment_;
  AlignmentReports reports_;
  BlackMaps black_maps_;
  Borders borders_;         // of the last pair
  long border_pixels_ = 0;  // disparities that were removed from the last map, as in a border
  ConfidenceMaps confidence_;
  double inspection_ms_ = 0;  // time for the conversion and the inspection of the last pair
  bool logged_half_ = false;  // the last resolution in the log

  mutable std::mutex mutex_;  // guards the members below
  MatchStatistics statistics_;
  AlignmentReport alignment_report_;
};

}  // namespace mtstereo::plugin
