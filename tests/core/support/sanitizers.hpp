// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::test {

/// True where a sanitizer stands between the program and the allocator.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace mtstereo::test
