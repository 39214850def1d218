// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <filesystem>
#include <string>

namespace mtstereo::media {

/// What to do without a plugin, such as "H.264 decoder".
std::string without_plugin(const std::string& missing);

/// Why a pipeline ends without a frame and without an error; `decodes` if a decoder has got one.
std::string without_frames(bool decodes);

/// The message for an image that cannot be read.
std::string unreadable_image(const std::filesystem::path& image);

/// What an error message of a pipeline that decodes a file means, and what to do.
std::string decoding_problem(GstMessage* message);

}  // namespace mtstereo::media
