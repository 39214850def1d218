// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

/// Marks what the shared library shows; everything else in it is hidden.
#if defined(_WIN32)
#define MTSTEREO_API
#else
#define MTSTEREO_API __attribute__((visibility("default")))
#endif
