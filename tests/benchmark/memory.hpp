// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::bench {

/// The option with which the program is started again to measure memory: a process of its own for
/// each measurement, so that nothing of what ran before counts.
inline constexpr const char* kMemoryOption = "--measure-memory=";

/// Registers the measurements, of the defaults and of settings that take more or less: peak
/// resident set of the first frames over that before them, and the time of the first frame, which
/// sizes the buffers. Where the system does not tell the peak, a note on the standard error says so
/// and nothing is registered.
void register_memory(bool quick);

/// What the process of its own does, given what stands behind the option, the size and parameters
/// as in "640x480x64/mode=dense": prints the two figures. Throws std::runtime_error.
void measure_memory(const char* what);

}  // namespace mtstereo::bench
