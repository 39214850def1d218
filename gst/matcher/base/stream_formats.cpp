// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/base/stream_formats.hpp"

namespace mtstereo::plugin {

bool StreamFormats::adopt(Side side, const std::shared_ptr<const StreamInfo>& info) {
  auto& adopted = adopted_[index_of(side)];
  if (!info || info == adopted) return false;
  adopted = info;
  formats_[index_of(side)].video = info->video;
  formats_[index_of(side)].geometry = info->geometry;
  return true;
}

void StreamFormats::clear() {
  for (const Side side : kSides) set_known(side, false);
  adopted_ = {};
}

std::string StreamFormats::text() const {
  std::string text;
  for (const Side side : kSides) {
    if (!text.empty()) text += "; ";
    text += std::string(pad_name(side)) + ": ";
    const StreamFormat& format = (*this)[side];
    if (!format.has_caps) {
      text += "no caps yet";
      continue;
    }
    text += std::string(gst_video_format_to_string(GST_VIDEO_INFO_FORMAT(&format.video))) + " " +
            std::to_string(format.video.width) + "x" + std::to_string(format.video.height) +
            " at " + std::to_string(format.video.fps_n) + "/" + std::to_string(format.video.fps_d) +
            " fps";
  }
  return text;
}

}  // namespace mtstereo::plugin
