// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::test {

/// The allocator of this program counts allocations and can let one fail. It replaces all
/// allocation functions for the program and its libraries, on every thread: new, malloc, calloc,
/// realloc, aligned_alloc, memalign and posix_memalign.

/// True if the allocator is replaced (glibc).
bool allocations_are_counted();

/// Resets the count to 0.
void count_allocations();
/// Allocations since count_allocations().
long allocations();

/// The allocation after the next `successes` ones fails, once; with a negative number none fails.
void fail_allocation_after(long successes);
/// True if an allocation has failed since fail_allocation_after().
bool allocation_has_failed();

}  // namespace mtstereo::test
