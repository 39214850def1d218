// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "recordings/media/container_bytes.hpp"

namespace mtstereo::run {

/// Whether a file is one of MP4 or QuickTime.
bool is_mp4(Bytes& bytes);
/// has_second_view() of MP4 and QuickTime.
bool second_view_in_mp4(Bytes& bytes);
/// missing_end() of MP4 and QuickTime.
std::string missing_of_mp4(Bytes& bytes);
/// damaged_parts() of MP4 and QuickTime: a track whose frames have more bytes than the file has for
/// all of its data. Demultiplexers end at such a frame as at the end of the file.
DamagedParts damage_of_mp4(Bytes& bytes);

}  // namespace mtstereo::run
