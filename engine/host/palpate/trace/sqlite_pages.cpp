// Based on: the SQLite project's "Database File Format", sections 1.3 (header), 1.5 (freelist), 1.6 (b-tree pages,
// cells and their overflow), 2.1 (records), 4 (write-ahead log).
#include "palpate/trace/sqlite_pages.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"

namespace palpate::trace {

namespace {

constexpr std::string_view kMagic{"SQLite format 3\0", 16};
constexpr std::size_t kHeaderBytes = 100;
constexpr std::size_t kLogHeaderBytes = 32;
constexpr std::size_t kFrameHeaderBytes = 24;
/// More columns than any table here has.
constexpr std::size_t kMaxValues = 64;

constexpr unsigned kIndexNode = 2;
constexpr unsigned kIndexLeaf = 10;
constexpr unsigned kTableLeaf = 13;

unsigned byteAt(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }

std::uint64_t bigEndian(std::string_view bytes, std::size_t at, std::size_t width) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < width; ++i) value = value << 8 | byteAt(bytes, at + i);
  return value;
}

std::uint32_t word(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bigEndian(bytes, at, 4));
}

/// Seven bits a byte, the first bit says that more follow; eight in the ninth. Moves `at` behind it.
std::optional<std::uint64_t> varint(std::string_view bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (int i = 0; i < 9; ++i) {
    if (at >= bytes.size()) return std::nullopt;
    const unsigned byte = byteAt(bytes, at++);
    if (i == 8) return value << 8 | byte;
    value = value << 7 | (byte & 0x7fu);
    if ((byte & 0x80u) == 0) return value;
  }
  return value;
}

// --- records ---

/// Bytes of an integer of serial type 1 to 6.
std::size_t integerWidth(std::uint64_t type) {
  constexpr std::size_t kWidths[] = {0, 1, 2, 3, 4, 6, 8};
  return kWidths[type];
}

std::optional<std::size_t> serialTypeSize(std::uint64_t type) {
  if (type <= 6) return integerWidth(type);
  if (type == 7) return 8;
  if (type <= 9) return 0;
  if (type < 12) return std::nullopt;  // reserved
  return (type - 12) / 2;
}

RawValue valueOf(std::uint64_t type, std::string_view bytes) {
  RawValue value;
  if (type == 0) return value;
  if (type == 8 || type == 9) {
    value.kind = RawValue::Kind::integer;
    value.integer = type == 9 ? 1 : 0;
  } else if (type <= 6) {
    value.kind = RawValue::Kind::integer;
    const auto unused = static_cast<int>(64 - 8 * bytes.size());
    value.integer = static_cast<std::int64_t>(bigEndian(bytes, 0, bytes.size()) << unused) >> unused;
  } else if (type == 7) {
    value.kind = RawValue::Kind::real;
    value.real = std::bit_cast<double>(bigEndian(bytes, 0, 8));
  } else {
    value.kind = type % 2 == 0 ? RawValue::Kind::blob : RawValue::Kind::text;
    value.bytes = std::string(bytes);
  }
  return value;
}

/// `size` is that of the whole record, of which `bytes` may be only the beginning. False if it is not a record.
bool readRecord(std::string_view bytes, std::uint64_t size, RawRow& row) {
  std::size_t at = 0;
  const auto header = varint(bytes, at);
  if (!header || *header > bytes.size() || *header < at) return false;
  std::uint64_t place = *header;
  const std::string_view types = bytes.substr(0, *header);
  while (at < types.size()) {
    const auto type = varint(types, at);
    if (!type || row.values.size() >= kMaxValues) return false;
    const auto width = serialTypeSize(*type);
    if (!width || *width > size || place + *width > size) return false;
    if (place + *width > bytes.size()) row.whole = false;
    if (row.whole) row.values.push_back(valueOf(*type, bytes.substr(place, *width)));
    place += *width;
  }
  return place == size;
}

// --- the log ---

/// Over 8 bytes at a time; the words' order is the log's.
struct LogChecksum {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  bool big_endian = false;

  void add(std::string_view bytes) {
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
      first += value(bytes, at) + second;
      second += value(bytes, at + 4) + first;
    }
  }
  std::uint32_t value(std::string_view bytes, std::size_t at) const {
    const std::uint32_t big = word(bytes, at);
    return big_endian ? big : (big >> 24) | ((big >> 8) & 0xff00u) | ((big << 8) & 0xff0000u) | (big << 24);
  }
  bool is(std::string_view bytes, std::size_t at) const {
    return first == word(bytes, at) && second == word(bytes, at + 4);
  }
};

bool isPageSize(std::uint32_t size) { return size >= 512 && size <= 65536 && std::has_single_bit(size); }

}  // namespace

/// A page of a tree.
struct SqlitePages::Node {
  std::uint32_t number = 0;
  std::string bytes;
  unsigned type = 0;
  std::uint32_t cells = 0;
  std::size_t pointers = 0;  ///< where the places of its cells begin
};

SqlitePages::SqlitePages(const std::filesystem::path& file)
    : name_(file.string()), file_(file), log_(withEnding(file, "-wal")) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw Error::inFile(name_, std::filesystem::exists(file, error) ? "is not a file" : "no such file");
  }
  if (!file_.isOpen()) throw Error::inFile(name_, "cannot be read");
  readHeader();
  readLog();
  pages_ = std::max(pages_, static_cast<std::uint32_t>((bytes() + page_size_ - 1) / page_size_));
  std::string first;
  if (!page(1, first) || first.substr(0, kMagic.size()) != kMagic) return;
  // A version of SQLite that does not keep the number of pages leaves another count of changes beside it.
  if (word(first, 24) == word(first, 92)) pages_told_ = word(first, 28);
  application_ = word(first, 68);
  version_ = word(first, 60);
  readFreePages(word(first, 32));
}

void SqlitePages::readHeader() {
  std::string header;
  if (!file_.read(0, kHeaderBytes, header) || header.substr(0, kMagic.size()) != kMagic) return;
  const auto told = static_cast<std::uint32_t>(bigEndian(header, 16, 2));
  const std::uint32_t size = told == 1 ? 65536 : told;
  const unsigned reserved = byteAt(header, 20);
  if (!isPageSize(size)) return;
  has_header_ = true;
  page_size_ = size;
  usable_ = size - reserved;
}

/// A frame's checksum goes on from the one before; it is checked from what that one says, so that a damaged frame does
/// not take those after it with it.
void SqlitePages::readLog() {
  std::string header;
  if (!log_.read(0, kLogHeaderBytes, header)) return;
  const std::uint32_t magic = word(header, 0);
  const std::uint32_t size = word(header, 8);
  if ((magic & ~1u) != 0x377f0682u || !isPageSize(size)) return;
  if (has_header_ && size != page_size_) return;
  page_size_ = size;
  if (!has_header_) usable_ = size;
  std::string before = header.substr(24, 8);
  std::unordered_map<std::uint32_t, std::uint64_t> waiting;  // of a transaction without an end
  std::string frame;
  for (std::uint64_t at = kLogHeaderBytes; log_.read(at, kFrameHeaderBytes + size, frame); at += frame.size()) {
    LogChecksum checksum{word(before, 0), word(before, 4), (magic & 1u) != 0};
    before = frame.substr(16, 8);
    if (frame.substr(8, 8) != header.substr(16, 8)) continue;  // of an earlier use of the log
    checksum.add(std::string_view(frame).substr(0, 8));
    checksum.add(std::string_view(frame).substr(kFrameHeaderBytes));
    if (!checksum.is(frame, 16)) {
      ++damaged_frames_;
      continue;
    }
    waiting[word(frame, 0)] = at + kFrameHeaderBytes;
    const std::uint32_t pages_then = word(frame, 4);
    if (pages_then == 0) continue;
    for (const auto& [number, place] : waiting) logged_[number] = place;
    waiting.clear();
    pages_ = pages_then;
  }
}

void SqlitePages::readFreePages(std::uint32_t first) {
  std::string trunk;
  for (std::uint32_t next = first; next != 0 && page(next, trunk) && free_.insert(next).second;) {
    const std::uint32_t count = word(trunk, 4);
    if (count > usable_ / 4 - 2) return;
    for (std::uint32_t i = 0; i < count; ++i) free_.insert(word(trunk, 8 + 4 * std::size_t{i}));
    next = word(trunk, 0);
  }
}

std::uint64_t SqlitePages::bytesMissing() const {
  std::uint64_t there = bytes();
  const std::uint64_t told = std::uint64_t{pages_told_} * page_size_;
  if (told <= there) return 0;
  for (const auto& [number, place] : logged_) {
    if (std::uint64_t{number} * page_size_ > bytes() && number <= pages_told_) there += page_size_;
  }
  return told - std::min(told, there);
}

/// False where there is none, or only a part of it.
bool SqlitePages::page(std::uint32_t number, std::string& bytes) {
  if (number == 0) return false;
  const auto logged = logged_.find(number);
  if (logged != logged_.end()) return log_.read(logged->second, page_size_, bytes);
  const std::uint64_t at = std::uint64_t{number - 1} * page_size_;
  return file_.read(at, page_size_, bytes);
}

bool SqlitePages::node(std::uint32_t number, Node& node) {
  node.number = number;
  if (!page(number, node.bytes)) return false;
  const std::size_t begin = number == 1 ? kHeaderBytes : 0;
  node.type = byteAt(node.bytes, begin);
  if (node.type != kTableLeaf && node.type != kIndexLeaf && node.type != kIndexNode) return false;
  node.cells = static_cast<std::uint32_t>(bigEndian(node.bytes, begin + 3, 2));
  node.pointers = begin + (node.type == kIndexNode ? 12 : 8);
  return node.pointers + 2 * std::size_t{node.cells} <= usable_;
}

/// The record at a place of the page and what of it overflows into other pages; ends early where one is missing.
bool SqlitePages::payload(std::string_view page_bytes, std::size_t at, std::uint64_t size, bool of_index,
                          std::string& bytes) {
  if (size == 0 || size > std::uint64_t{pages_} * page_size_) return false;
  const std::size_t most = of_index ? (usable_ - 12) * 64 / 255 - 23 : usable_ - 35;
  const std::size_t least = (usable_ - 12) * 32 / 255 - 23;
  const std::size_t filling = least + (size - least) % (usable_ - 4);
  const std::size_t local = size <= most ? size : filling <= most ? filling : least;
  const bool overflows = local < size;
  if (at + local + (overflows ? 4 : 0) > usable_) return false;
  bytes = page_bytes.substr(at, local);
  if (!overflows) return true;
  std::string next_page;
  for (std::uint32_t next = word(page_bytes, at + local); bytes.size() < size;) {
    if (!page(next, next_page)) return true;
    next = word(next_page, 0);
    bytes.append(next_page, 4, std::min<std::uint64_t>(usable_ - 4, size - bytes.size()));
  }
  return true;
}

bool SqlitePages::cell(const Node& node, std::uint32_t cell, RawRow& row) {
  std::size_t at = bigEndian(node.bytes, node.pointers + 2 * std::size_t{cell}, 2);
  if (at < node.pointers || at >= usable_) return false;
  const std::string_view bytes = std::string_view(node.bytes).substr(0, usable_);
  const bool of_index = node.type != kTableLeaf;
  if (node.type == kIndexNode) at += 4;
  const auto size = varint(bytes, at);
  std::optional<std::uint64_t> id = 0;
  if (!of_index) id = varint(bytes, at);
  std::string record;
  if (!size || !id || !payload(bytes, at, *size, of_index, record)) return false;
  row = {};
  row.place = {node.number, cell};
  row.id = static_cast<std::int64_t>(*id);
  return readRecord(record, *size, row);
}

void SqlitePages::forEachRow(const Visit& visit_row, const Visit& visit_entry) {
  Node at;
  RawRow row;
  for (std::uint32_t number = 1; number <= pages_; ++number) {
    if (free_.contains(number) || !node(number, at)) continue;
    for (std::uint32_t i = 0; i < at.cells; ++i) {
      if (cell(at, i, row)) (at.type == kTableLeaf ? visit_row : visit_entry)(row);
    }
  }
}

RawRow SqlitePages::rowAt(const CellPlace& place) {
  Node at;
  RawRow row;
  if (!node(place.page, at) || place.cell >= at.cells || !cell(at, place.cell, row)) row.whole = false;
  return row;
}

}  // namespace palpate::trace
