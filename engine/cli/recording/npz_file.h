// A NumPy file of arrays with names (.npz): a ZIP archive of .npy files, as numpy.load reads it.
//
// Based on: NumPy Enhancement Proposal 1, "A Simple File Format for NumPy Arrays". The archive is minizip's.
//
// Entries are stored uncompressed: numpy.load then reads them at the speed of the disk. Own, over minizip's C
// interface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "palpate/base/output_file.h"

namespace palpate::app {

class NpzFile {
 public:
  /// Begins the file next to its target. Throws Error.
  explicit NpzFile(const std::filesystem::path& file);
  ~NpzFile();

  /// `type` as NumPy has it, "<f8"; `bytes` are those of `count` numbers, little-endian. Throws Error.
  void add(const std::string& name, std::string_view type, std::uint64_t count, std::string_view bytes);
  /// `count` squares of `side` x `side` floats.
  void addSquares(const std::string& name, std::uint64_t count, std::size_t side, std::span<const float> values);
  /// A single number.
  void add(const std::string& name, double number);
  /// The last call: gives the file its name.
  void commit();

 private:
  void add(const std::string& name, std::string_view header, std::string_view bytes, bool is_large);
  [[noreturn]] void fail() const;

  struct Archive;
  std::string name_;
  OutputFile file_;
  std::unique_ptr<Archive> archive_;
};

}  // namespace palpate::app
