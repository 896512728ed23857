// Memory of the programs on Linux: arrays of a large body are in pages of 2 MB, whose first touch costs the system one
// fault instead of 512. Many systems grant such pages on request, and the standard library does not request them. Only
// programs have this file: a library must not choose for its users.
#include <cstdlib>
#include <new>

#include "palpate/base/system/process.h"

namespace {

void* allocated(std::size_t bytes, std::size_t alignment) {
  void* memory = nullptr;
  if (bytes >= palpate::system::kLargeArrayBytes) {
    memory = palpate::system::largeArray(bytes);
  } else if (alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__) {
    memory = std::malloc(bytes > 0 ? bytes : 1);
  } else {
    memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  }
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return allocated(bytes, 1); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocated(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}
