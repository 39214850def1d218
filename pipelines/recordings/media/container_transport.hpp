// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "recordings/media/container_bytes.hpp"

namespace mtstereo::run {

/// The length of the packets of MPEG-TS, and where the first one starts.
struct Packets {
  std::uint64_t length = 0, start = 0;
};

/// The packets of a file; std::nullopt if it is no MPEG-TS.
std::optional<Packets> packets_of(Bytes& bytes);

/// missing_end() of MPEG-TS.
std::string missing_of_transport_stream(Bytes& bytes, const Packets& kind);
/// may_lack_end() of MPEG-TS.
bool may_lack_end(Bytes& bytes, const Packets& kind);
/// damaged_parts() of MPEG-TS: packets that do not continue their stream with video, by their
/// counters, that are marked as damaged, or that are invalid.
DamagedParts damage_of_transport_stream(Bytes& bytes, const Packets& kind);

}  // namespace mtstereo::run
