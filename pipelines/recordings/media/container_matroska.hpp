// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "recordings/media/container_bytes.hpp"

namespace mtstereo::run {

/// missing_end() of Matroska and WebM.
std::string missing_of_matroska(Bytes& bytes);
/// damaged_parts() of Matroska and WebM: invalid elements, and clusters with a checksum
/// (CRC-32) that is not theirs.
DamagedParts damage_of_matroska(Bytes& bytes);

}  // namespace mtstereo::run
