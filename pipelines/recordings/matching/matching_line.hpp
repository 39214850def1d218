// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "recordings/matching/piece.hpp"
#include "recordings/media/gst_objects.hpp"

namespace mtstereo::run {

/// The names of the sinks of a matching pipeline that are not those of products.
inline constexpr const char* kMapSink = "maps";   ///< disparity maps
inline constexpr const char* kViewSink = "view";  ///< left views as RGB, for clouds

/// How the pairs of a piece are divided: lanes take pairs in turn, each with a matcher of its own.
/// Pairs side by side use the processors better than threads within a pair, and leave time for
/// decoders and encoders.
struct Lanes {
  int count = 1;
  int threads = 0;  ///< of the matcher of a lane; 0: all
};

/// The lanes for so many threads, 0 = one for each processor.
Lanes lanes_for(int threads);

/// The name of an element of a lane: "left0".
std::string lane_name(const std::string& name, int lane);

/// The pipeline that makes the products of a work: frames come into `left` and `right`, or `both`,
/// of each lane. Every sink of a lane gets one frame for each of its pairs. Throws UserError.
Pipeline matching_pipeline(const Work& work, Lanes lanes);

/// The pipeline up to the maps, with one lane and without products.
Pipeline map_pipeline(const Work& work);

}  // namespace mtstereo::run
