// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

namespace mtstereo::run {

/// Whether the end of a video file is missing, by the lengths that its container states (MP4 and
/// QuickTime, Matroska and WebM, AVI, MPEG-TS): a sentence with the reason, or "" if nothing is
/// missing or the container does not state it. Reads only the headers of the container's parts.
std::string missing_end(const std::filesystem::path& file);

/// Whether a file is an AVI file.
bool is_avi(const std::filesystem::path& file);
/// Whether a file is one of Matroska or WebM.
bool is_matroska(const std::filesystem::path& file);

/// Whether the last frame of an MPEG-TS may lack its end: the stream does not state the length of
/// its frames, and the last one fills its last packet, as one of 184 does that is whole.
bool may_lack_end(const std::filesystem::path& file);

}  // namespace mtstereo::run
