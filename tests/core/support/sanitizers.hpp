// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

/// Defined if a sanitizer replaces the allocator: gcc defines a macro, clang has a feature.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MTSTEREO_TEST_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MTSTEREO_TEST_SANITIZED
#endif
#endif

namespace mtstereo::test {

/// True if a sanitizer replaces the allocator.
#ifdef MTSTEREO_TEST_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace mtstereo::test
