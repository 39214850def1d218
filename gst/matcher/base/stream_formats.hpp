// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <array>
#include <memory>
#include <string>

#include "matcher/base/sides.hpp"

namespace mtstereo::plugin {

/// What the caps of a stream state.
struct StreamInfo {
  GstVideoInfo video{};
  std::shared_ptr<const GstStructure> geometry;  ///< only the fields kGeometryFields
};

/// The format of the frames of one stream that are matched now.
struct StreamFormat {
  bool has_caps = false;
  GstVideoInfo video{};                          ///< valid if has_caps
  std::shared_ptr<const GstStructure> geometry;  ///< nullptr: no caps yet
};

/// The formats of both streams: of the frames at the heads of the queues, not of those that arrive.
/// Used by the task of the source pad, and by start and stop while the task does not run.
class StreamFormats {
 public:
  const StreamFormat& operator[](Side side) const { return formats_[index_of(side)]; }

  /// Caps have arrived, whose frames may come later; or caps were refused.
  void set_known(Side side, bool known) { formats_[index_of(side)].has_caps = known; }
  /// Frames with these caps are matched from now on. False if they are so already.
  bool adopt(Side side, const std::shared_ptr<const StreamInfo>& info);
  /// True if frames of this side have been adopted since the start.
  bool adopted(Side side) const { return adopted_[index_of(side)] != nullptr; }
  void clear();

  /// A description for messages: "sink_left: GRAY8 640x480 at 30/1 fps; sink_right: ...".
  std::string text() const;

 private:
  std::array<StreamFormat, 2> formats_;
  std::array<std::shared_ptr<const StreamInfo>, 2> adopted_;
};

}  // namespace mtstereo::plugin
