// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "recordings/media/source.hpp"

namespace mtstereo::run {

/// The number of a frame: the last digits in the name of its image; none without digits.
std::optional<std::int64_t> frame_number(const std::filesystem::path& image);

/// The time that a name states in one number: 18 or 19 digits are nanoseconds, 16 microseconds, 13
/// milliseconds.
std::optional<Nanoseconds> time_in_name(const std::filesystem::path& image);

/// Sets the times in the names of both lists, from the first one on: those of time_in_name(), or
/// dates with a fraction of the second, such as 2026-11-26_09-30-59.123456 or 20261126T093059_123.
/// False if they state none, or if these may be numbers after the date of the recording.
bool set_times_of_names(Source& left, Source& right);

}  // namespace mtstereo::run
