// The directories of tags that TIFF files are made of, and EXIF blocks too: numbers and texts by tag, in either order
// of bytes. Whatever the bytes are: a tag that points outside is not there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace palpate::measure {

struct TiffTag {
  std::uint16_t tag = 0;
  std::uint16_t type = 0;
  std::uint32_t count = 0;
  std::size_t value_at = 0;  ///< offset of its first value, from the start of the block
};

class TiffDirectory {
 public:
  TiffDirectory() = default;
  /// The directory at this offset; empty if none is there. `bytes` must outlive it.
  TiffDirectory(std::string_view bytes, bool big_endian, std::size_t at);

  const TiffTag* find(std::uint16_t tag) const;
  /// A tag of whole numbers; nothing when it is missing or of another kind.
  std::optional<std::uint32_t> number(std::uint16_t tag, std::size_t index = 0) const;
  /// A tag of letters, up to its first zero; empty when it is missing.
  std::string_view text(std::uint16_t tag) const;
  /// Offset of the next directory; 0: this is the last one, or is cut off.
  std::size_t next() const { return next_; }
  bool empty() const { return tags_.empty(); }

 private:
  std::uint32_t unsignedAt(std::size_t at, std::size_t width) const;

  std::string_view bytes_;
  bool big_endian_ = false;
  std::vector<TiffTag> tags_;
  std::size_t next_ = 0;
};

struct TiffStart {
  bool big_endian = false;
  std::size_t directory_at = 0;
};

/// Nothing for bytes that do not start as TIFF does.
std::optional<TiffStart> tiffStart(std::string_view bytes);

}  // namespace palpate::measure
