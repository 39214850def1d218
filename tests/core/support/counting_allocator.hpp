// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::test {

/// The allocator of this program counts, and fails when told so. It stands in the way of everything
/// that the program and its libraries allocate, from any thread: new, malloc, calloc, realloc,
/// aligned_alloc, memalign and posix_memalign.

/// True where the allocator was put in place (GNU's C library, no sanitizer).
bool allocations_are_counted();

/// Counts from 0 again.
void count_allocations();
/// Allocations since count_allocations().
long allocations();

/// The allocation after the next `successes` ones fails, once; a negative number fails none.
void fail_allocation_after(long successes);
/// True where an allocation has failed since fail_allocation_after().
bool allocation_has_failed();

}  // namespace mtstereo::test
