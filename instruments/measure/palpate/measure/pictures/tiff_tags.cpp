// Based on: TIFF Revision 6.0, sections 2 and 8.
#include "palpate/measure/pictures/tiff_tags.h"

#include <algorithm>
#include <array>

namespace palpate::measure {

namespace {

constexpr std::size_t kTagBytes = 12;
constexpr std::uint16_t kLetters = 2;

/// Bytes of one value, by type: byte, letter, short, long, rational, signed forms of them, float, double, offset.
std::size_t valueBytes(std::uint16_t type) {
  constexpr std::array<std::size_t, 14> kBytes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4};
  return type < kBytes.size() ? kBytes[type] : 0;
}

std::uint32_t unsignedFrom(std::string_view bytes, bool big_endian) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t from = big_endian ? i : bytes.size() - 1 - i;
    number = number << 8 | static_cast<unsigned char>(bytes[from]);
  }
  return number;
}

}  // namespace

std::optional<TiffStart> tiffStart(std::string_view bytes) {
  if (bytes.size() < 8) return std::nullopt;
  const std::string_view start = bytes.substr(0, 4);
  if (start != std::string_view("II*\0", 4) && start != std::string_view("MM\0*", 4)) return std::nullopt;
  const bool big_endian = start.front() == 'M';
  return TiffStart{.big_endian = big_endian, .directory_at = unsignedFrom(bytes.substr(4, 4), big_endian)};
}

TiffDirectory::TiffDirectory(std::string_view bytes, bool big_endian, std::size_t at)
    : bytes_(bytes), big_endian_(big_endian) {
  if (at == 0 || at + 2 > bytes.size()) return;
  const std::size_t wanted = unsignedAt(at, 2);
  const std::size_t count = std::min(wanted, (bytes.size() - at - 2) / kTagBytes);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t tag_at = at + 2 + i * kTagBytes;
    TiffTag tag{.tag = static_cast<std::uint16_t>(unsignedAt(tag_at, 2)),
                .type = static_cast<std::uint16_t>(unsignedAt(tag_at + 2, 2)),
                .count = unsignedAt(tag_at + 4, 4)};
    const std::uint64_t length = std::uint64_t{tag.count} * valueBytes(tag.type);
    tag.value_at = length <= 4 ? tag_at + 8 : unsignedAt(tag_at + 8, 4);
    if (length > 0 && tag.value_at + length <= bytes.size()) tags_.push_back(tag);
  }
  const std::size_t next_at = at + 2 + count * kTagBytes;
  if (count == wanted && next_at + 4 <= bytes.size()) next_ = unsignedAt(next_at, 4);
}

std::uint32_t TiffDirectory::unsignedAt(std::size_t at, std::size_t width) const {
  return unsignedFrom(bytes_.substr(at, width), big_endian_);
}

const TiffTag* TiffDirectory::find(std::uint16_t tag) const {
  const auto found = std::find_if(tags_.begin(), tags_.end(), [&](const TiffTag& one) { return one.tag == tag; });
  return found == tags_.end() ? nullptr : &*found;
}

std::optional<std::uint32_t> TiffDirectory::number(std::uint16_t tag, std::size_t index) const {
  const TiffTag* found = find(tag);
  if (found == nullptr || index >= found->count) return std::nullopt;
  const bool is_whole = found->type == 1 || found->type == 3 || found->type == 4 || found->type == 13;
  if (!is_whole) return std::nullopt;
  const std::size_t width = valueBytes(found->type);
  return unsignedAt(found->value_at + index * width, width);
}

std::string_view TiffDirectory::text(std::uint16_t tag) const {
  const TiffTag* found = find(tag);
  if (found == nullptr || found->type != kLetters) return {};
  const std::string_view all = bytes_.substr(found->value_at, found->count);
  return all.substr(0, all.find('\0'));
}

}  // namespace palpate::measure
