// Walks through the bytes of a binary mesh file and knows where it is. Reading past the end is one clear Error.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::mesh {

/// A number stored with the given byte order. `data` must hold sizeof(T) bytes.
template <class T>
T numberFromBytes(const char* data, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), data, sizeof(T));
  if (order != std::endian::native) {
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  }
  return std::bit_cast<T>(bytes);
}

class ByteReader {
 public:
  /// `name` is the file in messages; both must outlive the reader. `start`: offset of the first byte to read.
  ByteReader(std::string_view bytes, std::string_view name, std::size_t start = 0)
      : bytes_(bytes), name_(name), position_(start) {}

  template <class T>
  T number(std::endian order = std::endian::little) {
    return numberFromBytes<T>(readBytes(sizeof(T), "the file ends in the middle of a number").data(), order);
  }
  /// The next `count` bytes.
  std::string_view readBytes(std::size_t count, std::string_view cause) {
    if (count > bytesLeft()) fail(cause);
    position_ += count;
    return bytes_.substr(position_ - count, count);
  }
  std::size_t position() const { return position_; }
  std::size_t bytesLeft() const { return bytes_.size() - position_; }
  /// Throws Error at this byte.
  [[noreturn]] void fail(std::string_view cause) const { throw Error::atByte(name_, position_, cause); }

 private:
  std::string_view bytes_;
  std::string_view name_;
  std::size_t position_;
};

}  // namespace palpate::mesh
