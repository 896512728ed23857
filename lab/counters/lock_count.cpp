// Linked into a program, this file puts itself in front of the C library's locks. Unlike the allocator these have no
// internal name to go on to: each call asks the loader, the first time, for the next function of the same name.
#include "lab/counters/lock_count.h"

#include <pthread.h>

#include "lab/counters/interposition.h"

#ifdef PALPATE_CAN_INTERPOSE

#include <dlfcn.h>

#include <atomic>

namespace {

thread_local std::uint64_t count = 0;

/// A function of the C library that this file stands in front of. Locks are taken before main and by any thread, so it
/// is ready without a constructor.
template <class Lock>
struct Behind {
  const char* name;
  std::atomic<int (*)(Lock*)> function{nullptr};

  int operator()(Lock* lock) {
    ++count;
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

// NOLINTBEGIN(readability-identifier-naming): names that the C library chose
extern "C" {
int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept { return mutex_lock(mutex); }
int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept { return mutex_trylock(mutex); }
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept { return rwlock_rdlock(lock); }
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept { return rwlock_wrlock(lock); }
int pthread_rwlock_tryrdlock(pthread_rwlock_t* lock) noexcept { return rwlock_tryrdlock(lock); }
int pthread_rwlock_trywrlock(pthread_rwlock_t* lock) noexcept { return rwlock_trywrlock(lock); }
}
// NOLINTEND(readability-identifier-naming)

std::optional<std::uint64_t> palpate::lab::locksOfThisThread() { return count; }

#else

std::optional<std::uint64_t> palpate::lab::locksOfThisThread() { return std::nullopt; }

#endif
