// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::bench {

/// The option with which the program starts itself to measure memory. Each measurement has its own
/// process, so that earlier benchmarks do not affect it.
inline constexpr const char* kMemoryOption = "--measure-memory=";

/// Registers the measurements of the defaults and of settings that need more or less memory: the
/// increase of the peak resident set by the first frames, and the time of the first frame, which
/// allocates the buffers. If the system does not report the peak, prints a note on the standard
/// error and registers nothing.
void register_memory(bool quick);

/// The work of that process: prints the two figures. `what` is the value of the option, size and
/// parameters, such as "640x480x64/mode=dense". Throws std::runtime_error.
void measure_memory(const char* what);

}  // namespace mtstereo::bench
