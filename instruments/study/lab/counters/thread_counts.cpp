// Based on: the GNU C Library manual, section "Replacing malloc". operator new calls malloc, and so do Eigen's matrices
// of run-time size: counting malloc counts them all. Every call continues to glibc's own allocator under its internal
// name, so memory may be freed by the untouched free(). Locks have no internal name: each call asks the loader, the
// first time, for the next function of the same name.
#include "lab/counters/thread_counts.h"

#ifdef PALPATE_CAN_INTERPOSE
#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#endif

#ifdef __linux__
#include <sys/resource.h>
#endif

#ifdef PALPATE_CAN_INTERPOSE

namespace {

thread_local std::uint64_t allocations = 0;
thread_local std::uint64_t locks = 0;

/// A function of the C library that this file intercepts. Locks are taken before main and by any thread, so it is ready
/// without a constructor.
template <class Lock>
struct Behind {
  const char* name;
  std::atomic<int (*)(Lock*)> function{nullptr};

  int operator()(Lock* lock) {
    ++locks;
    auto* known = function.load(std::memory_order_relaxed);
    if (known == nullptr) {
      known = reinterpret_cast<int (*)(Lock*)>(dlsym(RTLD_NEXT, name));
      function.store(known, std::memory_order_relaxed);
    }
    return known(lock);
  }
};

constinit Behind<pthread_mutex_t> mutex_lock{"pthread_mutex_lock"};
constinit Behind<pthread_mutex_t> mutex_trylock{"pthread_mutex_trylock"};
constinit Behind<pthread_rwlock_t> rwlock_rdlock{"pthread_rwlock_rdlock"};
constinit Behind<pthread_rwlock_t> rwlock_wrlock{"pthread_rwlock_wrlock"};
constinit Behind<pthread_rwlock_t> rwlock_tryrdlock{"pthread_rwlock_tryrdlock"};
constinit Behind<pthread_rwlock_t> rwlock_trywrlock{"pthread_rwlock_trywrlock"};

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): names that the C library chose
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t items, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t items, std::size_t size) {
  ++allocations;
  return __libc_calloc(items, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  ++allocations;
  void* memory = __libc_memalign(alignment, size);
  if (memory == nullptr) return ENOMEM;
  *result = memory;
  return 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept { return mutex_lock(mutex); }
int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept { return mutex_trylock(mutex); }
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept { return rwlock_rdlock(lock); }
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept { return rwlock_wrlock(lock); }
int pthread_rwlock_tryrdlock(pthread_rwlock_t* lock) noexcept { return rwlock_tryrdlock(lock); }
int pthread_rwlock_trywrlock(pthread_rwlock_t* lock) noexcept { return rwlock_trywrlock(lock); }
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

#endif

namespace palpate::lab {

namespace {

std::optional<std::uint64_t> pageFaultsOfThisThread() {
#ifdef __linux__
  rusage usage{};
  if (getrusage(RUSAGE_THREAD, &usage) == 0) return static_cast<std::uint64_t>(usage.ru_minflt + usage.ru_majflt);
#endif
  return std::nullopt;
}

std::optional<std::uint64_t> difference(std::optional<std::uint64_t> after, std::optional<std::uint64_t> before) {
  if (!after || !before) return std::nullopt;
  return *after - *before;
}

}  // namespace

#ifdef PALPATE_CAN_INTERPOSE
std::optional<std::uint64_t> allocationsOfThisThread() { return allocations; }
std::optional<std::uint64_t> locksOfThisThread() { return locks; }
#else
std::optional<std::uint64_t> allocationsOfThisThread() { return std::nullopt; }
std::optional<std::uint64_t> locksOfThisThread() { return std::nullopt; }
#endif

ThreadCounts countsOfThisThread() { return {allocationsOfThisThread(), locksOfThisThread(), pageFaultsOfThisThread()}; }

ThreadCounts countsSince(const ThreadCounts& before) {
  const ThreadCounts now = countsOfThisThread();
  return {difference(now.allocations, before.allocations), difference(now.locks, before.locks),
          difference(now.page_faults, before.page_faults)};
}

}  // namespace palpate::lab
