// SPDX-License-Identifier: LGPL-2.1-or-later

// Replaces h264.cpp in a build without GStreamer.

#include "lib/outputs/user_error.hpp"
#include "tools/eval/h264.hpp"

namespace mtstereo::eval {

std::optional<std::string> h264_obstacle() {
  return "this program was built without GStreamer: build it with the Debian package "
         "libgstreamer-plugins-base1.0-dev";
}

cv::Mat through_h264(const cv::Mat&, int) { throw UserError("h264: " + *h264_obstacle()); }

}  // namespace mtstereo::eval
