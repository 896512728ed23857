// The rules of palpate.h for the caller's memory: structures that grow, whose `size` is their number of bytes, and
// texts.
//
//   caller's structure ─ fromCaller ─► whole one of this library ─ work ─ toCaller ─► the part that the caller knows
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>

namespace palpate::c_api {

/// Whether some version of the structure may have this size.
template <class Struct>
constexpr bool isSize(std::size_t size) noexcept {
  return size >= sizeof(std::size_t) && size % alignof(Struct) == 0;
}

template <class Struct>
bool isUsable(const Struct* given) noexcept {
  return given != nullptr && isSize<Struct>(given->size);
}

/// Copies all that the caller's version has; the rest is as in `defaults`. Requires a usable `given`.
template <class Struct>
Struct fromCaller(const Struct* given, const Struct& defaults = {}) noexcept {
  static_assert(std::is_trivially_copyable_v<Struct> && offsetof(Struct, size) == 0);
  Struct whole = defaults;
  std::memcpy(static_cast<void*>(&whole), given, std::min(given->size, sizeof(Struct)));
  whole.size = sizeof(Struct);
  return whole;
}

/// Fills as much of the caller's as both know. It has `size` bytes, and gets that as its size.
template <class Struct>
void toCaller(const Struct& whole, Struct* target, std::size_t size) noexcept {
  static_assert(std::is_trivially_copyable_v<Struct> && offsetof(Struct, size) == 0);
  std::memcpy(static_cast<void*>(target), &whole, std::min(size, sizeof(Struct)));
  target->size = size;
}

/// Copies into the caller's, up to its size.
template <class Struct>
void toCaller(const Struct& whole, Struct* target) noexcept {
  toCaller(whole, target, target->size);
}

/// Text for a fixed room, its NUL included, cut before a letter that does not fit whole. The rest is zero.
template <std::size_t Room>
void putText(std::string_view text, char (&target)[Room]) noexcept {
  std::size_t length = std::min(text.size(), Room - 1);
  if (length < text.size()) {
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0u) == 0x80u) --length;
  }
  std::memcpy(target, text.data(), length);
  std::memset(target + length, 0, Room - length);
}

}  // namespace palpate::c_api
