// The rows of an SQLite file read page by page, without SQLite: from a file that is cut, overwritten in places or
// without its first page every row comes out whose own pages are sound.
//
//   file, its write-ahead log ─► pages ─► rows of tables, entries of indices ─► recording_repair
//
// Each leaf of a table says by itself what its rows are; which table they are of, the reader must know by their shape.
// Nothing is written, and no byte is trusted. Based on: the SQLite project's "Database File Format".
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "palpate/base/byte_file.h"

namespace palpate::trace {

struct RawValue {
  enum class Kind : std::uint8_t { none, integer, real, text, blob };
  Kind kind = Kind::none;
  std::int64_t integer = 0;
  double real = 0.0;
  std::string bytes;  ///< of a text or a blob

  bool isText() const { return kind == Kind::text; }
  bool isInteger() const { return kind == Kind::integer; }
  /// SQLite keeps whole numbers of a REAL column as integers.
  double number() const { return kind == Kind::integer ? static_cast<double>(integer) : real; }
};

/// Where a row or an entry stands.
struct CellPlace {
  std::uint32_t page = 0;
  std::uint32_t cell = 0;
};

struct RawRow {
  CellPlace place;
  std::int64_t id = 0;  ///< 0 for an entry of an index
  std::vector<RawValue> values;
  bool whole = true;  ///< false: the last values are missing, the pages that they went on in are not there
};

class SqlitePages {
 public:
  /// Throws Error (file: cause) for what cannot be read at all.
  explicit SqlitePages(const std::filesystem::path& file);

  using Visit = std::function<void(const RawRow& row)>;
  /// Every row of every leaf of a table, but of pages that the file itself calls free; and every entry of an index.
  void forEachRow(const Visit& visit_row, const Visit& visit_entry);
  /// The row at a place where there was one.
  RawRow rowAt(const CellPlace& place);

  std::uint32_t pages() const { return pages_; }
  std::uint64_t bytes() const { return file_.size(); }
  /// The file's first bytes are those of an SQLite file.
  bool hasHeader() const { return has_header_; }
  /// Bytes at the file's end that the header names and that are missing; 0 also where it is not known.
  std::uint64_t bytesMissing() const;
  /// The application id and the version in the header; 0 without one.
  std::uint32_t application() const { return application_; }
  std::uint32_t version() const { return version_; }
  /// Pages of the write-ahead log that belong to the file, and those that are damaged.
  std::size_t pagesOfLog() const { return logged_.size(); }
  std::size_t damagedFramesOfLog() const { return damaged_frames_; }

 private:
  struct Node;
  void readHeader();
  void readLog();
  void readFreePages(std::uint32_t first);
  bool page(std::uint32_t number, std::string& bytes);
  bool node(std::uint32_t number, Node& node);
  bool cell(const Node& node, std::uint32_t cell, RawRow& row);
  bool payload(std::string_view page, std::size_t at, std::uint64_t size, bool of_index, std::string& bytes);

  std::string name_;
  ByteFile file_;
  ByteFile log_;
  std::uint32_t pages_told_ = 0;    ///< by the header
  std::uint32_t page_size_ = 4096;  ///< SQLite's own choice, where the header is lost
  std::uint32_t usable_ = 4096;
  std::uint32_t pages_ = 0;
  std::uint32_t application_ = 0;
  std::uint32_t version_ = 0;
  bool has_header_ = false;
  std::size_t damaged_frames_ = 0;
  std::unordered_map<std::uint32_t, std::uint64_t> logged_;  ///< page -> place of its newest content in the log
  std::unordered_set<std::uint32_t> free_;
};

}  // namespace palpate::trace
