// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "recordings/media/source.hpp"

namespace mtstereo::run {

/// The frames of one source in the order in which they are shown. The n-th frame is the one with
/// the n-th time: pieces of a recording select frames by it, never by seeking alone.
struct FrameIndex {
  /// Stream times, increasing [ns]. A frame with the time of its predecessor is not listed.
  std::vector<Nanoseconds> times;
  int width = 0, height = 0;  ///< of a frame [px]
  Nanoseconds period = 0;  ///< the median of the differences [ns]; of one image by the rate, or 0
  std::string codec;       ///< such as "H.264" or "PNG", for the report
  /// Why the source ends where it ends, if it is broken there ("the file is truncated after
  /// 12.3 s"), or how many frames within it cannot be decoded; empty if it is whole.
  std::string damage;
  /// The file states the time of some frames only, as AVI does: a frame is known by its position
  /// from the start, and not by its time after a seek.
  bool by_order = false;
  std::uintmax_t bytes = 0;  ///< of the files of the source; 0: not known
  /// What else is to be said about the source, as sentences for the user. The JSON of a work does
  /// not have them: they are among its own remarks.
  std::vector<std::string> remarks;
};

/// Lists the frames of a source. A video is demultiplexed and parsed, and decoded at its start and
/// its end. It is decoded as a whole only if the frames that the decoder shows there are not those
/// of the parser, if it is short, or if its codec has frames that are not shown. Frames before the
/// damage of a broken file are listed. Throws UserError if there is no frame at all.
FrameIndex index_frames(const Source& source, double frame_rate);

}  // namespace mtstereo::run
