// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "recordings/matching/frame_feeder.hpp"
#include "recordings/matching/matching_line.hpp"

namespace mtstereo::run {

/// What a pipeline made of a pair.
struct PairResult {
  std::int64_t pair = 0;
  double matching_ms = 0;
  double fine_detail = 0;  ///< with resolution=auto: the detail of the views; 0: unknown
  double sharpness = 0;    ///< of the left view / the right one in the last inspection; 0: unknown
  SamplePointer map;
  std::map<Product, SamplePointer> products;  ///< of the sinks of products
  SamplePointer view;                         ///< the left view, for clouds
};

/// Runs pairs through the lanes of a matching pipeline, and returns them in their order.
class MatchingRun {
 public:
  /// Starts. `pairs` increase. `work` must outlive it. `earlier`: the notes of an interrupted run,
  /// for damage(). Throws UserError.
  MatchingRun(const Work& work, std::vector<std::int64_t> pairs, Pipeline pipeline, int lanes,
              std::vector<DamageNote> earlier = {});
  ~MatchingRun();
  MatchingRun(const MatchingRun&) = delete;
  MatchingRun& operator=(const MatchingRun&) = delete;

  /// The next pair; std::nullopt after the last one. Throws UserError.
  std::optional<PairResult> next();
  /// Why pairs are missing or damaged, after the last one; empty if none is.
  std::string damage() { return feeder_.damage(); }
  /// The damaged frames that were found up to this pair, but those of earlier calls.
  std::vector<DamageNote> take_notes(std::int64_t pair) { return feeder_.take_notes(pair); }
  /// The element mtstereo of the first lane.
  GstElement* matcher() const { return lanes_.front()->matcher.get(); }

 private:
  struct Sink {
    std::optional<Product> product;  // none: the left view
    ElementPointer element;
  };
  struct MapFigures {
    double milliseconds = 0, fine_detail = 0, sharpness = 0;
  };
  struct Lane {
    ElementPointer matcher, maps;
    std::vector<Sink> sinks;
    std::mutex mutex;
    std::deque<MapFigures> figures;  // of the maps that have left the matcher; mutex

    MapFigures next_figures();
  };
  static GstPadProbeReturn on_map(GstPad* pad, GstPadProbeInfo* info, gpointer lane) noexcept;
  void add_lane(int number);
  SamplePointer take(GstElement* sink);
  [[noreturn]] void fail(const std::string& reason);

  const Work& work_;
  Pipeline pipeline_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::size_t lane_ = 0;    // of the next pair
  std::int64_t last_ = -1;  // pair that was returned
  FrameFeeder feeder_;
};

}  // namespace mtstereo::run
