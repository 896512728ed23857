// Conversion of a finger's output between C++ and C.
#pragma once

#include <cstddef>

#include "palpate.h"
#include "palpate/contact/finger_state.h"

namespace palpate::c_api {

/// Writes what was felt into a structure of `size` bytes, which becomes its size. Where the caller knows all of it,
/// each number is written once. No allocation.
void putTouch(const contact::FingerOutput& felt, std::uint64_t tick, palpate_touch* touch, std::size_t size) noexcept;

/// The inverse. False for a number that is not finite, and for an invalid state or triangle. `triangles`: number of the
/// world's skin.
bool feltFrom(const palpate_touch& touch, std::size_t triangles, contact::FingerOutput& felt) noexcept;

/// The i-th of structures that begin `stride` bytes apart.
template <class Struct>
Struct* at(Struct* first, std::size_t i, std::size_t stride) noexcept {
  using Byte = std::conditional_t<std::is_const_v<Struct>, const char, char>;
  return reinterpret_cast<Struct*>(reinterpret_cast<Byte*>(first) + i * stride);
}

}  // namespace palpate::c_api
