// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

// By hand on purpose: demultiplexers skip what is cut off or damaged without a report.

namespace mtstereo::run {

/// Whether the end of a video file is missing, by the lengths that its container states (MP4 and
/// QuickTime, Matroska and WebM, AVI, MPEG-TS, Ogg, FLV, ASF): a sentence with the reason, or "" if
/// nothing is missing or the container does not state it. Reads only the headers of the container's
/// parts, and all of Ogg.
std::string missing_end(const std::filesystem::path& file);

/// Where a video file is damaged before its end, by the structure, the checksums and the counters
/// of its container (Matroska and WebM, MPEG-TS, Ogg, FLV): a clause, or "" if they show nothing.
/// Demultiplexers skip such places, and the frames in them, without a report. Reads the whole file
/// if it has checksums or counters.
std::string damaged_parts(const std::filesystem::path& file);

/// Whether a file is an AVI file.
bool is_avi(const std::filesystem::path& file);
/// Whether a file is one of Matroska or WebM.
bool is_matroska(const std::filesystem::path& file);

/// Whether an MP4 or QuickTime file has a second view in its HEVC stream (MV-HEVC), as the spatial
/// videos of phones: decoders leave it out.
bool has_second_view(const std::filesystem::path& file);

/// Whether the last frame of an MPEG-TS may lack its end: the stream does not state the length of
/// its frames, and the last one fills its last packet, as one of 184 does that is whole.
bool may_lack_end(const std::filesystem::path& file);

}  // namespace mtstereo::run
