// A block of samples as bytes, and back to the same bits: what a recording file holds.
//
//   samples of one finger ─ packSamples ─► bytes + checksum ─ table `blocks` ─► unpackSamples ─► the same samples
//
// A block is written column by column. A value's bits are XORed with those of the row before, so that what changes
// little is mostly zeros; the bytes of a column stand sorted by their place in the number, so that the zeros stand
// together; deflate (zlib) makes them small. docs/reference/recordings.md reads a block in thirty lines of Python.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/trace/sample.h"

namespace palpate::trace {

/// One column of every block, in the order in which they are written.
struct SampleColumn {
  std::string_view name;
  std::string_view type;  ///< f64, u64 or u32, little-endian
  std::string_view unit;  ///< empty: none
  std::string_view meaning;
  std::uint64_t (*bits)(const Sample& sample);
  void (*set)(Sample& sample, std::uint64_t bits);

  std::size_t width() const { return type == "u32" ? 4 : 8; }
};

/// Those of this version, which it writes. A reader is told those of its file.
std::span<const SampleColumn> sampleColumns();

/// The column of this name as a file has it: one that this version does not know is skipped. Throws Error for an
/// unknown type, and for a known column of another type.
SampleColumn columnOf(std::string_view name, std::string_view type);

/// Most rows of a block; more in a file are refused.
inline constexpr std::size_t kMaxBlockRows = 100000;

struct SampleBlock {
  std::string bytes;        ///< deflated
  std::uint32_t crc32 = 0;  ///< of `bytes`, as zlib has it
};

/// The finger is not part of the bytes. Throws Error for no samples and for more than kMaxBlockRows.
SampleBlock packSamples(std::span<const Sample> samples);

/// Fields without a column keep their defaults. Throws Error for a wrong checksum, for bytes that are not those of
/// `rows` samples, and for an unknown state of contact. `finger` goes into the samples.
std::vector<Sample> unpackSamples(std::string_view bytes, std::uint32_t crc32, std::size_t rows, std::uint32_t finger,
                                  std::span<const SampleColumn> columns = sampleColumns());

}  // namespace palpate::trace
