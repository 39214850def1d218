// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

/// Exports a class or a function from the shared library. Everything else in the library is hidden.
#if defined(_WIN32)
#define MTSTEREO_API
#else
#define MTSTEREO_API __attribute__((visibility("default")))
#endif

#if __cplusplus < 202002L
#error "mtstereo needs C++20 or later: compile with -std=c++20"
#endif
