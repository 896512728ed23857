// Linked into a program, this file puts itself in front of the C library's allocator. operator new calls malloc, and so
// do Eigen's matrices of run-time size: counting malloc counts them all.
//
// Based on: the GNU C Library manual, section "Replacing malloc". Every call goes on to glibc's own allocator under its
// internal name, so memory may be freed by the untouched free().
#include "lab/counters/allocation_count.h"

#include <cerrno>
#include <cstdlib>

#include "lab/counters/interposition.h"

#ifdef PALPATE_CAN_INTERPOSE

namespace {
thread_local std::uint64_t count = 0;
}

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): names that the C library chose
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t items, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}
void* calloc(std::size_t items, std::size_t size) {
  ++count;
  return __libc_calloc(items, size);
}
void* realloc(void* old, std::size_t size) {
  ++count;
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++count;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++count;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  ++count;
  void* memory = __libc_memalign(alignment, size);
  if (memory == nullptr) return ENOMEM;
  *result = memory;
  return 0;
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

std::optional<std::uint64_t> palpate::lab::allocationsOfThisThread() { return count; }

#else

std::optional<std::uint64_t> palpate::lab::allocationsOfThisThread() { return std::nullopt; }

#endif
