// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/counting_allocator.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

namespace mtstereo::test {
namespace {

std::atomic<long> counter{0};
std::atomic<long> until_failure{-1};
std::atomic<bool> failed{false};

/// Counts one allocation; returns false if it must fail.
[[maybe_unused]] bool allow() {
  counter.fetch_add(1, std::memory_order_relaxed);
  if (until_failure.load(std::memory_order_relaxed) < 0) return true;
  if (until_failure.fetch_sub(1, std::memory_order_relaxed) != 0) return true;
  failed = true;
  errno = ENOMEM;
  return false;
}

}  // namespace

void count_allocations() { counter = 0; }
long allocations() { return counter; }
void fail_allocation_after(long successes) {
  failed = false;
  until_failure = successes;
}
bool allocation_has_failed() { return failed; }

#ifdef __GLIBC__

bool allocations_are_counted() { return true; }

}  // namespace mtstereo::test

extern "C" {
// The functions of the allocator itself, under the names that glibc provides for replacements.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) { return mtstereo::test::allow() ? __libc_malloc(size) : nullptr; }
void* calloc(std::size_t count, std::size_t size) {
  return mtstereo::test::allow() ? __libc_calloc(count, size) : nullptr;
}
void* realloc(void* old, std::size_t size) {
  return mtstereo::test::allow() ? __libc_realloc(old, size) : nullptr;
}
void* memalign(std::size_t alignment, std::size_t size) {
  return mtstereo::test::allow() ? __libc_memalign(alignment, size) : nullptr;
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}
}

#else

bool allocations_are_counted() { return false; }

}  // namespace mtstereo::test

#endif
