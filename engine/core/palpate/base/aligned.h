// Vectors whose data starts on a cache line: structure-of-arrays kernels load whole lanes without a split.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace palpate {

/// One cache line, and one AVX-512 register.
inline constexpr std::size_t kCacheLineBytes = 64;

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{kCacheLineBytes}));
  }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{kCacheLineBytes}); }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

// Memory that is there before it is needed.

/// Empties the vector and gives it room for `count` elements, every page of it touched. After a plain reserve() the
/// system finds each page when it is first written: a page fault in whatever servo tick that is.
template <class T>
void reserveTouched(std::vector<T>& items, std::size_t count) {
  items.clear();
  items.resize(count);
  items.clear();
}

}  // namespace palpate
