// The one exception type of the cold paths (load, validate, build, command line).
//
// A message reads `where: cause`, in one line, so that a command can print it unchanged; its parts are for jumping to
// the place or translating the cause. Hot paths never throw.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace palpate {

class Error : public std::runtime_error {
 public:
  /// Without a place.
  explicit Error(const std::string& cause) : std::runtime_error(cause) {}

  /// `file: cause`
  static Error inFile(std::string_view file, std::string_view cause);
  /// `file:line: cause`, line counted from 1.
  static Error atLine(std::string_view file, std::size_t line, std::string_view cause);
  /// `file: byte offset: cause`, offset counted from 0.
  static Error atByte(std::string_view file, std::uint64_t offset, std::string_view cause);

  // The parts of what(); views of it, valid as long as the error.

  /// The file's name as passed to the reader; empty: not a fault of a file.
  std::string_view file() const noexcept { return std::string_view(what()).substr(0, file_length_); }
  /// Counted from 1; 0: not known.
  std::size_t line() const noexcept { return line_; }
  /// what() without file and line. A byte's offset is part of the cause. Empty where a zero byte in the file's name cut
  /// what() short.
  std::string_view cause() const noexcept {
    const std::string_view all = what();
    return cause_begin_ < all.size() ? all.substr(cause_begin_) : std::string_view();
  }

 private:
  Error(const std::string& message, std::string_view file, std::size_t line, std::string_view cause)
      : std::runtime_error(message),
        file_length_(file.size()),
        line_(line),
        cause_begin_(message.size() - cause.size()) {}

  // Places within what() instead of texts: copying an exception must not throw.
  std::size_t file_length_ = 0;
  std::size_t line_ = 0;
  std::size_t cause_begin_ = 0;
};

}  // namespace palpate
